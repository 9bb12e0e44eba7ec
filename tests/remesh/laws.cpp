#include "laws.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include "geometry/closest.hpp"
#include "geometry/quality.hpp"
#include "zone/neighbourhoods.hpp"
#include "zone/size_field.hpp"

namespace meshgraft::cut {
namespace {

using Place = std::tuple<double, double, double>;
Place place(Vec3 p) { return {p.x, p.y, p.z}; }

std::array<Place, 3> places(const Complex& c, std::size_t f) {
  std::array<Place, 3> p;
  for (std::size_t k = 0; k < 3; ++k) p[k] = place(c.position[c.face[f][k].value]);
  std::ranges::rotate(p, std::ranges::min_element(p));
  return p;
}

std::map<std::array<VertexId, 2>, int> edge_uses(const Complex& c) {
  std::map<std::array<VertexId, 2>, int> uses;
  for (const auto& v : c.face)
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId a = v[k], b = v[(k + 1) % 3];
      ++uses[{std::min(a, b), std::max(a, b)}];
    }
  return uses;
}

void check_kept(const Trial& t, std::vector<std::string>& broken) {
  const Complex &before = t.scene.complex, &after = t.result.complex;
  std::map<std::array<Place, 3>, std::size_t> at;
  for (std::size_t f = 0; f < after.n_faces(); ++f) at[places(after, f)] = f;
  for (std::size_t f = 0; f < before.n_faces(); ++f) {
    if (t.in_zone[f]) continue;
    const auto it = at.find(places(before, f));
    if (it == at.end()) {
      broken.push_back("a face outside the zone is gone");
    } else if (after.parent[it->second] != before.parent[f] || after.face_groups[it->second] != before.face_groups[f] ||
               t.result.in_zone[it->second]) {
      broken.push_back("a face outside the zone changed what it is");
    }
  }
  std::map<NodeRef, Vec3> stood;
  for (std::size_t v = 0; v < before.n_vertices(); ++v)
    if (before.node[v].valid()) stood[before.node[v]] = before.position[v];
  for (std::size_t v = 0; v < after.n_vertices(); ++v)
    if (after.node[v].valid() && !(stood.at(after.node[v]) == after.position[v])) broken.push_back("a node moved");
}

void check_conforming(const Trial& t, std::vector<std::string>& broken) {
  const Complex &before = t.scene.complex, &after = t.result.complex;
  std::set<std::array<VertexId, 3>> seen;
  for (auto v : after.face) {
    std::ranges::sort(v);
    if (!seen.insert(v).second) broken.push_back("two faces have the same corners");
  }
  // Length of edge by number of faces: conformity of the curves without naming them.
  const auto lengths = [](const Complex& c) {
    std::map<int, double> sum;
    for (const auto& [edge, n] : edge_uses(c))
      if (n != 2) sum[n] += distance(c.position[edge[0].value], c.position[edge[1].value]);
    return sum;
  };
  const auto old_sum = lengths(before), new_sum = lengths(after);
  for (const auto& [n, length] : old_sum)
    if (!new_sum.contains(n) || std::abs(new_sum.at(n) - length) > 0.01 * length)
      broken.push_back("edges with " + std::to_string(n) + " faces have another length");
  for (const auto& [n, length] : new_sum)
    if (!old_sum.contains(n)) broken.push_back("there are edges with " + std::to_string(n) + " faces");
}

void check_faces(const Trial& t, double area_share, std::vector<std::string>& broken) {
  const Complex &before = t.scene.original, &after = t.result.complex;
  std::map<std::uint32_t, double> old_area, new_area;
  for (std::size_t f = 0; f < before.n_faces(); ++f) old_area[before.component[f]] += area(before.corners(FaceId(f)));
  for (std::size_t f = 0; f < after.n_faces(); ++f) {
    new_area[after.component[f]] += area(after.corners(FaceId(f)));
    const auto parent = std::ranges::find(before.parent, after.parent[f]) - before.parent.begin();
    if (dot(area_vector(after.corners(FaceId(f))), area_vector(before.corners(FaceId(std::size_t(parent))))) <= 0)
      broken.push_back("a face does not face like its parent");
  }
  for (const auto& [component, sum] : old_area)
    if (std::abs(new_area[component] - sum) > area_share * sum)
      broken.push_back("component " + std::to_string(component) + " changed its area");
}

}  // namespace

Trial trial(Scene scene, int rings) {
  Trial t;
  t.scene = std::move(scene);
  t.in_zone = zone(t.scene, rings);
  t.brep = read_brep(t.scene.complex, t.scene.junction_edges, {}, t.scene.groups);
  const SizeField size(t.scene.original, t.scene.complex, t.brep, {});
  t.result = remesh(t.scene.complex, t.brep, size, t.in_zone, t.scene.groups);
  return t;
}

std::vector<std::string> broken_laws(const Trial& t, double area_share) {
  std::vector<std::string> broken;
  check_kept(t, broken);
  check_conforming(t, broken);
  check_faces(t, area_share, broken);
  std::ranges::sort(broken);
  broken.erase(std::unique(broken.begin(), broken.end()), broken.end());
  return broken;
}

std::vector<double> new_qualities(const Trial& t) {
  const Complex &before = t.scene.complex, &after = t.result.complex;
  std::set<std::array<Place, 3>> old;
  for (std::size_t f = 0; f < before.n_faces(); ++f) old.insert(places(before, f));
  std::vector<double> q;
  for (std::size_t f = 0; f < after.n_faces(); ++f)
    if (t.result.in_zone[f] && !old.contains(places(after, f))) q.push_back(aspect_ratio(after.corners(FaceId(f))));
  std::ranges::sort(q);
  return q;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace meshgraft::cut
