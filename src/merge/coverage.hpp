// Whether all of the surface that was removed is there again, under the same name.
#pragma once

#include <vector>

#include "merge/outcome.hpp"
#include "meshgraft/options.hpp"
#include "meshgraft/report.hpp"

namespace meshgraft {

struct CoverageLimits {
  /// Distance between the surface to remesh and the new faces, over the edge length of the input, that no
  /// triangulation of about the same size needs to exceed.
  double max_relative = 0.1;
};

struct CoverageVerdict {
  Report::Fidelity::Removed figures;
  std::vector<Error> broken;
};

/// Measures from the faces that were to be remeshed (as they were cut, with their nodes where gaps were closed) to the
/// new ones: a hole or a bulge that was filled flat, and a face at the wrong side of a border between groups, are not
/// seen from the new faces. Compared are faces of the same components, groups and attributes only; the other way,
/// centroids of new faces must be as near to such a face that was to be remeshed. Cost O(log n) for each face.
[[nodiscard]] CoverageVerdict coverage_of(const Outcome& outcome, const Tolerance& tolerance,
                                          const CoverageLimits& limits = {});

}  // namespace meshgraft
