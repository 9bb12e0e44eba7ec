// Open seams: nodes and free edges of one mesh in one place that are not connected (unmerged nodes, a crack).
#pragma once

#include <vector>

#include "core/complex.hpp"
#include "zone/edge_table.hpp"

namespace meshgraft {

/// Free edges in the place of another free edge of the same component, up to 1e-4 of the mean edge length; ascending.
/// Only longer ones count.
/// Cost O(m + k log k) for k free edges.
[[nodiscard]] std::vector<EdgeId> seam_edges(const Complex& complex, const EdgeTable& edges);

/// By vertex: the first one of `among` with a node of the same input in the same place, up to 1e-4 of the mean edge
/// length; itself if there is none, and if it is not among them. `among`: any vertices; those that are no nodes
/// of an input do not count. Cost O(m + k log k) for k of them.
[[nodiscard]] std::vector<VertexId> place_of_nodes(const Complex& complex, std::vector<VertexId> among);

}  // namespace meshgraft
