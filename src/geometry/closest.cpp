#include "geometry/closest.hpp"

#include <algorithm>

namespace meshgraft {
namespace {

constexpr double kNeedle = 1e-12;  // squared sine of an angle of a triangle below which it has no inside to speak of

}  // namespace

SegmentPoint closest_on_segment(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 d = b - a;
  const double length2 = squared_norm(d);
  const double t = length2 > 0 ? std::clamp(dot(p - a, d) / length2, 0.0, 1.0) : 0;
  return {t == 1 ? b : a + t * d, t};
}

SegmentPair closest_between_segments(Vec3 a0, Vec3 a1, Vec3 b0, Vec3 b1) {
  const Vec3 u = a1 - a0, v = b1 - b0, w = a0 - b0;
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
  const double det = uu * vv - uv * uv;
  double s = det > 1e-14 * uu * vv ? std::clamp((uv * vw - vv * uw) / det, 0.0, 1.0) : 0;  // else parallel
  const SegmentPoint on_b = closest_on_segment(lerp(a0, a1, s), b0, b1);
  const SegmentPoint on_a = closest_on_segment(on_b.point, a0, a1);
  return {on_a, closest_on_segment(on_a.point, b0, b1)};
}

TrianglePoint closest_on_triangle(Vec3 p, const Triangle& t) {
  // After the Voronoi regions of Ericson, "Real-Time Collision Detection", 5.1.5.
  const auto [a, b, c] = t;
  const Vec3 n = cross(b - a, c - a);
  const double n2 = squared_norm(n);
  const double u = dot(cross(c - b, p - b), n), v = dot(cross(a - c, p - c), n), w = dot(cross(b - a, p - a), n);
  if (n2 > 0 && u >= 0 && v >= 0 && w >= 0) {
    const double sum = u + v + w;
    return {(u * a + v * b + w * c) / sum, {u / sum, v / sum, w / sum}};
  }
  // Only edges that the point is beyond can be nearest; of a needle no sign tells that.
  const bool is_needle = n2 <= kNeedle * squared_norm(b - a) * squared_norm(c - a);
  const std::array<bool, 3> beyond{is_needle || w < 0, is_needle || u < 0, is_needle || v < 0};
  TrianglePoint best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    if (!beyond[k]) continue;
    const std::size_t l = (k + 1) % 3;
    const SegmentPoint q = closest_on_segment(p, t[k], t[l]);
    const double d = squared_norm(p - q.point);
    if (d >= least) continue;
    least = d;
    best = {q.point, {}};
    best.weight[k] = 1 - q.t, best.weight[l] = q.t;
  }
  return best;
}

}  // namespace meshgraft
