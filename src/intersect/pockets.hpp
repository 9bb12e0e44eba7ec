// Pockets: two meshes that cross twice and hardly part in between.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "intersect/corefine.hpp"

namespace meshgraft {

/// Where a closed curve, or several, bound a piece of each side, and the two pieces are shallow and so narrow that no
/// face as large as those around fits in: kOverlap, with how deep and wide it is. Surfaces that are tangent, or nearly
/// so, come through each other in such spots. They are neither an area of contact nor a part of the model, and two
/// layers that near to each other cannot be remeshed without crossing anew.
///
///   sides   faces of both that are conforming, ascending; a piece that goes on beyond them is no pocket
///   size    by face of the complex: edge length there
///
/// Cost n log n in the faces of the sides.
[[nodiscard]] std::optional<JunctionFault> find_pocket(const Complex& complex,
                                                       const std::array<std::vector<FaceId>, 2>& sides,
                                                       std::span<const double> size);

}  // namespace meshgraft
