#include "zone/ruler.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/closest.hpp"

namespace meshgraft {
namespace {

using Size = std::function<double(double, Vec3)>;

Size uniform(double h) {
  return [h](double, Vec3) { return h; };
}

std::vector<Vec3> line(double length) { return {{0, 0, 0}, {length, 0, 0}}; }

std::vector<Vec3> arc(double radius, double angle, int n) {
  std::vector<Vec3> p;
  for (int i = 0; i <= n; ++i) p.push_back({radius * std::cos(angle * i / n), radius * std::sin(angle * i / n), 0});
  return p;
}

std::vector<Vec3> circle(double radius, int n) {
  auto p = arc(radius, 2 * std::numbers::pi, n);
  p.back() = p.front();
  return p;
}

/// Integral of ds / size, by many small steps.
double units(const Size& size, const std::vector<Vec3>& p, double from, double to) {
  constexpr int kSteps = 400;
  const auto a = arc_lengths(p);
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double s = from + (to - from) * (i + 0.5) / kSteps;
    sum += (to - from) / kSteps / size(s, point_at(p, a, s));
  }
  return sum;
}

double worst_sagitta(const std::vector<Vec3>& p, const std::vector<double>& nodes) {
  const auto a = arc_lengths(p);
  double worst = 0;
  for (std::size_t k = 1; k < nodes.size(); ++k) {
    const Vec3 from = point_at(p, a, nodes[k - 1]), to = point_at(p, a, nodes[k]);
    for (std::size_t i = 0; i < p.size(); ++i)
      if (a[i] > nodes[k - 1] && a[i] < nodes[k])
        worst = std::max(worst, distance(p[i], closest_on_segment(p[i], from, to).point) / distance(from, to));
  }
  return worst;
}

TEST(Ruler, ShortCurveIsOnePiece) {
  EXPECT_EQ(resampled(line(0.4), false, uniform(1)), (std::vector<double>{0, 0.4}));
  EXPECT_EQ(resampled(line(1.41), false, uniform(1)).size(), 2u);
  EXPECT_EQ(resampled(line(1.42), false, uniform(1)).size(), 3u);  // nearest to 1 in ratio: sqrt(2)
}

TEST(Ruler, NoShortLastPiece) {
  const auto nodes = resampled(line(10.2), false, uniform(1));
  ASSERT_EQ(nodes.size(), 11u);
  for (std::size_t i = 1; i < nodes.size(); ++i) EXPECT_NEAR(nodes[i] - nodes[i - 1], 1.02, 1e-9);
}

TEST(Ruler, LoopGetsThreePieces) {
  EXPECT_GE(resampled(circle(0.01, 64), true, uniform(1)).size(), 4u);
  EXPECT_GE(resampled({circle(0.01, 64)}, false, uniform(1)).size(), 4u);  // starts and ends at a corner
  const std::vector<Vec3> triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}};
  EXPECT_EQ(resampled(triangle, true, uniform(10)).size(), 4u);
}

TEST(Ruler, KinkThatAChordWouldCutGetsANode) {
  // 30 degrees: the chord over it is 0.13 off, at any length.
  const double a = 30 / 180.0 * std::numbers::pi;
  const std::vector<Vec3> p{{0, 0, 0}, {3.5, 0, 0}, {3.5 + 3.5 * std::cos(a), 3.5 * std::sin(a), 0}};
  const auto nodes = resampled(p, false, uniform(1));
  EXPECT_NE(std::ranges::find(nodes, arc_lengths(p)[1]), nodes.end());
  EXPECT_EQ(nodes.size(), 9u);  // four of 0.875 on each side: nearer to 1 in ratio than three
}

TEST(Ruler, KinksWithinTheSlackGetNoNode) {
  // Two turns of 30 degrees, 0.1 apart: as facets leave them.
  const double a = 30 / 180.0 * std::numbers::pi, b = 2 * a;
  std::vector<Vec3> p{{0, 0, 0}, {3.5, 0, 0}};
  p.push_back(p.back() + 0.1 * Vec3{std::cos(a), std::sin(a), 0});
  p.push_back(p.back() + 3.5 * Vec3{std::cos(b), std::sin(b), 0});
  RulerOptions options;
  const auto least = [&] {
    const auto nodes = resampled(p, false, uniform(1), options);
    double piece = nodes[1];
    for (std::size_t i = 1; i < nodes.size(); ++i) piece = std::min(piece, nodes[i] - nodes[i - 1]);
    return piece;
  };
  EXPECT_LT(least(), 0.15);
  options.slack = 0.1;
  EXPECT_GT(least(), 0.25);
}

TEST(Ruler, NoiseOfTheScaleOfRoundingAsksForNothing) {
  std::vector<Vec3> p{{0, 0, 0}, {3.3, 0, 0}, {3.3, 1e-6, 0}, {3.3 + 1e-6, 0, 0}, {10, 0, 0}};
  EXPECT_EQ(resampled(p, false, uniform(1)).size(), 11u);
}

TEST(Ruler, TightBendIsSpacedFinerOnlyThere) {
  // Two straight legs of 10 with a fillet of radius 0.3.
  std::vector<Vec3> p{{-10, 0.3, 0}};
  for (int i = 0; i <= 32; ++i) {
    const double t = std::numbers::pi / 2 * (1 - i / 32.0);
    p.push_back({0.3 * std::cos(t), 0.3 * std::sin(t), 0});
  }
  p.push_back({0.3, -10, 0});
  const auto nodes = resampled(p, false, uniform(1));
  EXPECT_LE(worst_sagitta(p, nodes), RulerOptions().max_sagitta);
  EXPECT_GT(nodes[1] - nodes[0], 0.7);
  EXPECT_GT(nodes.back() - nodes[nodes.size() - 2], 0.7);
  EXPECT_LE(nodes.size(), 34u);
}

TEST(Ruler, CoarseCircleKeepsItsNodes) {
  const auto p = circle(1, 12);
  const auto a = arc_lengths(p);
  const auto nodes = resampled(p, true, uniform(a[1]));
  ASSERT_EQ(nodes.size(), 13u);
  for (std::size_t i = 0; i < nodes.size(); ++i) EXPECT_NEAR(nodes[i], a[i], 1e-9);
}

TEST(Ruler, CurveWithoutLengthIsKept) {
  const std::vector<Vec3> p{{1, 1, 1}, {1, 1, 1}};
  EXPECT_EQ(resampled(p, false, uniform(1)).size(), 2u);
}

double number(double low, double high) { return low + (high - low) * *rc::gen::inRange(0, 10001) / 10000.0; }

/// A size that changes by at most `gradation` per length around one place.
Size graded(double fine, double centre, double gradation) {
  return [=](double, Vec3 p) { return std::min(1.0, fine + gradation * std::abs(p.x - centre)); };
}

RC_GTEST_PROP(Ruler, SpacingIsEvenInUnitsOfTheSize, ()) {
  const double length = number(0.75, 40), fine = number(0.1, 1), centre = number(0, 1) * length;
  const Size size = graded(fine, centre, 0.4);
  const auto p = line(length);
  const auto nodes = resampled(p, false, size);
  RC_ASSERT(nodes.front() == 0);
  RC_ASSERT(nodes.back() == length);
  RC_ASSERT(std::ranges::is_sorted(nodes));
  const double total = units(size, p, 0, length), m = total / static_cast<double>(nodes.size() - 1);
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    const double here = units(size, p, nodes[i - 1], nodes[i]);
    RC_ASSERT(std::abs(here / m - 1) < 0.05);
    RC_ASSERT((total < 0.71 || (here > 0.68 && here < 1.46)));
    // Neighbours differ by no more than the size changes over the two of them.
    if (i > 1) {
      const double ratio = (nodes[i] - nodes[i - 1]) / (nodes[i - 1] - nodes[i - 2]);
      RC_ASSERT(std::max(ratio, 1 / ratio) < 1.05 * std::exp(0.4 * m));
    }
  }
}

RC_GTEST_PROP(Ruler, ReversedPolylineGivesReversedNodes, ()) {
  const int n = *rc::gen::element(2, 3, 5, 9, 30);
  std::vector<Vec3> p{{0, 0, 0}};
  double direction = 0;
  for (int i = 1; i < n; ++i) {
    direction += number(-0.5, 0.5);
    p.push_back(p.back() + number(0.05, 3) * Vec3{std::cos(direction), std::sin(direction), 0});
  }
  const double length = arc_lengths(p).back();
  const Size size = graded(number(0.2, 1), number(0, 5), 0.3);
  const auto nodes = resampled(p, false, size);
  std::ranges::reverse(p);
  const auto reversed = resampled(p, false, size);
  RC_ASSERT(nodes.size() == reversed.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    RC_ASSERT(std::abs(nodes[i] - (length - reversed[nodes.size() - 1 - i])) < 1e-7 * length);
}

RC_GTEST_PROP(Ruler, ChordsStayNearThePolyline, ()) {
  const double radius = number(0.1, 5), angle = number(0.1, 6.2);
  const auto p = arc(radius, angle, *rc::gen::element(3, 8, 20, 200));
  const auto nodes = resampled(p, false, uniform(1));
  RC_ASSERT(worst_sagitta(p, nodes) <= RulerOptions().max_sagitta);
}

RC_GTEST_PROP(Ruler, ScalingScales, ()) {
  const auto p = arc(number(0.3, 5), number(0.5, 6), 40);
  auto scaled = p;
  for (Vec3& q : scaled) q *= 1024;  // exact
  const auto nodes = resampled(p, false, uniform(0.7)), large = resampled(scaled, false, uniform(0.7 * 1024));
  RC_ASSERT(nodes.size() == large.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) RC_ASSERT(1024 * nodes[i] == large[i]);
}

}  // namespace
}  // namespace meshgraft
