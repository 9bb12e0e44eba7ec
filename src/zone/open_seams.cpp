#include "zone/open_seams.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "core/distinct.hpp"
#include "geometry/box_tree.hpp"
#include "geometry/closest.hpp"
#include "geometry/coincident_nodes.hpp"
#include "geometry/quality.hpp"

namespace meshgraft {
namespace {

constexpr double kOnePlace = 1e-4;  // of the mean edge length

double width_of_a_place(const Complex& complex) {
  double edges = 0;
  for (std::size_t f = 0; f < complex.n_faces(); ++f) edges += mean_edge_length(complex.corners(FaceId(f)));
  return kOnePlace * edges / static_cast<double>(std::max<std::size_t>(complex.n_faces(), 1));
}

using Segment = std::array<Vec3, 2>;

bool are_in_one_place(const Segment& a, const Segment& b, double width) {
  const auto near = [&](std::size_t i, std::size_t j) { return distance(a[i], b[j]) <= width; };
  return (near(0, 0) && near(1, 1)) || (near(0, 1) && near(1, 0));
}

}  // namespace

std::vector<EdgeId> seam_edges(const Complex& complex, const EdgeTable& edges) {
  const auto segment = [&](EdgeId e) {
    const auto [a, b] = edges.ends(e);
    return Segment{complex.position[a.value], complex.position[b.value]};
  };
  std::vector<EdgeId> free;
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (edges.uses(EdgeId(i)).size() == 1) free.emplace_back(i);
  const double width = free.empty() ? 0 : width_of_a_place(complex);
  // The ends of shorter ones, which a cut beside a row of nodes leaves, are in one place with their neighbours'.
  std::erase_if(free, [&](EdgeId e) { return distance(segment(e)[0], segment(e)[1]) <= width; });
  const auto component = [&](EdgeId e) { return complex.component[edges.uses(e)[0].face.value]; };
  std::vector<Box> boxes(free.size());
  for (std::size_t i = 0; i < free.size(); ++i) {
    for (const Vec3 p : segment(free[i])) boxes[i].add(p);
    boxes[i] = boxes[i].grown(width);
  }
  const BoxTree tree(boxes);
  std::vector<EdgeId> seams;
  for (std::uint32_t i = 0; i < free.size(); ++i) {
    bool found = false;
    tree.overlapping(boxes[i], [&](std::uint32_t j) {
      found = found || (i != j && component(free[i]) == component(free[j]) &&
                        are_in_one_place(segment(free[i]), segment(free[j]), width));
    });
    if (found) seams.push_back(free[i]);
  }
  return seams;
}

std::vector<VertexId> place_of_nodes(const Complex& complex, std::vector<VertexId> among) {
  std::vector<VertexId> place(complex.n_vertices());
  for (std::size_t v = 0; v < place.size(); ++v) place[v] = VertexId(v);
  make_distinct(among);
  std::map<std::uint32_t, std::vector<VertexId>> nodes;  // by input
  for (const VertexId v : among)
    if (const NodeRef node = complex.node[v.value]; node.valid()) nodes[node.input].push_back(v);
  const double width = nodes.empty() ? 0 : width_of_a_place(complex);
  std::vector<Vec3> position;
  for (const auto& [input, vertices] : nodes) {
    position.clear();
    for (const VertexId v : vertices) position.push_back(complex.position[v.value]);
    for (const auto& [first, second] : coincident_nodes(position, width))
      place[vertices[second].value] = vertices[first];
  }
  return place;
}

}  // namespace meshgraft
