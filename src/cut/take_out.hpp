// From a base cut along the tool to the base that stays.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "intersect/corefine.hpp"

namespace meshgraft {

/// A complex cut along the tool, whose faces are marked by what becomes of them.
struct MarkedCut {
  Corefined corefined;
  std::vector<std::uint8_t> goes;  // by face; 1: it is taken out
};

/// Takes the faces of the tool out, and undoes the cut through faces that stay, or go, as a whole. Lines
/// follow.
///
///   original   the workpiece of the base, without the tool; its vertices are the first of the complex
///   goes       by face of the complex; the tool's do not matter
///
/// `touched` is left to faces that were cut or that have a vertex where something goes.
[[nodiscard]] MarkedCut without_tool(const Complex& original, const Corefined& corefined,
                                     std::span<const std::uint8_t> goes, std::uint32_t tool);

/// Edges with faces that go and faces that stay, (smaller, larger) vertex, ascending.
[[nodiscard]] std::vector<std::array<VertexId, 2>> border_of(const Complex& complex,
                                                             std::span<const std::uint8_t> goes);

}  // namespace meshgraft
