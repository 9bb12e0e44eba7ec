#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <tuple>

#include "check/face_pairs.hpp"
#include "geometry/predicates.hpp"

namespace meshgraft {
namespace {

/// Coordinates left when one axis is dropped: 0 drops x.
Vec2 projected(Vec3 p, std::size_t dropped) {
  return dropped == 0 ? Vec2{p.y, p.z} : dropped == 1 ? Vec2{p.z, p.x} : Vec2{p.x, p.y};
}

constexpr std::size_t kNoAxis = 3;

/// An axis along which the triangle keeps its area; kNoAxis if it has none.
std::size_t axis_of(const Triangle& t) {
  const Vec3 n = area_vector(t);
  std::array<std::size_t, 3> axes{0, 1, 2};
  std::ranges::sort(axes, {}, [&](std::size_t k) { return -std::abs(n[k]); });
  for (const std::size_t k : axes)
    if (turn_sign(projected(t[0], k), projected(t[1], k), projected(t[2], k)) != 0) return k;
  return kNoAxis;
}

bool segments_meet(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const int abc = turn_sign(a, b, c), abd = turn_sign(a, b, d), cda = turn_sign(c, d, a), cdb = turn_sign(c, d, b);
  if (abc * abd < 0 && cda * cdb < 0) return true;
  const auto within = [](Vec2 p, Vec2 q, Vec2 x) {
    return std::min(p.x, q.x) <= x.x && x.x <= std::max(p.x, q.x) && std::min(p.y, q.y) <= x.y &&
           x.y <= std::max(p.y, q.y);
  };
  return (abc == 0 && within(a, b, c)) || (abd == 0 && within(a, b, d)) || (cda == 0 && within(c, d, a)) ||
         (cdb == 0 && within(c, d, b));
}

/// Closed segment and closed triangle in one plane.
bool meet_in_plane(Vec3 x, Vec3 y, const Triangle& t) {
  const std::size_t axis = axis_of(t);
  if (axis == kNoAxis) return false;
  const Vec2 p = projected(x, axis), q = projected(y, axis);
  const std::array c{projected(t[0], axis), projected(t[1], axis), projected(t[2], axis)};
  const int turn = turn_sign(c[0], c[1], c[2]);
  bool inside = true;
  for (std::size_t k = 0; k < 3; ++k) {
    inside = inside && turn_sign(c[k], c[(k + 1) % 3], p) * turn >= 0;
    if (segments_meet(p, q, c[k], c[(k + 1) % 3])) return true;
  }
  return inside;
}

/// Closed segment and closed triangle.
bool segment_meets(Vec3 x, Vec3 y, const Triangle& t) {
  const int sx = orientation_sign(t[0], t[1], t[2], x), sy = orientation_sign(t[0], t[1], t[2], y);
  if (sx * sy > 0) return false;
  if (sx == 0 && sy == 0) return meet_in_plane(x, y, t);
  // The line crosses the plane in one point of the segment; it must pass all edges on one side.
  int low = 0, high = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const int s = orientation_sign(x, y, t[k], t[(k + 1) % 3]);
    low = std::min(low, s), high = std::max(high, s);
  }
  return low == 0 || high == 0;
}

/// Bound on the relative error of the dot product of two vectors of rounded differences, ample.
constexpr double kDotError = 16 * std::numeric_limits<double>::epsilon();

/// Proof in plain arithmetic that along `direction` all of b lies beyond all of a, or the other way round.
bool apart_along(Vec3 direction, Vec3 origin, std::span<const Vec3> a, std::span<const Vec3> b) {
  const double length = norm(direction);
  double a_low = std::numeric_limits<double>::infinity(), a_high = -a_low, b_low = a_low, b_high = -a_low;
  for (const auto& [points, low, high] : {std::tuple(a, &a_low, &a_high), std::tuple(b, &b_low, &b_high)})
    for (const Vec3 p : points) {
      const Vec3 v = p - origin;
      const double d = dot(direction, v), error = kDotError * length * norm(v);
      *low = std::min(*low, d - error), *high = std::max(*high, d + error);
    }
  return a_high < b_low || b_high < a_low;
}

Vec3 corner_not(const Triangle& t, std::size_t i, std::size_t j) { return t[3 - i - j]; }

/// Proof in plain arithmetic that two faces at an edge, with corners r and s seen from its start, are open by
/// more than a right angle, as nearly all neighbours are: they cannot lie on one another.
bool open_by_a_right_angle(Vec3 edge, Vec3 r, Vec3 s) {
  const Vec3 nr = cross(edge, r), ns = cross(edge, s);
  const double er = kDotError * norm(edge) * norm(r), es = kDotError * norm(edge) * norm(s);
  const double error = er * (norm(ns) + es) + es * (norm(nr) + er) + kDotError * norm(nr) * norm(ns);
  return dot(nr, ns) < -2 * error;
}

bool meet_beyond_edge(const Triangle& a, std::size_t a0, std::size_t a1, const Triangle& b, std::size_t b0,
                      std::size_t b1) {
  const Vec3 p = a[a0], q = a[a1], r = corner_not(a, a0, a1), s = corner_not(b, b0, b1);
  if (open_by_a_right_angle(q - p, r - p, s - p)) return false;
  if (orientation_sign(p, q, r, s) != 0) return false;
  const std::size_t axis = axis_of(a);
  if (axis == kNoAxis) return false;
  const auto side = [&](Vec3 x) { return turn_sign(projected(p, axis), projected(q, axis), projected(x, axis)); };
  return side(r) == side(s);
}

bool meet_beyond_node(const Triangle& a, std::size_t ka, const Triangle& b, std::size_t kb) {
  const Vec3 p = a[ka];
  const std::array qr{a[(ka + 1) % 3], a[(ka + 2) % 3]}, st{b[(kb + 1) % 3], b[(kb + 2) % 3]};
  const auto bisector = [&](const std::array<Vec3, 2>& x) {
    return normalized(normalized(x[0] - p) + normalized(x[1] - p));
  };
  const auto beyond = [&](Vec3 direction) {  // strictly on the two sides of a plane through p
    return apart_along(direction, p, qr, std::span(&p, 1)) && apart_along(direction, p, st, std::span(&p, 1)) &&
           dot(direction, qr[0] - p) * dot(direction, st[0] - p) < 0;
  };
  if (beyond(bisector(qr) - bisector(st))) return false;
  // A common point other than p lies on a ray from p that leaves one of the faces at the edge opposite to p,
  // inside the other face.
  return segment_meets(qr[0], qr[1], b) || segment_meets(st[0], st[1], a);
}

bool meet_anywhere(const Triangle& a, const Triangle& b) {
  const Vec3 na = area_vector(a), nb = area_vector(b);
  if (apart_along(na, a[0], a, b) || apart_along(nb, b[0], a, b)) return false;
  for (std::size_t k = 0; k < 3; ++k)
    if (apart_along(cross(na, a[(k + 1) % 3] - a[k]), a[k], a, b) ||
        apart_along(cross(nb, b[(k + 1) % 3] - b[k]), b[k], a, b))
      return false;
  for (std::size_t k = 0; k < 3; ++k)
    if (segment_meets(a[k], a[(k + 1) % 3], b) || segment_meets(b[k], b[(k + 1) % 3], a)) return true;
  return false;
}

}  // namespace

bool meet_beyond_shared(const std::array<std::uint32_t, 3>& va, const Triangle& a,
                        const std::array<std::uint32_t, 3>& vb, const Triangle& b) {
  std::array<std::size_t, 3> in_a{}, in_b{};
  std::size_t shared = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (va[i] == vb[j] && shared < 3) in_a[shared] = i, in_b[shared] = j, ++shared;
  switch (shared) {
    case 0:
      return meet_anywhere(a, b);
    case 1:
      return meet_beyond_node(a, in_a[0], b, in_b[0]);
    case 2:
      return meet_beyond_edge(a, in_a[0], in_a[1], b, in_b[0], in_b[1]);
    default:
      return true;
  }
}

bool is_degenerate(const std::array<std::uint32_t, 3>& v, const Triangle& t) {
  return v[0] == v[1] || v[1] == v[2] || v[2] == v[0] || axis_of(t) == kNoAxis;
}

}  // namespace meshgraft
