// The base near the tool, and the tool near the base, as one complex.
#pragma once

#include <span>
#include <vector>

#include "core/complex.hpp"
#include "cut/tool_surface.hpp"
#include "meshgraft/group_sets.hpp"

namespace meshgraft {

inline constexpr std::uint32_t kTool = 1;  // input of the faces of the tool

/// A face of the base and one of the tool that come near each other.
struct NearPair {
  ElementId of_base, of_tool;
};

/// Ascending by the face of the base. The tool may have faces far larger than those of the base, so that boxes alone
/// would tell little. Cost: one pass over the base, O(log t) for each of its faces.
[[nodiscard]] std::vector<NearPair> near_tool(const Model& base, const ToolSurface& tool, const Tolerance& tolerance);

/// The faces of the base, ascending.
[[nodiscard]] std::vector<ElementId> faces_of_base(std::span<const NearPair> pairs);

/// Parts the faces of the base into its meshes (what hangs together through vertices here), and adds to each a copy
/// of the tool of its own, as far as it is near, with all faces that share a node with one that is. Where meshes cross
/// or touch that are not joined, one tool could not be cut along both; nothing of it is kept. Vertices of the tool are
/// no node of an input and in no group.
void add_tools(const Model& tool, std::span<const NearPair> pairs, Complex& complex);

/// Makes one component of all meshes of the base again (0), and one of all copies of the tool.
///   returns   the component of the tool
std::uint32_t unite_components(Complex& complex);

}  // namespace meshgraft
