// Pockets: two meshes that cross twice and hardly part in between.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "intersect/corefine.hpp"

namespace meshgraft {

/// A spot in which two sides come through each other by little: a closed curve, or several, bound a piece of each, and
/// the two pieces are shallow and so narrow that no face as large as those around fits in. Surfaces that are tangent,
/// or nearly so, have such spots.
struct Pocket {
  std::array<std::vector<FaceId>, 2> faces;    // of the pieces, ascending
  std::vector<std::array<VertexId, 2>> walls;  // the curves: (smaller, larger) vertex, ascending
  double width = 0, depth = 0;
};

/// In the order of their first face on the second side.
///
///   sides   faces of both that are conforming, ascending; a piece that goes on beyond them is no pocket
///   size    by face of the complex: edge length there; that of the second side counts
///
/// Cost n log n in the faces of the sides.
[[nodiscard]] std::vector<Pocket> find_pockets(const Complex& complex, const std::array<std::vector<FaceId>, 2>& sides,
                                               std::span<const double> size);

/// kOverlap: a pocket is neither an area of contact nor a part of the model, and two layers that near to each other
/// cannot be remeshed without crossing anew.
[[nodiscard]] JunctionFault pocket_fault(const Complex& complex, std::span<const double> size, const Pocket& pocket);

}  // namespace meshgraft
