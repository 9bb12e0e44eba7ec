// The paper's measure of a triangle.
#pragma once

#include <algorithm>
#include <array>
#include <numbers>

#include "meshgraft/vec3.hpp"

namespace meshgraft {

using Triangle = std::array<Vec3, 3>;

/// Vector along the normal (counter-clockwise corners), as long as the area.
constexpr Vec3 area_vector(const Triangle& t) { return 0.5 * cross(t[1] - t[0], t[2] - t[0]); }
inline double area(const Triangle& t) { return norm(area_vector(t)); }
inline Vec3 unit_normal(const Triangle& t) { return normalized(area_vector(t)); }
constexpr Vec3 centroid(const Triangle& t) { return (t[0] + t[1] + t[2]) / 3.0; }
inline double mean_edge_length(const Triangle& t) {
  return (distance(t[0], t[1]) + distance(t[1], t[2]) + distance(t[2], t[0])) / 3;
}

/// Aspect ratio Q = 2 sqrt(3) S / (h p) of the paper (5.5, eq. 1): S area, h longest edge, p half
/// perimeter. 1 equilateral, 0 flat (also for three equal points).
inline double aspect_ratio(double area, const std::array<double, 3>& edges) {
  const auto [a, b, c] = edges;
  const double longest = std::max(std::max(a, b), c);
  const double half_perimeter = 0.5 * (a + b + c);
  return longest > 0 ? 2 * std::numbers::sqrt3 * area / (longest * half_perimeter) : 0;
}
inline double aspect_ratio(const Triangle& t) {
  return aspect_ratio(area(t), {distance(t[0], t[1]), distance(t[1], t[2]), distance(t[2], t[0])});
}

/// The same, negative when the triangle faces away from `normal`.
inline double signed_aspect_ratio(const Triangle& t, Vec3 normal) {
  const double q = aspect_ratio(t);
  return dot(area_vector(t), normal) < 0 ? -q : q;
}

}  // namespace meshgraft
