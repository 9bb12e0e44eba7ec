// Angles and directions.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "meshgraft/vec3.hpp"

namespace meshgraft {

[[nodiscard]] constexpr double radians(double degrees) { return degrees / 180 * std::numbers::pi; }

/// Two unit vectors at right angles to a unit vector n and to each other; with n they are right-handed.
[[nodiscard]] inline std::array<Vec3, 2> directions_across(Vec3 n) {
  constexpr double kAlong = 0.6;  // of a component above which n is too near to that axis; below 1 / sqrt(2)
  const Vec3 axis = std::abs(n.x) < kAlong ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 u = normalized(cross(n, axis));
  return {u, cross(n, u)};
}

}  // namespace meshgraft
