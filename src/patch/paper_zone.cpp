#include "patch/paper_zone.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/box_tree.hpp"
#include "geometry/closest.hpp"
#include "zone/edge_table.hpp"
#include "zone/input_faces.hpp"

namespace meshgraft {
namespace {

constexpr int kMostWhereAlike = 2;

/// Edges around the touched faces of a component.
struct FirstBoundary {
  std::vector<std::array<Vec3, 2>> edges;
  std::vector<std::uint8_t> on_it;  // by vertex
  BoxTree tree;

  FirstBoundary(const Corefined& corefined, const EdgeTable& table, std::uint32_t component)
      : on_it(corefined.complex.n_vertices(), 0) {
    const Complex& complex = corefined.complex;
    std::vector<Box> boxes;
    for (std::size_t e = 0; e < table.size(); ++e) {
      const auto n = std::ranges::count_if(table.uses(EdgeId(e)), [&](const EdgeUse& use) {
        return complex.component[use.face.value] == component && corefined.touched[use.face.value] != 0;
      });
      if (n != 1) continue;
      const auto ends = table.ends(EdgeId(e));
      edges.push_back({complex.position[ends[0].value], complex.position[ends[1].value]});
      Box& box = boxes.emplace_back();
      for (const VertexId v : ends) on_it[v.value] = 1, box.add(complex.position[v.value]);
    }
    tree = BoxTree(boxes);
  }

  [[nodiscard]] double distance(Vec3 p) const {
    const auto nearest = tree.nearest(
        p, [&](std::uint32_t k) { return squared_norm(p - closest_on_segment(p, edges[k][0], edges[k][1]).point); });
    return std::sqrt(nearest.squared_distance);
  }
};

std::vector<VertexId> line_nodes(const Corefined& corefined) {
  std::vector<VertexId> nodes = corefined.junction_points;
  for (const auto& e : corefined.junction_edges) nodes.insert(nodes.end(), e.begin(), e.end());
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

double mean_touched_edge(const InputFaces& inputs, std::uint32_t component) {
  double sum = 0, count = 0;
  for (std::uint32_t i = 0; i < inputs.size(); ++i)
    if (inputs.touched(i) && inputs.component(i) == component) sum += inputs.mean_edge_length(i), ++count;
  return count > 0 ? sum / count : 0;
}

double least_distance(const Corefined& corefined, const std::vector<VertexId>& line, const EdgeTable& table,
                      std::uint32_t component) {
  const FirstBoundary boundary(corefined, table, component);
  std::vector<std::uint8_t> of_component(corefined.complex.n_vertices(), 0);
  for (std::size_t f = 0; f < corefined.complex.n_faces(); ++f)
    if (corefined.complex.component[f] == component)
      for (const VertexId v : corefined.complex.face[f]) of_component[v.value] = 1;
  double least = std::numeric_limits<double>::infinity();
  for (const VertexId v : line)
    if (of_component[v.value] != 0 && boundary.on_it[v.value] == 0)
      least = std::min(least, boundary.distance(corefined.complex.position[v.value]));
  return least;
}

/// Rounded ratio of the larger to the smaller, at most `most`.
int rounded_ratio(double a, double b, int most) {
  const double ratio = std::max(a, b) / std::min(a, b);
  return ratio < most ? static_cast<int>(std::lround(ratio)) : most;
}

}  // namespace

PaperBandwidth paper_bandwidth(const Corefined& corefined, std::uint32_t first, std::uint32_t second) {
  const InputFaces inputs(corefined);
  const EdgeTable table(corefined.complex);
  const std::vector<VertexId> line = line_nodes(corefined);
  PaperBandwidth b;
  b.l1a = mean_touched_edge(inputs, first), b.l2a = mean_touched_edge(inputs, second);
  if (!(b.l1a > 0 && b.l2a > 0)) return b;
  b.l_min = std::min(least_distance(corefined, line, table, first), least_distance(corefined, line, table, second));
  const int n = rounded_ratio(b.l1a, b.l2a, std::numeric_limits<int>::max());
  if (n > 1)
    (b.l1a < b.l2a ? b.n1 : b.n2) = n;
  else
    b.n1 = b.n2 = rounded_ratio(b.l_min, 0.25 * (b.l1a + b.l2a), kMostWhereAlike);
  return b;
}

Zone paper_zone(const Corefined& corefined) {
  const InputFaces inputs(corefined);
  Zone zone;
  zone.bandwidth.assign(n_components(corefined), 0);
  for (const auto& [a, b] : corefined.met) {
    const PaperBandwidth n = paper_bandwidth(corefined, a, b);
    zone.bandwidth[a] = std::max(zone.bandwidth[a], n.n1), zone.bandwidth[b] = std::max(zone.bandwidth[b], n.n2);
  }
  const int most = zone.bandwidth.empty() ? 0 : *std::ranges::max_element(zone.bandwidth);
  const std::vector<int> ring = inputs.rings(most);
  zone.in_zone.assign(corefined.complex.n_faces(), 0);
  for (std::size_t f = 0; f < zone.in_zone.size(); ++f) {
    const std::uint32_t i = inputs.of(FaceId(f));
    const bool near = ring[i] > 0 && ring[i] <= zone.bandwidth[inputs.component(i)];
    zone.in_zone[f] = near && !inputs.frozen(i) && !inputs.kept(i) ? 1 : 0;
  }
  return zone;
}

}  // namespace meshgraft
