#include "fill/patched.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/union_find.hpp"
#include "fill/beams.hpp"
#include "geometry/quality.hpp"
#include "patch/opening.hpp"
#include "zone/edge_table.hpp"

namespace meshgraft {
namespace {

constexpr double kFlatHeight = 1e-9;  // of the length of a rim: what it may leave its plane by if it is planar

/// Normals at the vertices of a hole, and whether all faces there lie in one plane with it.
struct RimNormals {
  std::map<VertexId, Vec3> at;
  bool planar = true;

  RimNormals(const Complex& c, const VertexFaces& faces_at, const Hole& hole) {
    const Vec3 across = area_of(c, hole), plane = normalized(across);
    const Vec3 origin = c.position[hole.front().vertices.front().value];
    const double length = length_of(c, hole);
    planar = norm(across) > kFlatHeight * length * length;  // the ends of a pipe cancel each other
    for (const Rim& rim : hole)
      for (const VertexId v : rim.vertices) {
        Vec3 sum;
        for (const FaceId f : faces_at[v]) {
          sum += area_vector(c.corners(f));
          for (const Vec3 p : c.corners(f)) planar = planar && std::abs(dot(p - origin, plane)) <= kFlatHeight * length;
        }
        at[v] = normalized(sum);
      }
    if (planar)
      for (auto& [v, n] : at) n = plane;
  }
};

using Faces = std::vector<std::array<VertexId, 3>>;

/// Faces that fill each region.
tl::expected<Faces, std::string> faces_of_regions(Opening& opening, std::span<const Region> regions,
                                                  const OpeningOptions& options) {
  Faces all;
  for (const Region& region : regions) {
    opening.contours = region;
    const auto fill = fill_opening(opening, options);
    if (!fill) return tl::unexpected(fill.error());
    all.insert(all.end(), fill->faces.begin(), fill->faces.end());
  }
  return all;
}

/// Faces that close a hole along the beams; the surface around is continued as far as that is possible.
tl::expected<Faces, std::string> faces_along(const FollowedBeams& beams, const Complex& c, const EdgeTable& edges,
                                             const Hole& hole, const RimNormals& normals) {
  const Vec3 across = normalized(area_of(c, hole));
  const Vec3 origin = c.position[hole.front().vertices.front().value];
  Opening opening;
  opening.planar =
      normals.planar && std::ranges::all_of(beams.normal, [&](const auto& at) {
        return std::abs(dot(c.position[at.first.value] - origin, across)) <= kFlatHeight * length_of(c, hole);
      });
  opening.position = [&](VertexId v) { return c.position[v.value]; };
  opening.normal = [&](VertexId v) {
    const auto it = normals.at.find(v);
    return it != normals.at.end() ? it->second : beams.normal.at(v);
  };
  opening.has_edge = [&](VertexId a, VertexId b) { return edges.find(a, b).valid(); };
  OpeningOptions options;
  const auto along = faces_of_regions(opening, beams.regions, options);
  if (along) return along;
  opening.normal = [&](VertexId) { return across; };  // a cap: the end of a pipe, a rim that is folded
  for (const double least_cosine : {options.least_cosine, 0.0}) {
    options.least_cosine = least_cosine;
    if (auto fill = faces_of_regions(opening, beams.regions, options)) return fill;
  }
  return along;
}

/// Faces that close a hole along the beams in it, or without them if that cannot be. What is followed and what is not
/// is added to `p`.
tl::expected<Faces, std::string> faces_of_hole(const Complex& c, const VertexFaces& faces_at, const EdgeTable& edges,
                                               const Hole& hole, LeftOut left_out, Patched& p) {
  const RimNormals normals(c, faces_at, hole);
  FollowedBeams beams = follow_beams(c, faces_at, edges, hole, normals.at, left_out);
  auto faces = faces_along(beams, c, edges, hole, normals);
  if (!faces && !beams.beams.empty()) {
    for (const NodePair& beam : beams.beams) left_out[beam] = Obstacle::kNoFaces;
    beams = follow_beams(c, faces_at, edges, hole, normals.at, left_out);
    faces = faces_along(beams, c, edges, hole, normals);
  }
  p.beams.insert(beams.beams.begin(), beams.beams.end());
  p.unfollowed.insert(p.unfollowed.end(), beams.unfollowed.begin(), beams.unfollowed.end());
  return faces;
}

/// The face of a hole's rims whose attributes hold along the greatest part of them.
FaceId typical_face(const Complex& c, const Hole& hole) {
  std::map<std::pair<AttributesId, std::uint32_t>, double> length;
  const auto key = [&](FaceId f) { return std::pair{c.face_attributes[f.value], c.component[f.value]}; };
  for (const Rim& rim : hole)
    for (std::size_t k = 0; k < rim.faces.size(); ++k) length[key(rim.faces[k])] += side_length(c, rim, k);
  const auto most = std::ranges::max_element(length, {}, [](const auto& entry) { return entry.second; });
  FaceId best;
  for (const Rim& rim : hole)
    for (const FaceId f : rim.faces)
      if (key(f) == most->first && (!best.valid() || c.parent[f.value] < c.parent[best.value])) best = f;
  return best;
}

}  // namespace

double side_length(const Complex& c, const Rim& rim, std::size_t k) {
  const VertexId a = rim.vertices[k], b = rim.vertices[(k + 1) % rim.vertices.size()];
  return distance(c.position[a.value], c.position[b.value]);
}

Region region_of(const Hole& hole) {
  Region rims;
  for (const Rim& rim : hole) rims.push_back(rim.vertices);
  return rims;
}

double length_of(const Complex& c, const Hole& hole) {
  double sum = 0;
  for (const Rim& rim : hole)
    for (std::size_t k = 0; k < rim.vertices.size(); ++k) sum += side_length(c, rim, k);
  return sum;
}

Vec3 area_of(const Complex& c, const Hole& hole) {
  Vec3 sum;
  const Vec3 origin = c.position[hole.front().vertices.front().value];
  for (const Rim& rim : hole)
    for (std::size_t k = 0; k < rim.vertices.size(); ++k)
      sum += 0.5 * cross(c.position[rim.vertices[k].value] - origin,
                         c.position[rim.vertices[(k + 1) % rim.vertices.size()].value] - origin);
  return sum;
}

NodePair nodes_of(const Complex& c, VertexId a, VertexId b) {
  const NodeRef first = c.node[a.value], second = c.node[b.value];
  return {std::min(first, second), std::max(first, second)};
}

std::vector<std::uint32_t> patches_of(const Complex& complex, std::size_t first, const std::set<NodePair>& beams) {
  const std::size_t n = complex.n_faces() - first;
  UnionFind together(n);
  std::map<std::array<VertexId, 2>, std::uint32_t> first_at;
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& v = complex.face[first + i];
      const auto [a, b] = std::minmax(v[k], v[(k + 1) % 3]);
      const auto [it, is_first] = first_at.try_emplace({a, b}, i);
      if (!is_first && !beams.contains(nodes_of(complex, a, b))) together.unite(it->second, i);
    }
  std::map<std::uint32_t, std::uint32_t> number;
  std::vector<std::uint32_t> patch;
  for (std::uint32_t i = 0; i < n; ++i)
    patch.push_back(number.try_emplace(together.find(i), static_cast<std::uint32_t>(number.size())).first->second);
  return patch;
}

tl::expected<Patched, NotClosed> patched(const Complex& around, std::span<const Hole> holes, const LeftOut& left_out,
                                         GroupSets& groups) {
  const VertexFaces faces_at(around);
  const EdgeTable edges(around);
  Patched p;
  p.complex = around, p.n_around = around.n_faces();
  for (std::size_t h = 0; h < holes.size(); ++h) {
    const auto faces = faces_of_hole(around, faces_at, edges, holes[h], left_out, p);
    if (!faces) return tl::unexpected(NotClosed{h, faces.error()});
    const FaceId like = typical_face(around, holes[h]);
    GroupSetId common = around.face_groups[like.value];
    for (const Rim& rim : holes[h])
      for (const FaceId f : rim.faces) common = groups.intersect(common, around.face_groups[f.value]);
    for (const auto& v : *faces) {
      const FaceId f = p.complex.add_face(v, around, like);
      p.complex.face_groups[f.value] = common;
    }
  }
  p.patch = patches_of(p.complex, p.n_around, p.beams);
  p.in_zone.assign(p.complex.n_faces(), 1);
  std::fill_n(p.in_zone.begin(), p.n_around, std::uint8_t{0});
  return p;
}

}  // namespace meshgraft
