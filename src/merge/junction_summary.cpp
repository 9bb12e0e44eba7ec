#include "merge/junction_summary.hpp"

#include <algorithm>
#include <cmath>

#include "merge/edges.hpp"

namespace meshgraft {
namespace {

class Chainer {
 public:
  Chainer(const Complex& complex, std::span<const JunctionEdge> edges, const JunctionSummaryOptions& options)
      : complex_(complex), edges_(edges), turn_cosine_(std::cos(options.turn_angle)), done_(edges.size()) {
    for (std::uint32_t e = 0; e < edges.size(); ++e)
      for (const VertexId v : edges[e].ends) at_.emplace_back(v, e);
    std::sort(at_.begin(), at_.end());
  }

  std::vector<PolylineSummary> run() {
    std::vector<PolylineSummary> all;
    for (const bool open : {true, false})  // what is left after the open ones is closed
      for (std::uint32_t e = 0; e < edges_.size(); ++e)
        for (const VertexId v : edges_[e].ends)
          if (!done_[e] && (!open || is_end(v))) all.push_back(walk(e, v));
    return all;
  }

 private:
  std::span<const std::pair<VertexId, std::uint32_t>> edges_at(VertexId v) const {
    const auto range = std::ranges::equal_range(at_, v, {}, &std::pair<VertexId, std::uint32_t>::first);
    return {range.begin(), range.end()};
  }

  bool is_end(VertexId v) const {
    const auto edges = edges_at(v);
    return edges.size() != 2 || edges_[edges[0].second].inputs != edges_[edges[1].second].inputs;
  }

  bool is_turn(VertexId before, VertexId v, VertexId after) const {
    const auto& p = complex_.position;
    const Vec3 in = normalized(p[v.value] - p[before.value]), out = normalized(p[after.value] - p[v.value]);
    return dot(in, out) < turn_cosine_;
  }

  PolylineSummary walk(std::uint32_t e, VertexId start) {
    PolylineSummary line;
    line.inputs = edges_[e].inputs;
    line.nodes = 1;
    VertexId before, v = start, second;
    while (true) {
      done_[e] = true;
      const VertexId next = edges_[e].ends[0] == v ? edges_[e].ends[1] : edges_[e].ends[0];
      line.length += distance(complex_.position[v.value], complex_.position[next.value]);
      if (before.valid() && is_turn(before, v, next)) ++line.corners;
      if (!second.valid()) second = next;
      before = v, v = next;
      if (v == start && !is_end(v)) {
        line.closed = true;
        if (is_turn(before, v, second)) ++line.corners;
        return line;
      }
      ++line.nodes;
      if (is_end(v)) {
        line.corners += 2;
        return line;
      }
      const auto edges = edges_at(v);
      e = edges[0].second == e ? edges[1].second : edges[0].second;
    }
  }

  const Complex& complex_;
  std::span<const JunctionEdge> edges_;
  double turn_cosine_;
  std::vector<bool> done_;
  std::vector<std::pair<VertexId, std::uint32_t>> at_;  // ascending
};

}  // namespace

std::vector<JunctionEdge> junction_edges(const Complex& complex) {
  std::vector<std::uint32_t> first(complex.n_vertices(), 0xFFFFFFFF);
  std::vector<std::uint8_t> shared(complex.n_vertices());
  for (std::size_t f = 0; f < complex.n_faces(); ++f)
    for (const VertexId v : complex.face[f]) {
      std::uint32_t& component = first[v.value];
      if (component == 0xFFFFFFFF) component = complex.component[f];
      if (component != complex.component[f]) shared[v.value] = 1;
    }
  std::vector<JunctionEdge> edges;
  const std::vector<EdgeUse> uses = edge_uses(complex, shared);
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    std::vector<std::uint32_t> inputs;
    for (const EdgeUse& use : edge) inputs.push_back(complex.component[use.face.value]);
    std::sort(inputs.begin(), inputs.end());
    inputs.erase(std::unique(inputs.begin(), inputs.end()), inputs.end());
    if (inputs.size() > 1) edges.push_back({{edge[0].low, edge[0].high}, inputs});
  });
  return edges;
}

std::vector<PolylineSummary> polylines_of(const Complex& complex, std::span<const JunctionEdge> edges,
                                          const JunctionSummaryOptions& options) {
  return Chainer(complex, edges, options).run();
}

}  // namespace meshgraft
