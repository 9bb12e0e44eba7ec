// Faces that were turned over when corners of them were drawn onto another mesh.
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

}  // namespace meshgraft
