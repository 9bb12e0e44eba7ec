// Curve edges joined into chains.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "zone/curve_edges.hpp"
#include "zone/edge_table.hpp"

namespace meshgraft {

/// The curve edges at each vertex.
struct CurveDegree {
  CurveDegree(const EdgeTable& edges, const CurveEdges& curves, std::size_t n_vertices);
  std::vector<std::uint32_t> count;           // by vertex
  std::vector<std::array<EdgeId, 2>> around;  // by vertex: the first two, ascending
  /// Two curve edges of one kind: a curve may go on through the vertex.
  [[nodiscard]] bool passes(VertexId v, const CurveEdges& curves) const;
};

struct Chain {
  std::vector<VertexId> vertices;  // a closed chain repeats the first at the end
  std::vector<EdgeId> edges;       // one fewer
  bool closed = false;             // no corner on it
};

/// Every curve edge in one chain. Chains end at vertices marked in `corner`; all vertices with other
/// than two curve edges must be.
///
/// Order: by the smallest edge. Direction: from the smaller end; a closed chain starts at its smallest
/// vertex towards the smaller neighbour.
[[nodiscard]] std::vector<Chain> chains(const EdgeTable& edges, const CurveEdges& curves, const CurveDegree& degree,
                                        std::span<const std::uint8_t> corner);

/// Vertices inside a chain where it turns by more than `turn_angle`. The turn is measured between the
/// directions to the points `reach` (by vertex) away, so that the noise of very short edges does not
/// count and a small chamfer does; of several such vertices within that reach only the sharpest one is given, and none
/// if that is within reach of an end of the chain.
[[nodiscard]] std::vector<VertexId> sharp_turns(const Chain& chain, std::span<const Vec3> position,
                                                std::span<const double> reach, double turn_angle);

}  // namespace meshgraft
