#include "geometry/predicates.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>

#include "geometry/generators.hpp"

namespace meshgraft {
namespace {

using test::grid_point;

int sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

TEST(Predicates, OrientationSignIsThatOfTheNormal) {
  const Vec3 a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0};
  EXPECT_EQ(orientation_sign(a, b, c, {0.3, 0.3, 1}), 1);
  EXPECT_EQ(orientation_sign(a, b, c, {0.3, 0.3, -1}), -1);
  EXPECT_EQ(orientation_sign(a, b, c, {7, -9, 0}), 0);
}

RC_GTEST_PROP(Predicates, AgreesWithIntegersOnAGrid, ()) {
  const Vec3 a = grid_point(), b = grid_point(), c = grid_point(), d = grid_point();
  RC_ASSERT(orientation_sign(a, b, c, d) == sign(dot(cross(b - a, c - a), d - a)));
}

RC_GTEST_PROP(Predicates, SwappingTwoPointsTurnsTheSign, ()) {
  const auto odd = [] { return Vec3{0.1, 0.2, 0.3} + (1.0 / 3) * grid_point(); };  // coplanar only up to rounding
  const Vec3 a = odd(), b = odd(), c = odd(), d = odd();
  const int s = orientation_sign(a, b, c, d);
  RC_ASSERT(orientation_sign(b, a, c, d) == -s);
  RC_ASSERT(orientation_sign(a, b, d, c) == -s);
  RC_ASSERT(orientation_sign(b, c, a, d) == s);
}

TEST(Predicates, OneUlpOffAPlaneIsSeen) {
  // A slanted plane whose points are exact: x + y + z = 3 with coordinates of few bits.
  const Vec3 a{3, 0, 0}, b{0, 3, 0}, c{0, 0, 3};
  const Vec3 on{0.5, 1.25, 1.25};
  EXPECT_EQ(orientation_sign(a, b, c, on), 0);
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const double towards : {-10.0, 10.0}) {
      Vec3 off = on;
      off[axis] = std::nextafter(on[axis], towards);
      EXPECT_EQ(orientation_sign(a, b, c, off), towards > 0 ? 1 : -1);
    }
}

TEST(Predicates, FarFromTheOriginNothingIsLost) {
  const double far = 0x1p40;
  const Vec3 o{far, far, far}, step{std::nextafter(far, 2 * far) - far, 0, 0};
  const Vec3 b = o + Vec3{1, 0, 1}, c = o + Vec3{0, 1, 1};
  EXPECT_EQ(orientation_sign(o, b, c, o + Vec3{1, 1, 2}), 0);
  EXPECT_NE(orientation_sign(o, b, c, o + Vec3{1, 1, 2} + step), 0);
}

TEST(Predicates, TurnSignOneUlpOffALine) {
  const Vec2 a{0.5, 0.5}, b{12, 12};
  EXPECT_EQ(turn_sign(a, b, {24, 24}), 0);
  EXPECT_EQ(turn_sign(a, b, {24, std::nextafter(24.0, 25.0)}), 1);
  EXPECT_EQ(turn_sign(a, b, {24, std::nextafter(24.0, 23.0)}), -1);
}

}  // namespace
}  // namespace meshgraft
