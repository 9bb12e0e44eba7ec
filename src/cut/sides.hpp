// Which pieces of the base are inside the tool, and which of them go.
#pragma once

#include <string>
#include <vector>

#include "cut/base_pieces.hpp"
#include "geometry/triangle_surface.hpp"
#include "intersect/corefine.hpp"
#include "meshgraft/cut.hpp"

namespace meshgraft {

enum class ToolSide : std::int8_t { kInside = -1, kUnknown = 0, kOutside = 1 };

/// By piece. A closed tool has every piece on one side: that of one place in it.
[[nodiscard]] std::vector<ToolSide> sides_of_closed(const BasePieces& pieces, const TriangleSurface& tool);

/// By piece. An open tool tells the side of a piece where the piece touches it: outside is where the
/// normals of the tool point. `name`: of the tool; `component`: its faces.
///
/// Error kNotSeparated if the tool has one piece on both sides, with the place where it ends.
[[nodiscard]] Result<std::vector<ToolSide>> sides_of_open(const BasePieces& pieces, const Corefined& corefined,
                                                          std::uint32_t component, const std::string& name);

/// By piece: 1 if it goes.
///
/// Errors: kUsage (no such group, or it is on both sides of the tool, or on no piece next to the cut),
/// kPartsApart (nothing goes, or everything).
[[nodiscard]] Result<std::vector<std::uint8_t>> dropped_pieces(const Model& base, const BasePieces& pieces,
                                                               const Complex& complex,
                                                               const std::vector<ToolSide>& sides,
                                                               const std::string& tool, const Drop& drop);

}  // namespace meshgraft
