#include <algorithm>
#include <cmath>

#include "geometry/closest.hpp"
#include "intersect/meeting.hpp"

namespace meshgraft {
namespace {

/// Features of one side that end on the other or run along it.
class EndingSearch {
 public:
  EndingSearch(const Meeting& meeting, std::size_t s, double Snap::*within)
      : m_(meeting),
        s_(s),
        side_(meeting.side[s]),
        other_(meeting.side[1 - s]),
        within_(within),
        near_(meeting.complex.n_vertices()) {}

  void run(std::vector<std::uint8_t>& vertex, std::vector<std::uint8_t>& edge) {
    vertex.assign(m_.complex.n_vertices(), 0), edge.assign(side_.n_edges(), 0);
    for (const FacePair& p : m_.pairs) find_near(p);
    for (const FacePair& p : m_.pairs) {
      const Plane plane(m_, s_, p, within_);
      for (const LocalEdge e : side_.edges(p[s_]))
        if (edge[e] == 0 && side_.is_line_edge(e) && runs_along(e, plane) &&
            (is_beside(e, plane) || is_in_plane(e, plane, p[1 - s_])))
          edge[e] = 1, ending_.push_back({e, plane.normal});
    }
    for (const LocalEdge e : leaving()) edge[e] = 0;
    for (LocalFace f = 0; f < side_.n_faces(); ++f)
      for (const VertexId v : side_.corners(f))
        if (side_.is_corner(v)) vertex[v.value] = 1;
    for (const VertexId v : m_.half_reached) vertex[v.value] = 0;
    for (LocalEdge e = 0; e < side_.n_edges(); ++e)
      if (edge[e] != 0)
        for (const VertexId v : side_.ends(e)) vertex[v.value] = 1;
  }

 private:
  /// Of a face of the other side.
  struct Plane {
    Plane(const Meeting& m, std::size_t s, const FacePair& p, double Snap::*within)
        : face(m.triangle(1 - s, p[1 - s])), normal(unit_normal(face)), gap(m.snap(p).*within) {}
    [[nodiscard]] bool holds(Vec3 p) const { return std::abs(dot(normal, p - face[0])) <= gap; }
    [[nodiscard]] bool is_near(Vec3 p) const {
      return holds(p) && distance(p, closest_on_triangle(p, face).point) <= gap;
    }
    Triangle face;
    Vec3 normal;
    double gap;
  };

  void find_near(const FacePair& p) {
    const Plane plane(m_, s_, p, within_);
    for (const VertexId v : side_.corners(p[s_]))
      if (side_.is_line(v) && plane.is_near(m_.at(v))) near_[v.value] = 1;
  }

  /// An edge that may end on a face with this normal.
  struct Ending {
    LocalEdge edge;
    Vec3 normal;
  };

  /// Of edges at an acute corner that run along one surface, those that are steeper than another.
  [[nodiscard]] std::vector<LocalEdge> leaving() const {
    std::vector<std::pair<VertexId, std::uint32_t>> at;  // position in ending_
    for (std::uint32_t i = 0; i < ending_.size(); ++i)
      for (const VertexId v : side_.ends(ending_[i].edge)) at.emplace_back(v, i);
    std::ranges::sort(at);
    std::vector<LocalEdge> result;
    for (std::size_t i = 0; i < at.size(); ++i)
      for (std::size_t j = i + 1; j < at.size() && at[j].first == at[i].first; ++j)
        for (const auto& [e, f] : {std::pair{at[i].second, at[j].second}, std::pair{at[j].second, at[i].second}})
          if (leaves(at[i].first, ending_[e], ending_[f])) result.push_back(ending_[e].edge);
    return result;
  }

  [[nodiscard]] bool leaves(VertexId v, const Ending& e, const Ending& beside) const {
    const auto way = [&](const Ending& of) {
      const auto& [a, b] = side_.ends(of.edge);
      return normalized(m_.at(a == v ? b : a) - m_.at(v));
    };
    return leaves_at_corner({way(e), way(beside)}, {e.normal, beside.normal});
  }

  /// An edge that goes through the face is short if both its ends are near, but ends nowhere there.
  [[nodiscard]] bool runs_along(LocalEdge e, const Plane& plane) const {
    const auto& [a, b] = side_.ends(e);
    const Vec3 along = m_.at(b) - m_.at(a);
    return std::abs(dot(along, plane.normal)) <= kAlong * norm(along);
  }

  /// Both ends are near the other side, one of them the face.
  [[nodiscard]] bool is_beside(LocalEdge e, const Plane& plane) const {
    const auto& ends = side_.ends(e);
    return std::ranges::all_of(ends, [&](VertexId v) { return near_[v.value] != 0; }) &&
           std::ranges::any_of(ends, [&](VertexId v) { return plane.is_near(m_.at(v)); });
  }

  [[nodiscard]] bool is_in_plane(LocalEdge e, const Plane& plane, LocalFace g) const {
    return std::ranges::all_of(side_.ends(e),
                               [&](VertexId v) { return plane.holds(m_.at(v)) && is_near_or_past(v, plane.face, g); });
  }

  /// Whether the vertex is near the other side, or past a feature in which the face g of that ends. One that is too
  /// far away, over the middle of it, is in the plane of g only because that side is curved.
  [[nodiscard]] bool is_near_or_past(VertexId v, const Triangle& face, LocalFace g) const {
    if (near_[v.value] != 0) return true;
    const TrianglePoint c = closest_on_triangle(m_.at(v), face);
    for (std::size_t k = 0; k < 3; ++k)  // edge k is opposite to corner k + 2
      if (c.weight[(k + 2) % 3] <= 0 && other_.is_feature_edge(other_.edges(g)[k])) return true;
    return false;
  }

  const Meeting& m_;
  std::size_t s_;
  const Side &side_, &other_;
  double Snap::*within_;
  std::vector<Ending> ending_;
  std::vector<std::uint8_t> near_;  // by vertex
};

}  // namespace

EndingFeatures ending_features(const Meeting& m, double Snap::*within) {
  EndingFeatures ending;
  for (const std::size_t s : kSides) EndingSearch(m, s, within).run(ending.vertex[s], ending.edge[s]);
  return ending;
}

}  // namespace meshgraft
