// Random geometry: coordinates from a small set, so that equal, collinear and coplanar points are common.
#pragma once

#include <rapidcheck.h>

#include "meshgraft/vec3.hpp"

namespace meshgraft::test {

inline double any_number(double low, double high) { return low + (high - low) * *rc::gen::inRange(0, 1001) / 1000.0; }

inline Vec3 any_point(double low = -2, double high = 2) {
  const double x = any_number(low, high), y = any_number(low, high), z = any_number(low, high);
  return {x, y, z};
}

inline Vec3 grid_point() {
  const auto c = [] { return *rc::gen::element(0.0, 1.0, 2.0); };
  const double x = c(), y = c(), z = c();
  return {x, y, z};
}

}  // namespace meshgraft::test
