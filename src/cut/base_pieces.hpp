// The pieces into which a tool cuts the whole base.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/complex.hpp"
#include "meshgraft/model.hpp"

namespace meshgraft {

/// Pieces of the surface elements of a base. An element is in the complex (cut along the tool) or out of
/// it. Elements are in one piece if they share an edge that is not on the tool.
struct BasePieces {
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  std::vector<std::uint32_t> of_face;     // by face of the complex; kNone for the tool
  std::vector<std::uint32_t> of_element;  // by element of the base; kNone if in the complex, or no surface
  std::uint32_t n = 0;                    // pieces; numbered in the order of their first face

  /// By piece: the centroid of its largest triangle, a place well inside.
  std::vector<Vec3> place;
  /// By piece: whether it has an edge on the tool.
  std::vector<std::uint8_t> touched;
};

/// `cuts`: edges of the complex that are on the tool, (smaller, larger) vertex, ascending; `tool`: its
/// component. Cost n log n in the edges of the base.
[[nodiscard]] BasePieces base_pieces(const Model& base, const Complex& complex,
                                     std::span<const std::array<VertexId, 2>> cuts, std::uint32_t tool);

}  // namespace meshgraft
