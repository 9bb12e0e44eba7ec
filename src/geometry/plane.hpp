// Points seen in a coordinate plane.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "geometry/predicates.hpp"

namespace meshgraft {

/// Drops the coordinate along the main axis of a normal, such that what is counter-clockwise around it stays so:
/// no coordinate changes, so signs in the plane are exact.
class Plane {
 public:
  explicit Plane(Vec3 normal) {
    const Vec3 size{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
    const std::size_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    u_ = (axis + 1) % 3, v_ = (axis + 2) % 3;
    if (normal[axis] < 0) std::swap(u_, v_);
  }
  [[nodiscard]] Vec2 operator()(Vec3 p) const { return {p[u_], p[v_]}; }

 private:
  std::size_t u_ = 0, v_ = 1;
};

/// Whether p is inside of a closed chain of points, by the sides that a ray to the right crosses. A point on the chain
/// is on either side.
[[nodiscard]] inline bool is_inside(std::span<const Vec2> chain, Vec2 p) {
  bool inside = false;
  for (std::size_t k = 0; k < chain.size(); ++k) {
    const Vec2 a = chain[k], b = chain[(k + 1) % chain.size()];
    if ((a.y > p.y) != (b.y > p.y) && turn_sign(a, b, p) == (b.y > a.y ? 1 : -1)) inside = !inside;
  }
  return inside;
}

}  // namespace meshgraft
