#include "geometry/quality.hpp"

#include <numbers>

namespace meshgraft {

double aspect_ratio(const Triangle& t) {
  return aspect_ratio(area(t), {distance(t[0], t[1]), distance(t[1], t[2]), distance(t[2], t[0])});
}

double aspect_ratio(double area, const std::array<double, 3>& edges) {
  const auto [a, b, c] = edges;
  const double longest = std::max({a, b, c});
  const double half_perimeter = 0.5 * (a + b + c);
  return longest > 0 ? 2 * std::numbers::sqrt3 * area / (longest * half_perimeter) : 0;
}

double signed_aspect_ratio(const Triangle& t, Vec3 normal) {
  const double q = aspect_ratio(t);
  return dot(area_vector(t), normal) < 0 ? -q : q;
}

}  // namespace meshgraft
