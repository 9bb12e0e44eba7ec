// The result is checked before it is used: nothing that a merge must not do has happened.
#pragma once

#include <vector>

#include "geometry/angles.hpp"
#include "merge/group_table.hpp"
#include "merge/outcome.hpp"
#include "meshgraft/options.hpp"
#include "meshgraft/result.hpp"

namespace meshgraft {

struct ResultCheckLimits {
  /// How far a new free edge may be from the free edge it replaces, over its length.
  double free_edge_distance = 0.1;
  /// Angle between two faces on one edge, in radians, below which one is folded onto the other.
  double fold_angle = radians(1);
  /// Findings of each kind that are listed one by one.
  std::size_t max_listed = 10;
};

struct ResultVerdict {
  std::vector<Error> broken;      // kPromiseBroken with labels and places
  std::vector<Warning> warnings;  // faults of the inputs that the merge left where they were
};

/// All findings.
///
///  (1) No two faces meet but in shared nodes and edges, unless their parents, of one input, did.
///  (2) No two faces lie on the same three nodes, no face is folded onto a neighbour, and no two 1D elements from
///      different places lie on the same two nodes.
///  (3) Each new free edge lies along a free edge of an input; each free edge that went is on
///      another free edge or on the junction.
///  (4) New faces are oriented as their parents, and are in their groups.
///  (5) No node that other elements need is gone.
///
/// Warnings are: doubled-line, where 1D elements of one type of different meshes lie on one edge now; doubled-face,
/// where two faces of an input at the zone are on the same nodes (both were left as they are), and input-intersects,
/// where faces of the zone intersect because their parents did.
[[nodiscard]] ResultVerdict check_result(const Outcome& outcome, SetTranslation& translated, const Tolerance& tolerance,
                                         const ResultCheckLimits& limits = {});

}  // namespace meshgraft
