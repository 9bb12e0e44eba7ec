// Edges that go through faces. Every incidence within the snap length has been declared, so that
// what is left is well conditioned; its signs are exact all the same.
#include <algorithm>
#include <tuple>

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

void find_in_pair(const Meeting& m, const FacePair& pair, std::size_t s, std::vector<Crossing>& found) {
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
    found.push_back({e, pair[1 - s], t, lerp(m.at(low), m.at(high), t)});
  }
}

}  // namespace

void find_crossings(Meeting& m) {
  Seams seams(m);
  for (const std::size_t s : kSides) {
    std::vector<Crossing> found;
    for (const FacePair& p : m.pairs) find_in_pair(m, p, s, found);
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
