// Exact signs. Every decision about topology that depends on coordinates goes through here.
#pragma once

#include "meshgraft/vec3.hpp"

namespace meshgraft {

/// +1 if d lies on the side of the plane a b c to which (b-a) x (c-a) points, -1 on the other,
/// 0 if the four are coplanar.
/// Exact for all finite coordinates that neither overflow nor underflow in products of three.
int orientation_sign(Vec3 a, Vec3 b, Vec3 c, Vec3 d);

struct Vec2 {
  double x = 0, y = 0;
  friend constexpr bool operator==(const Vec2&, const Vec2&) = default;
};

/// +1 if a, b, c turn left, -1 if right, 0 if they are collinear. Exact.
int turn_sign(Vec2 a, Vec2 b, Vec2 c);

}  // namespace meshgraft
