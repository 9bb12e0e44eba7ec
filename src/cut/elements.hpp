// What goes with the dropped pieces of a base: elements out of the workpiece, and those that have no
// surface.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/complex.hpp"
#include "cut/base_pieces.hpp"
#include "geometry/triangle_surface.hpp"
#include "meshgraft/cut.hpp"
#include "meshgraft/report.hpp"
#include "meshgraft/result.hpp"

namespace meshgraft {

struct DroppedElements {
  std::vector<ElementId> elements;  // ascending; no faces of the complex, no lines on edges of them
  std::vector<Warning> warnings;    // elements that stay although nodes of theirs lost all surfaces
};

/// Elements that go:
///  (1) surface elements of dropped pieces;
///  (2) lines and solids whose nodes all belong to dropped pieces, or hang together with such over nodes
///      that no surface has. A part that hangs on no surface at all goes if it is on the dropped side of a
///      closed tool. One that the tool crosses, or that joins what stays with what goes, is an error: it
///      would have to be cut;
///  (3) springs, masses, rigid and other elements that have a node of what goes and none of what stays.
///      Those that have both stay, with all their nodes, and are named in a warning.
///
///   complex   cut along the tool; `goes`: by piece
///
/// Error kUnsupportedElement. Cost: a few linear passes over the elements.
[[nodiscard]] Result<DroppedElements> dropped_elements(const Model& base, const Complex& complex,
                                                       const BasePieces& pieces, std::span<const std::uint8_t> goes,
                                                       const TriangleSurface& tool, bool is_closed, const Drop& drop);

}  // namespace meshgraft
