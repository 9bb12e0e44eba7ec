// Second step of the remesher: new vertices in rows from the curves inwards.
#pragma once

#include "remesh/editor.hpp"

namespace meshgraft {

/// Removes the vertices inside the sheets that have changed so far, then fills the room by an
/// advancing front: each new vertex is the apex of a nearly equilateral triangle of the
/// wanted size on an edge that is final, and the mesh is kept Delaunay.
///
///  (1) Sheets whose faces are all as in the input, and good, stay (RemeshOptions::keeps_good). Keeping single good
///  vertices near
///      the rim of the zone was tried: rows of the front that end on them cost 0.04 of the mean Q.
///  (2) Without RemeshOptions::keeps_good all sheets are meshed anew, and vertices are removed when the front comes to
///  them:
///      across wide room without vertices each new one costs as many flips as the rim has edges.
///  (3) What the front leaves over is right in topology, but needs relaxing where fronts meet.
///
/// After Rebay, "Efficient unstructured mesh generation by means of Delaunay triangulation and
/// Bowyer-Watson algorithm", J. Comput. Phys. 106 (1993), with flips in place of cavities.
void advance_front(Editor& editor);

}  // namespace meshgraft
