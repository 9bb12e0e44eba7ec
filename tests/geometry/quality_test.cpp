#include "geometry/quality.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

#include "geometry/generators.hpp"

namespace meshgraft {
namespace {

using test::any_point;

/// Triangle with base 1 and the given angles at it.
Triangle with_angles(double left, double right) {
  const double x = std::tan(right) / (std::tan(left) + std::tan(right));
  return {Vec3{0, 0, 0}, {1, 0, 0}, {x, x * std::tan(left), 0}};
}

constexpr double degrees(double d) { return d / 180 * std::numbers::pi; }

TEST(AspectRatio, EquilateralIsOneAndFlatIsZero) {
  EXPECT_NEAR(aspect_ratio({Vec3{0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}}), 1, 1e-15);
  EXPECT_EQ(aspect_ratio({Vec3{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}), 0);
  EXPECT_EQ(aspect_ratio({Vec3{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}), 0);
}

TEST(AspectRatio, HalfMeansTheAnglesOfThePaper) {
  // Section 5.5: Q above 0.5 keeps all angles between 19.8 and 115.6 degrees.
  double least = 180, largest = 0;
  for (double a = 5; a < 90; a += 0.25)
    for (double b = a; a + b < 175; b += 0.25) {
      if (std::abs(b - 90) < 1e-9) continue;
      if (aspect_ratio(with_angles(degrees(a), degrees(b))) < 0.5) continue;
      least = std::min(least, a), largest = std::max({largest, b, 180 - a - b});
    }
  EXPECT_NEAR(least, 19.8, 0.4);
  EXPECT_NEAR(largest, 115.6, 0.4);
}

RC_GTEST_PROP(AspectRatio, DependsOnShapeAlone, ()) {
  const Triangle t{any_point(), any_point(), any_point()};
  const double q = aspect_ratio(t);
  RC_ASSERT(q >= 0);
  RC_ASSERT(q <= 1 + 1e-12);
  RC_ASSERT(std::abs(aspect_ratio({t[1], t[2], t[0]}) - q) < 1e-12);
  RC_ASSERT(std::abs(aspect_ratio({t[1], t[0], t[2]}) - q) < 1e-12);
  RC_ASSERT(aspect_ratio({1024.0 * t[0], 1024.0 * t[1], 1024.0 * t[2]}) == q);
}

RC_GTEST_PROP(AspectRatio, SignTellsTheSideAlone, ()) {
  const Triangle t{any_point(), any_point(), any_point()};
  const Vec3 n = area_vector(t);
  RC_ASSERT(signed_aspect_ratio(t, n) == aspect_ratio(t));
  if (norm(n) > 1e-12) RC_ASSERT(signed_aspect_ratio(t, -n) == -aspect_ratio(t));
}

}  // namespace
}  // namespace meshgraft
