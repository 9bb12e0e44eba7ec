// The tool of a cut as a triangle surface.
#pragma once

#include <optional>

#include "meshgraft/cut.hpp"

namespace meshgraft {

struct ToolSurface {
  Model model;                // triangles only, in no group; its path names the tool in messages
  std::size_t n_cutting = 0;  // faces from here on only close the surface, away from the base
  bool closed = false;
  std::optional<CylinderTool> round;  // that the faces are chords of; axis of length 1
};

/// Builds the surface of a tool so that all of the base is in its reach: cells of a few edges of the
/// base, a cylinder in facets so narrow that they leave it by a small share of an edge at most.
///
/// Errors: kUsage (a box without volume, no radius, no direction, a number that is not finite, less than 1/200
/// of an edge across),
/// kNoFaces, kUnsupportedElement (parabolic elements), kNotSeparated (open, and its faces are not
/// oriented alike).
[[nodiscard]] Result<ToolSurface> tool_surface(const Model& base, const CutTool& tool);

/// The same for a tool that is a mesh.
[[nodiscard]] Result<ToolSurface> mesh_tool(const Model& from);

}  // namespace meshgraft
