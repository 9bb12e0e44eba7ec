#include "cut.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "geometry/closest.hpp"
#include "support/scenes.hpp"

namespace meshgraft::cut {
namespace {

constexpr double kOn = 1e-9;  // of the sizes of the scenes, which are about 1

std::array<VertexId, 2> ordered(VertexId a, VertexId b) {
  return a < b ? std::array<VertexId, 2>{a, b} : std::array<VertexId, 2>{b, a};
}

/// Replaces face f by those on `pieces`.
void replace(Scene& scene, FaceId f, const std::vector<std::array<VertexId, 3>>& pieces) {
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (k == 0) {
      scene.complex.face[f.value] = pieces[0];
      scene.touched[f.value] = 1;
      continue;
    }
    scene.complex.add_face(pieces[k], scene.complex, f);
    scene.touched.push_back(1);
  }
}

void tidy(Scene& scene) {
  auto& edges = scene.junction_edges;
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
}

}  // namespace

void add(Scene& scene, const Model& model, std::uint32_t component) {
  Complex& c = scene.complex;
  const std::size_t offset = c.n_vertices();
  for (std::size_t n = 0; n < model.n_nodes(); ++n)
    c.add_vertex(model.position[n], {component, NodeId(n)}, VertexState::kOpen, GroupSets::kEmpty);
  const GroupSetId groups = scene.groups.intern({GroupId(std::size_t{component})});
  for (std::size_t e = 0; e < model.n_elements(); ++e) {
    std::array<VertexId, 3> v;
    for (std::size_t k = 0; k < 3; ++k) v[k] = VertexId(offset + model.nodes_of(ElementId(e))[k].value);
    c.face.push_back(v);
    c.parent.push_back({component, ElementId(e)});
    c.component.push_back(component);
    c.face_groups.push_back(groups);
    c.face_attributes.emplace_back(std::size_t{0});
    scene.touched.push_back(0);
  }
}

void split(Scene& scene, std::uint32_t component, const std::function<double(Vec3)>& side) {
  Complex& c = scene.complex;
  std::map<std::array<VertexId, 2>, VertexId> at;
  const auto sign = [&](VertexId v) {
    const double s = side(c.position[v.value]);
    return std::abs(s) < kOn ? 0 : s > 0 ? 1 : -1;
  };
  const auto crossing_of = [&](VertexId a, VertexId b) {
    const auto key = ordered(a, b);
    const auto [it, fresh] = at.try_emplace(key);
    if (fresh) {
      const Vec3 p = c.position[key[0].value], q = c.position[key[1].value];
      const double s = side(p), t = side(q);
      it->second = c.add_vertex(lerp(p, q, s / (s - t)), NodeRef{}, VertexState::kOpen, GroupSets::kEmpty);
    }
    return it->second;
  };
  const std::size_t m = c.n_faces();
  for (std::size_t f = 0; f < m; ++f) {
    if (c.component[f] != component) continue;
    const auto v = c.face[f];
    std::array<int, 3> s{sign(v[0]), sign(v[1]), sign(v[2])};
    for (std::size_t k = 0; k < 3; ++k)
      if (s[k] == 0 && s[(k + 1) % 3] == 0) {
        scene.junction_edges.push_back(ordered(v[k], v[(k + 1) % 3]));
        scene.touched[f] = 1;
      }
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId a = v[k], b = v[(k + 1) % 3], d = v[(k + 2) % 3];
      if (s[k] == 0 && s[(k + 1) % 3] * s[(k + 2) % 3] < 0) {
        const VertexId x = crossing_of(b, d);
        replace(scene, FaceId(f), {{a, b, x}, {a, x, d}});
        scene.junction_edges.push_back(ordered(a, x));
      }
      if (s[k] * s[(k + 1) % 3] < 0 && s[k] * s[(k + 2) % 3] < 0) {
        const VertexId x = crossing_of(a, b), y = crossing_of(a, d);
        replace(scene, FaceId(f), {{a, x, y}, {x, b, d}, {x, d, y}});
        scene.junction_edges.push_back(ordered(x, y));
      }
    }
  }
  for (const auto& [edge, x] : at)  // an earlier cut may have been cut
    if (std::erase(scene.junction_edges, edge) > 0) {
      scene.junction_edges.push_back(ordered(edge[0], x));
      scene.junction_edges.push_back(ordered(edge[1], x));
    }
  tidy(scene);
}

void join(Scene& scene, Vec3 a, Vec3 b) {
  Complex& c = scene.complex;
  std::vector<std::pair<double, VertexId>> on;
  for (std::size_t v = 0; v < c.n_vertices(); ++v) {
    const SegmentPoint p = closest_on_segment(c.position[v], a, b);
    if (distance(p.point, c.position[v]) < kOn) on.emplace_back(p.t, VertexId(v));
  }
  std::ranges::sort(on);
  std::vector<VertexId> same(c.n_vertices());
  for (std::size_t v = 0; v < same.size(); ++v) same[v] = VertexId(v);
  std::vector<std::pair<double, VertexId>> points;
  for (const auto& [t, v] : on) {
    if (!points.empty() && t - points.back().first < kOn) {
      same[v.value] = points.back().second;
      if (c.node[v.value].valid() && !c.node[points.back().second.value].valid())
        c.node[points.back().second.value] = c.node[v.value];
    } else {
      points.emplace_back(t, v);
    }
  }
  for (auto& face : c.face)
    for (VertexId& v : face) v = same[v.value];
  std::map<VertexId, std::size_t> rank;
  for (std::size_t k = 0; k < points.size(); ++k) rank[points[k].second] = k;
  for (std::size_t f = 0; f < c.n_faces(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto v = c.face[f];
      const auto i = rank.find(v[k]), j = rank.find(v[(k + 1) % 3]);
      if (i == rank.end() || j == rank.end()) continue;
      std::vector<VertexId> chain{v[k]};
      for (std::size_t r = i->second; r != j->second;) {
        i->second < j->second ? ++r : --r;
        chain.push_back(points[r].second);
      }
      std::vector<std::array<VertexId, 3>> pieces;
      for (std::size_t r = 0; r + 1 < chain.size(); ++r) pieces.push_back({chain[r], chain[r + 1], v[(k + 2) % 3]});
      replace(scene, FaceId(f), pieces);
      break;
    }
  scene.junction_edges.clear();
  for (std::size_t k = 0; k + 1 < points.size(); ++k)
    scene.junction_edges.push_back(ordered(points[k].second, points[k + 1].second));
  tidy(scene);
}

std::vector<std::uint8_t> zone(const Scene& scene, int rings) {
  std::vector<std::uint8_t> in = scene.touched;
  std::vector<std::uint8_t> on(scene.complex.n_vertices(), 0);
  for (int r = 1; r < rings; ++r) {
    for (std::size_t f = 0; f < in.size(); ++f)
      if (in[f])
        for (const VertexId v : scene.complex.face[f]) on[v.value] = 1;
    for (std::size_t f = 0; f < in.size(); ++f)
      for (const VertexId v : scene.complex.face[f])
        if (on[v.value]) in[f] = 1;
  }
  return in;
}

Scene crossing(double size, double part_size, double degrees, double y0, double turn, double jitter) {
  const double angle = degrees * std::numbers::pi / 180;
  const Vec3 along{std::cos(turn), std::sin(turn), 0}, across{-std::sin(turn), std::cos(turn), 0};
  const Vec3 up = std::cos(angle) * across + Vec3{0, 0, std::sin(angle)};
  const Vec3 middle{1, y0, 0};
  double from = -10, to = 10;  // where the line enters and leaves the base
  for (std::size_t axis = 0; axis < 2; ++axis) {
    if (std::abs(along[axis]) < kOn) continue;
    const double s = -middle[axis] / along[axis], t = (2 - middle[axis]) / along[axis];
    from = std::max(from, std::min(s, t)), to = std::min(to, std::max(s, t));
  }
  const Vec3 a = middle + from * along, b = middle + to * along;
  Scene scene;
  add(scene, scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, size, "BASE", jitter), 0);
  add(scene, scenes::plate(a - 0.37 * up, b - a, 0.8 * up, part_size, "PART", jitter), 1);
  scene.original = scene.complex;
  split(scene, 0, [=](Vec3 p) { return dot(p - middle, across); });
  split(scene, 1, [=](Vec3 p) { return dot(p, {0, 0, 1}); });
  join(scene, a, b);
  return scene;
}

}  // namespace meshgraft::cut
