// Edges that go through faces. Every incidence within the snap length has been declared, so that
// what is left is well conditioned; its signs are exact all the same.
#include <algorithm>
#include <tuple>

#include "geometry/closest.hpp"
#include "geometry/predicates.hpp"
#include "intersect/meeting.hpp"
#include "intersect/seams.hpp"

namespace meshgraft {
namespace {

struct Crossing {
  LocalEdge edge;  // of side s
  LocalFace face;  // of the other
  double t = 0;
  Vec3 point;
};

/// True if the line from p to q, which crosses the plane of t, does so strictly inside t.
bool passes_inside(Vec3 p, Vec3 q, const Triangle& t) {
  const int a = orientation_sign(p, q, t[0], t[1]);
  if (a == 0) return false;
  return orientation_sign(p, q, t[1], t[2]) == a && orientation_sign(p, q, t[2], t[0]) == a;
}

/// Where p + u (q - p) is in the plane of t, as u.
double plane_parameter(Vec3 p, Vec3 q, const Triangle& t) {
  const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
  const double dp = dot(n, p - t[0]), dq = dot(n, q - t[0]);
  return dp == dq ? 0.5 : std::clamp(dp / (dp - dq), 0.0, 1.0);
}

/// Places where an edge was drawn to the other side, closing a gap. Beside them it seems to go through that, which is
/// bent to where they are.
class Drawn {
 public:
  explicit Drawn(const Meeting& m)
      : m_(m), in_edge_{{EdgeSymbols(m.side[0].n_edges()), EdgeSymbols(m.side[1].n_edges())}} {
    for (std::uint32_t i = 0; i < m.symbols.size(); ++i)
      for (const std::size_t s : kSides)
        if (const Carrier& on = m.symbols[i].on[s]; on.kind == Carrier::kEdge) in_edge_[s][on.id].push_back(i);
  }

  /// Whether edge e of side s, which goes through face g at a point, was drawn to a neighbour of g there.
  [[nodiscard]] bool is_beside(std::size_t s, LocalEdge e, LocalFace g, Vec3 point) const {
    const auto& [low, high] = m_.side[s].ends(e);
    const double sine = std::abs(dot(normalized(m_.at(high) - m_.at(low)), unit_normal(m_.triangle(1 - s, g))));
    const auto is_there = [&](const Symbol& symbol) {
      return sine * distance(point, m_.at(symbol.vertex)) <= kBeside * gap(symbol) && is_on_neighbour(symbol, 1 - s, g);
    };
    return sine >= kSteep &&
           (m_.any_symbol(s, low, is_there) || m_.any_symbol(s, high, is_there) ||
            std::ranges::any_of(in_edge_[s][e], [&](std::uint32_t i) { return is_there(m_.symbols[i]); }));
  }

 private:
  using EdgeSymbols = std::vector<std::vector<std::uint32_t>>;
  static constexpr double kSteep = 0.3;   // sine of the angle from which an edge does not run along a face
  static constexpr double kBeside = 2.0;  // gaps, seen along the face: its neighbour may lean to it

  /// How far it was from what it lies on.
  [[nodiscard]] double gap(const Symbol& symbol) const {
    const Vec3 p = m_.at(symbol.vertex);
    double gap = 0;
    for (const std::size_t s : kSides) {
      const Carrier& on = symbol.on[s];
      if (on.kind == Carrier::kVertex) continue;
      Vec3 foot;
      if (on.kind == Carrier::kEdge)
        foot = closest_on_segment(p, m_.at(m_.side[s].ends(on.id)[0]), m_.at(m_.side[s].ends(on.id)[1])).point;
      else
        foot = closest_on_triangle(p, m_.triangle(s, on.id)).point;
      gap = std::max(gap, distance(p, foot));
    }
    return gap;
  }

  [[nodiscard]] bool is_on_neighbour(const Symbol& symbol, std::size_t o, LocalFace g) const {
    return std::ranges::any_of(m_.side[o].corners(g), [&](VertexId v) {
      return std::ranges::any_of(m_.side[o].faces_at(v), [&](LocalFace f) { return m_.on_face(symbol, o, f); });
    });
  }

  const Meeting& m_;
  std::array<EdgeSymbols, 2> in_edge_;
};

void find_in_pair(const Meeting& m, const Drawn& drawn, const FacePair& pair, std::size_t s,
                  std::vector<Crossing>& found) {
  const Triangle plane = m.triangle(1 - s, pair[1 - s]);
  const auto& corners = m.side[s].corners(pair[s]);
  std::array<int, 3> sign{};
  for (std::size_t k = 0; k < 3; ++k) sign[k] = orientation_sign(plane[0], plane[1], plane[2], m.at(corners[k]));
  for (std::size_t k = 0; k < 3; ++k) {
    if (sign[k] * sign[(k + 1) % 3] >= 0) continue;
    const LocalEdge e = m.side[s].edges(pair[s])[k];
    const auto& [low, high] = m.side[s].ends(e);
    // A straight edge meets a plane once: where a symbol says that they meet there is no second place.
    if (!passes_inside(m.at(low), m.at(high), plane) || m.meet(s, e, pair[1 - s])) continue;
    const double t = plane_parameter(m.at(low), m.at(high), plane);
    const Vec3 point = lerp(m.at(low), m.at(high), t);
    if (!drawn.is_beside(s, e, pair[1 - s], point)) found.push_back({e, pair[1 - s], t, point});
  }
}

}  // namespace

void find_crossings(Meeting& m) {
  Seams seams(m);
  const Drawn drawn(m);
  for (const std::size_t s : kSides) {
    std::vector<Crossing> found;
    for (const FacePair& p : m.pairs) find_in_pair(m, drawn, p, s, found);
    std::sort(found.begin(), found.end(),
              [](const Crossing& a, const Crossing& b) { return std::tie(a.edge, a.face) < std::tie(b.edge, b.face); });
    const auto same = [](const Crossing& a, const Crossing& b) { return a.edge == b.edge && a.face == b.face; };
    found.erase(std::unique(found.begin(), found.end(), same), found.end());
    for (const Crossing& c : found) {
      std::array<Carrier, 2> on;
      on[s] = {Carrier::kEdge, c.edge, c.t};
      on[1 - s] = {Carrier::kFace, c.face, 0};
      m.add(seams.shared_or_new(c.point, on));
    }
  }
}

}  // namespace meshgraft
