// Edges that were cut and become whole again.
#pragma once

#include <vector>

#include "intersect/imprint.hpp"

namespace meshgraft {

/// An edge as it was cut: its ends, and the points between in order.
struct CutEdge {
  std::vector<VertexId> chain;
  std::vector<std::uint8_t> may_go;  // by position; ends stay
};

/// Faces before their edges were cut.
struct UncutFaces {
  std::vector<std::array<VertexId, 3>> corners;
  std::vector<std::uint8_t> touched;
};

/// Takes points out of edges again: the faces on each side of an edge at such a point are filled anew
/// without it, lines on the edge become one. `marks` follows the faces.
///
///  (1) A point stays if the faces at it are not fans from its neighbour on the edge before to the one after.
///  (2) A face that no point is left of is again what it was in `before` (by face of `marks.from`).
///  (3) A new face descends from the face of the fan that its middle lies on, and stands where that stood.
///  (4) Returned is what each parent has gained and lost by (3).
[[nodiscard]] std::vector<Corefined::Traded> take_out_points(Complex& complex, FaceMarks& marks,
                                                             const std::vector<CutEdge>& edges,
                                                             const UncutFaces& before);

}  // namespace meshgraft
