// Free edges before and after a merge.
#pragma once

#include <vector>

#include "merge/edges.hpp"
#include "merge/outcome.hpp"
#include "meshgraft/options.hpp"

namespace meshgraft {

struct FreeEdgeChanges {
  std::vector<FaceOnEdge> cracks;  // free edges of the final complex where none was
  std::vector<FaceOnEdge> closed;  // free edges of the original complex that are neither free nor on the junction now
};

/// Compares free edges around whatever changed. Edges correspond if they have the same nodes, or if
/// ends and middle of one are within `max_distance` times its length, or the tolerance, of the others. Edges of the
/// junction count by their own length instead, if that is greater.
/// Edges of what was dropped count as gone with reason, its borders as free before.
[[nodiscard]] FreeEdgeChanges free_edge_changes(const Outcome& outcome, const Tolerance& tolerance,
                                                double max_distance);

}  // namespace meshgraft
