// Folds in the new mesh where the inputs have none.
#pragma once

#include <vector>

#include "geometry/angles.hpp"
#include "merge/outcome.hpp"
#include "meshgraft/result.hpp"

namespace meshgraft {

struct CreaseLimits {
  /// Edges folded more than this are sharp, in radians; as for the curves of the zone.
  double sharp_angle = radians(30);
  /// By how much more an edge is folded that is a crease, in radians: facets of a coarse curved surface may be just
  /// below the limit, and those that replace them just above.
  double margin = radians(10);
  /// A crease within this of a sharp, free or non-manifold edge of an input, or of the junction, over the edge length
  /// of the input, is that edge.
  double beside = 0.15;
};

/// Warnings new-crease, one for each input with edges of new faces that are folded where its surface is not: how many,
/// the sharpest, where. Not where holes are filled. Cost n log n in the zone, and in the workpiece if there are any.
[[nodiscard]] std::vector<Warning> crease_warnings(const Outcome& outcome, const CreaseLimits& limits = {});

}  // namespace meshgraft
