#include "merge/junction_summary.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "intersect/shared.hpp"
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
    return edges.size() != 2 || !edges_[edges[0].second].continues(edges_[edges[1].second]);
  }

  bool is_turn(VertexId before, VertexId v, VertexId after) const {
    const auto& p = complex_.position;
    const Vec3 in = normalized(p[v.value] - p[before.value]), out = normalized(p[after.value] - p[v.value]);
    return dot(in, out) < turn_cosine_;
  }

  PolylineSummary walk(std::uint32_t e, VertexId start) {
    PolylineSummary line;
    line.kind = edges_[e].name();
    line.components = edges_[e].components;
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

/// `components`: one entry for each face.
bool each_occurs_twice(const std::vector<std::uint32_t>& components) {
  return std::ranges::all_of(components, [&](std::uint32_t c) { return std::ranges::count(components, c) > 1; });
}

void make_distinct(std::vector<std::uint32_t>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace

Junction junction_of(const Complex& complex) {
  const std::vector<std::uint8_t> shared = shared_vertices(complex);
  Junction junction;
  std::vector<std::uint8_t> on_edge(complex.n_vertices());
  const std::vector<FaceOnEdge> uses = edge_uses(complex, shared);
  for_each_edge(uses, [&](std::span<const FaceOnEdge> edge) {
    JunctionEdge e{{edge[0].low, edge[0].high}, {}};
    bool alike = true, overlaid = false;
    for (const FaceOnEdge& use : edge) {
      const std::vector<std::uint32_t> of = complex.components_of(use.face);
      e.components.insert(e.components.end(), of.begin(), of.end());
      overlaid = overlaid || of.size() > 1;
      alike = alike && complex.are_of_the_same(use.face, edge[0].face);
    }
    if (alike) return;
    e.kind = overlaid                          ? JunctionEdge::kOverlap
             : each_occurs_twice(e.components) ? JunctionEdge::kCrossing
                                               : JunctionEdge::kTouching;
    make_distinct(e.components);
    if (!any_joined(complex.joins, e.components)) return;
    for (const VertexId v : e.ends) on_edge[v.value] = 1;
    junction.edges.push_back(std::move(e));
  });
  std::map<VertexId, std::vector<std::uint32_t>> points;
  for (std::size_t f = 0; f < complex.n_faces(); ++f)
    for (const VertexId v : complex.face[f])
      if (shared[v.value] && !on_edge[v.value]) points[v].push_back(complex.component[f]);
  for (auto& [v, components] : points) {
    make_distinct(components);
    if (any_joined(complex.joins, components)) junction.points.push_back({v, std::move(components)});
  }
  return junction;
}

std::vector<PolylineSummary> polylines_of(const Complex& complex, const Junction& junction,
                                          const Components& components, const JunctionSummaryOptions& options) {
  std::vector<PolylineSummary> all = Chainer(complex, junction.edges, options).run();
  for (const JunctionPoint& p : junction.points) all.push_back({"point", false, 0, 1, 1, {}, p.components});
  for (PolylineSummary& line : all) {
    for (const std::uint32_t c : line.components) line.inputs.push_back(components.input[c]);
    make_distinct(line.inputs);
    if (!components.are_parted()) line.components.clear();
  }
  return all;
}

}  // namespace meshgraft
