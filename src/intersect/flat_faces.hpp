// Faces that lost their area when their corners were moved onto one line.
#pragma once

#include <span>

#include "intersect/imprint.hpp"

namespace meshgraft {

/// Takes out each face that is no higher over its longest side than `height` (by face; negative: it stays). What
/// else is on that side, faces and lines, is split at the corner that came to lie on it, so that neighbours
/// stay neighbours. `marks` follows the faces.
///
///  (1) A face higher than `none` (no area but rounding) goes only where that makes the worst Q there better.
///  (2) Pieces of a face stand where the face stood.
///
/// Cost: n log n in the faces that may go and their neighbours, and one pass over all.
void take_out_flat_faces(Complex& complex, FaceMarks& marks, std::span<const double> height, double none);

}  // namespace meshgraft
