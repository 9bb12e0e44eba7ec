// Zones that have become much finer than the inputs, because the meshes leave a narrow detail between them.
#pragma once

#include <vector>

#include "merge/outcome.hpp"
#include "meshgraft/result.hpp"

namespace meshgraft {

struct FineZoneLimits {
  /// New triangles over those they replace. Merges of all kinds in our tests make up to 2.4 times as many, laps of a
  /// tenth of an edge 10 times.
  double many_times = 5;
  std::size_t worth_telling = 500;  // new triangles; fewer cost nobody anything
  /// The tolerance that is advised, over the edges of the smallest new triangle: those are 0.9 to 1.5 times as long as
  /// the detail is wide.
  double tolerance_share = 1.5;
};

/// The warning fine-zone, if there are many times more triangles than before: how many, where they are smallest, and
/// the tolerance that leaves the detail out.
[[nodiscard]] std::vector<Warning> fine_zone_warnings(const Outcome& outcome, const FineZoneLimits& limits = {});

}  // namespace meshgraft
