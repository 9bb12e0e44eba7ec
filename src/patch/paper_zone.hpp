// The zone as the paper chooses it (5.4).
#pragma once

#include <vector>

#include "intersect/corefine.hpp"
#include "zone/neighbourhoods.hpp"

namespace meshgraft {

/// What the choice of the bandwidth rests on, for two meshes that meet.
struct PaperBandwidth {
  double l1a = 0, l2a = 0;  // mean edge lengths of the touched faces
  double l_min = 0;         // least distance from the line to the boundary of its first neighbourhood
  int n1 = 1, n2 = 1;       // neighbourhoods deleted
};

/// N = round(max(l1a, l2a) / min(l1a, l2a)). If N = 1: N = min(round(max(l_min, l_a/2) / min(l_min, l_a/2)), 2) on
/// both; else 1 on the coarser mesh and N on the finer. Nodes of the line that are on the boundary do not count in
/// l_min, and l_a is the mean of both lengths.
[[nodiscard]] PaperBandwidth paper_bandwidth(const Corefined& corefined, std::uint32_t first, std::uint32_t second);

/// Neighbourhoods 1..N of all meshes that meet, N being the largest asked for by any pair.
[[nodiscard]] Zone paper_zone(const Corefined& corefined);

}  // namespace meshgraft
