#include "geometry/closest.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "geometry/generators.hpp"

namespace meshgraft {
namespace {

using test::any_point;
using test::grid_point;

constexpr double kRounding = 1e-12;

Vec3 maybe_grid() { return *rc::gen::arbitrary<bool>() ? grid_point() : any_point(); }

/// Least distance over a fine sampling of the segment.
double brute(Vec3 p, Vec3 a, Vec3 b) {
  double least = distance(p, a);
  for (int i = 1; i <= 100; ++i) least = std::min(least, distance(p, lerp(a, b, i / 100.0)));
  return least;
}

RC_GTEST_PROP(Closest, OnSegmentIsOnItAndNoSampleIsNearer, ()) {
  const Vec3 p = maybe_grid(), a = maybe_grid(), b = maybe_grid();
  const SegmentPoint q = closest_on_segment(p, a, b);
  RC_ASSERT(q.t >= 0);
  RC_ASSERT(q.t <= 1);
  RC_ASSERT(distance(q.point, lerp(a, b, q.t)) < kRounding);
  RC_ASSERT(distance(p, q.point) <= brute(p, a, b) + kRounding);
}

TEST(Closest, EndsOfASegmentAreExact) {
  const Vec3 a{1.0 / 3, 0.1, 0.7}, b{2.0 / 7, 11.3, 0.9};
  EXPECT_EQ(closest_on_segment(b, a, b).point, b);
  EXPECT_EQ(closest_on_segment(a, a, b).point, a);
  EXPECT_EQ(closest_on_segment({5, 5, 5}, a, a).point, a);
}

RC_GTEST_PROP(Closest, BetweenSegmentsNoSampleIsNearer, ()) {
  const Vec3 a0 = maybe_grid(), a1 = maybe_grid(), b0 = maybe_grid(), b1 = maybe_grid();
  const SegmentPair pair = closest_between_segments(a0, a1, b0, b1);
  const double d = distance(pair.first.point, pair.second.point);
  RC_ASSERT(distance(pair.first.point, lerp(a0, a1, pair.first.t)) < kRounding);
  RC_ASSERT(distance(pair.second.point, lerp(b0, b1, pair.second.t)) < kRounding);
  for (int i = 0; i <= 50; ++i) {
    const Vec3 p = lerp(a0, a1, i / 50.0);
    RC_ASSERT(d <= distance(p, closest_on_segment(p, b0, b1).point) + 1e-9);
  }
}

RC_GTEST_PROP(Closest, OnTriangleIsInItAndNoSampleIsNearer, ()) {
  const Vec3 p = maybe_grid();
  const Triangle t{maybe_grid(), maybe_grid(), maybe_grid()};  // may have no area
  const TrianglePoint q = closest_on_triangle(p, t);
  double sum = 0;
  Vec3 at;
  for (std::size_t k = 0; k < 3; ++k) {
    RC_ASSERT(q.weight[k] >= 0);
    sum += q.weight[k], at += q.weight[k] * t[k];
  }
  RC_ASSERT(std::abs(sum - 1) < kRounding);
  RC_ASSERT(distance(at, q.point) < kRounding);
  for (int i = 0; i <= 20; ++i)
    for (int j = 0; i + j <= 20; ++j) {
      const Vec3 s = (i / 20.0) * t[0] + (j / 20.0) * t[1] + ((20 - i - j) / 20.0) * t[2];
      RC_ASSERT(distance(p, q.point) <= distance(p, s) + 1e-9);
    }
}

}  // namespace
}  // namespace meshgraft
