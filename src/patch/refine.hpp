// Density of a filled area: nodes at centroids, swaps by Q (paper 5.6).
#pragma once

#include "remesh/editor.hpp"

namespace meshgraft {

struct RefineOptions {
  /// A node is put at the centroid of a face if its distance to each corner, times this, exceeds the size wanted at
  /// the corner and at the centroid (Pfeifle and Seidel 1996; Liepa 2003).
  double density = 1.4142135623730951;
  int most_rounds = 40;  // of inserting and swapping; each thirds the faces that are too large
};

/// Inserts nodes at centroids of the faces made since they were deleted, and swaps edges between them where the
/// worse of the two faces becomes better and none folds back on a neighbour, until the density is that wanted by
/// Editor::size. Nodes are put on the faces as they are, not on the surface that was there.
///
///   filled   by sheet: whether its faces were filled anew
void refine(Editor& editor, const std::vector<std::uint8_t>& filled, const RefineOptions& options = {});

}  // namespace meshgraft
