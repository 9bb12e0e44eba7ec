// Free edges that come close to another mesh and were not joined with it.
#pragma once

#include <vector>

#include "merge/outcome.hpp"
#include "meshgraft/options.hpp"
#include "meshgraft/result.hpp"

namespace meshgraft {

struct NearMissLimits {
  /// An edge all of which is this near to another mesh, over its length, may have been meant to end on it.
  double max_distance = 0.25;
};

/// Warnings near-miss, one for each input with such edges and input that they are near to: how many edges, how far off,
/// where the nearest is, and whether that is within the tolerance. Edges with a joined end do not count: some leave the
/// junction at a small angle. Looked at is the workpiece, so that a part far away from all others is not among them.
/// Cost O(n log k) for n faces and k free edges.
[[nodiscard]] std::vector<Warning> near_miss_warnings(const Outcome& outcome, const Tolerance& tolerance,
                                                      const NearMissLimits& limits = {});

}  // namespace meshgraft
