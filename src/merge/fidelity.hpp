// How far the new faces are from the surface they replace.
#pragma once

#include <vector>

#include "merge/outcome.hpp"
#include "meshgraft/options.hpp"
#include "meshgraft/report.hpp"

namespace meshgraft {

struct FidelityLimits {
  /// Distance of a new face from the input surface, over the edge length of the input, that no
  /// triangulation of about the same size needs to exceed.
  double max_relative = 0.1;
  /// Distances below this share of the edge length are rounding and count as none.
  double negligible = 1e-9;
};

struct FidelityVerdict {
  Report::Fidelity figures;
  std::vector<Error> broken;
};

/// Measures corners, middles of edges and centroids of new faces against the removed faces of the
/// same component, also as these are with their nodes where gaps were closed. Cost O(log n) per new face.
[[nodiscard]] FidelityVerdict fidelity_of(const Outcome& outcome, const Tolerance& tolerance,
                                          const FidelityLimits& limits = {});

}  // namespace meshgraft
