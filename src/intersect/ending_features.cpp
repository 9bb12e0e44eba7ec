#include <cmath>

#include "geometry/closest.hpp"
#include "intersect/meeting.hpp"

namespace meshgraft {

EndingFeatures ending_features(const Meeting& m, double Snap::*within) {
  EndingFeatures ending;
  for (const std::size_t s : kSides) {
    const Side& side = m.side[s];
    std::vector<std::uint8_t> near(m.complex.n_vertices());
    std::vector<std::uint8_t>&vertex = ending.vertex[s], &edge = ending.edge[s];
    vertex.assign(m.complex.n_vertices(), 0), edge.assign(side.n_edges(), 0);
    for (const FacePair& p : m.pairs) {
      const Triangle t = m.triangle(1 - s, p[1 - s]);
      const Vec3 n = unit_normal(t);
      const double gap = m.snap(p).*within;
      const auto is_in_plane = [&](VertexId v) { return std::abs(dot(n, m.at(v) - t[0])) <= gap; };
      for (const LocalEdge e : side.edges(p[s])) {
        const auto& [a, b] = side.ends(e);
        if (side.is_feature_edge(e) && is_in_plane(a) && is_in_plane(b)) edge[e] = 1;
      }
      for (const VertexId v : side.corners(p[s]))
        if (side.is_feature(v) && is_in_plane(v) && distance(m.at(v), closest_on_triangle(m.at(v), t).point) <= gap)
          near[v.value] = 1;
    }
    for (LocalEdge e = 0; e < side.n_edges(); ++e) {
      const auto& [a, b] = side.ends(e);
      if (side.is_feature_edge(e) && near[a.value] != 0 && near[b.value] != 0) edge[e] = 1;
      if (edge[e] != 0) vertex[a.value] = vertex[b.value] = 1;
    }
    for (LocalFace f = 0; f < side.n_faces(); ++f)
      for (const VertexId v : side.corners(f))
        if (side.is_corner(v)) vertex[v.value] = 1;
  }
  return ending;
}

}  // namespace meshgraft
