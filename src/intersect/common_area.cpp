#include "intersect/common_area.hpp"

#include <algorithm>

namespace meshgraft {
namespace {

/// The part of a convex polygon where `inside` (linear) is not negative.
template <class F>
std::vector<Vec3> clipped(const std::vector<Vec3>& polygon, F&& inside) {
  std::vector<Vec3> left;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double at_a = inside(a), at_b = inside(b);
    if (at_a >= 0) left.push_back(a);
    if ((at_a < 0) != (at_b < 0)) left.push_back(lerp(a, b, at_a / (at_a - at_b)));
  }
  return left;
}

}  // namespace

std::vector<Vec3> part_over(const Triangle& u, const Triangle& t, double beside) {
  const Vec3 n = unit_normal(t);
  std::vector<Vec3> polygon(u.begin(), u.end());
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 a = t[k], inward = normalized(cross(n, t[(k + 1) % 3] - a));
    polygon = clipped(polygon, [&](Vec3 p) { return dot(inward, p - a) + beside; });
  }
  return polygon;
}

std::vector<Vec3> within(std::vector<Vec3> polygon, const Triangle& t, const Reach& heights) {
  const Vec3 n = unit_normal(t);
  polygon = clipped(polygon, [&](Vec3 p) { return heights.high - dot(n, p - t[0]); });
  return clipped(polygon, [&](Vec3 p) { return dot(n, p - t[0]) - heights.low; });
}

double area_of(const std::vector<Vec3>& polygon) {
  Vec3 sum;
  for (std::size_t i = 2; i < polygon.size(); ++i) sum += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return 0.5 * norm(sum);
}

double diameter(const std::vector<Vec3>& polygon) {
  double most = 0;
  for (const Vec3 p : polygon)
    for (const Vec3 q : polygon) most = std::max(most, distance(p, q));
  return most;
}

}  // namespace meshgraft
