// Faces that lost their area when their corners were moved onto one line.
#pragma once

#include "intersect/imprint.hpp"

namespace meshgraft {

/// Takes out the faces marked in `may_go` that are no higher than `height` over their longest side. What
/// else is on that side, faces and lines, is split at the corner that came to lie on it, so that neighbours
/// stay neighbours. `marks` and `may_go` follow the faces.
void take_out_flat_faces(Complex& complex, FaceMarks& marks, std::vector<std::uint8_t>& may_go, double height);

}  // namespace meshgraft
