// The lines that give a mesh its shape, rims and folds, keep their nodes when they lie in a zone.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <tuple>

#include "expect.hpp"
#include "meshgraft/merge.hpp"
#include "support/scenes.hpp"

namespace meshgraft::scenes {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

Vec3 round(double radius, double turn, double z) {
  return {radius * std::cos(kTurn * turn), radius * std::sin(kTurn * turn), z};
}

Model tank() {
  return surface({.at = [](double u, double v) { return round(100, u, 120 * v); },
                  .nu = 63,
                  .nv = 12,
                  .closed_u = true,
                  .group = "TANK"});
}

/// Flat, around the tank and through its wall.
Model ring(double inner, double outer, std::size_t n_sides) {
  const auto n_rows = static_cast<std::size_t>(std::lround((outer - inner) / (kTurn * inner / double(n_sides))));
  return surface({.at = [=](double u, double v) { return round(std::lerp(inner, outer, v), u, 61.3); },
                  .nu = n_sides,
                  .nv = std::max<std::size_t>(1, n_rows),
                  .closed_u = true,
                  .group = "RING"});
}

/// A flange on a pipe, of one piece with it.
Model flanged_pipe() {
  const auto at = [](double u, double v) {
    return v < 0.5 ? round(60, u, 160 * v) : round(std::lerp(60, 130, 2 * v - 1), u, 80);
  };
  return surface({.at = at, .nu = 40, .nv = 16, .closed_u = true, .group = "PIPE"});
}

std::size_t n_kept(const Model& model, const Model& result, const std::function<bool(Vec3)>& counts) {
  const auto key = [](Vec3 p) { return std::tuple(p.x, p.y, p.z); };
  std::set<std::tuple<double, double, double>> there;
  for (const Vec3 p : result.position) there.insert(key(p));
  return static_cast<std::size_t>(
      std::ranges::count_if(model.position, [&](Vec3 p) { return counts(p) && there.contains(key(p)); }));
}

class RimInAZone : public testing::TestWithParam<std::tuple<double, double, std::size_t>> {};

TEST_P(RimInAZone, KeepsItsNodesAndTheRingItsArea) {
  const auto [inner, outer, n_sides] = GetParam();
  const Model base = tank(), part = ring(inner, outer, n_sides);
  const auto merged = merge(base, std::span(&part, 1));
  ASSERT_TRUE(merged) << to_string(merged.error());
  EXPECT_EQ(first_problem(merged->report), "");
  const Model result = apply(base, std::span(&part, 1), *merged);
  const auto on_rim = [&](Vec3 p) { return std::abs(std::hypot(p.x, p.y) - inner) < 1e-9 * inner; };
  EXPECT_EQ(n_kept(part, result, on_rim), n_sides);
  const double area = area_by_group(part).at("RING");
  EXPECT_NEAR(area_by_group(result).at("RING"), area, 1e-9 * area);
}
INSTANTIATE_TEST_SUITE_P(Rings, RimInAZone,
                         testing::Values(std::tuple(75, 130, 60), std::tuple(85, 130, 60), std::tuple(88, 112, 48)));

/// Round, on the wall z = 0.
Model pad(double radius, std::size_t n_sides, std::size_t n_rows) {
  return surface({.at = [=](double u, double v) { return round(std::lerp(0.6 * radius, radius, v), u, 0); },
                  .nu = n_sides,
                  .nv = n_rows,
                  .closed_u = true,
                  .group = "PAD"});
}

class OutlineOnAWall : public testing::TestWithParam<std::tuple<double, std::size_t, std::size_t>> {};

TEST_P(OutlineOnAWall, IsThatOfThePad) {
  const auto [radius, n_sides, n_rows] = GetParam();
  const Model base = plate({-103, -96, 0}, {200, 0, 0}, {0, 200, 0}, 8, "WALL", 0.2),
              part = pad(radius, n_sides, n_rows);
  const auto merged = merge(base, std::span(&part, 1));
  ASSERT_TRUE(merged) << to_string(merged.error());
  EXPECT_EQ(first_problem(merged->report), "");
  const Model result = apply(base, std::span(&part, 1), *merged);
  EXPECT_EQ(n_kept(part, result, [&](Vec3 p) { return std::hypot(p.x, p.y) > 0.999 * radius; }), n_sides);
  const double area = area_by_group(part).at("PAD");
  EXPECT_NEAR(area_by_group(result).at("PAD"), area, 1e-9 * area);
}
INSTANTIATE_TEST_SUITE_P(Pads, OutlineOnAWall,
                         testing::Values(std::tuple(50, 40, 3), std::tuple(40, 24, 2), std::tuple(30, 16, 2)));

TEST(FoldInAZone, KeepsItsNodes) {
  const Model base = flanged_pipe(), part = plate({-90, -90, 67}, {180, 7, 0}, {-7, 180, 0}, 8, "PLATE", 0.2);
  const auto merged = merge(base, std::span(&part, 1));
  ASSERT_TRUE(merged) << to_string(merged.error());
  EXPECT_EQ(first_problem(merged->report), "");
  const Model result = apply(base, std::span(&part, 1), *merged);
  const auto on_fold = [](Vec3 p) { return p.z == 80 && std::hypot(p.x, p.y) < 60.001; };
  EXPECT_EQ(n_kept(base, result, on_fold), 40u);
}

}  // namespace
}  // namespace meshgraft::scenes
