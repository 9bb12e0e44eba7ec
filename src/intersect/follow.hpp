// Vertices that follow when their neighbours were drawn onto another mesh.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "intersect/imprint.hpp"

namespace meshgraft {

/// Where the border of a side was drawn onto another mesh, a face across that way (a web on the side) is turned over
/// if another corner is nearer to the border than the way is long. Such corners follow: by half the way, or all of it.
///
///   is_drawn  by face: of that side
///   moved     vertices and where they were; those that follow are added
///
///  (1) Only open vertices follow that no face of another side has.
///  (2) No face is turned over that was not.
///
/// Cost: one pass over the faces.
void let_neighbours_follow(Complex& complex, const FaceMarks& marks, std::span<const std::uint8_t> is_drawn,
                           std::vector<std::pair<VertexId, Vec3>>& moved);

/// The same once all is joined, for faces that come down steeply beside a gap that was closed, whether turned over or
/// not: remeshed, they would be folds that the input does not have. What joins depended on is no matter any more.
///
///   original   before anything was joined; each face of `corefined.complex` descends from one of it
///   returns    the vertices that followed and where they were
///
///  (1) Only open vertices follow whose faces are all of one component, lie on nothing and are not kept.
///  (2) No face becomes steep that was not.
///
/// Cost: n log n in the faces, none where nothing was drawn.
[[nodiscard]] std::vector<std::pair<VertexId, Vec3>> ease_slopes(Corefined& corefined, const Complex& original);

}  // namespace meshgraft
