// Points seen in a coordinate plane.
#pragma once

#include <cmath>
#include <cstddef>
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

}  // namespace meshgraft
