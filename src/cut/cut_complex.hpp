// The base near the tool, and the tool near the base, as one complex.
#pragma once

#include <span>
#include <vector>

#include "core/complex.hpp"
#include "cut/tool_surface.hpp"
#include "meshgraft/group_sets.hpp"

namespace meshgraft {

inline constexpr std::uint32_t kTool = 1;  // input of the faces of the tool

struct FacesToCut {
  std::vector<ElementId> of_base;  // ascending
  std::vector<ElementId> of_tool;  // ascending, with all faces that share a node with one that is near
};

/// The faces that come near the other side. The tool may have faces far larger than those of the base, so
/// that boxes alone would tell little. Cost: one pass over the base, O(log t) for each of its faces.
[[nodiscard]] FacesToCut near_faces(const Model& base, const ToolSurface& tool, const Tolerance& tolerance);

/// Adds faces of the tool as a component of its own, after all others. Their vertices are no node of an
/// input and in no group.
///   returns   the component
std::uint32_t add_tool(const Model& tool, std::span<const ElementId> faces, Complex& complex);

}  // namespace meshgraft
