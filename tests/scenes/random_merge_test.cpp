// Laws of a merge over random stiffeners on random walls.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <numbers>

#include "meshgraft/check.hpp"
#include "meshgraft/merge.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

double uniform(double low, double high) {
  constexpr int kSteps = 1 << 20;
  return low + (high - low) * *rc::gen::inRange(0, kSteps + 1) / kSteps;
}

/// A rigid motion that is the same for all models of a scene.
std::function<Vec3(Vec3)> random_motion() {
  const double a = uniform(0, 2 * std::numbers::pi), b = uniform(-1.5, 1.5), s = uniform(-2, 2);
  const Vec3 shift{s, -s, 3 * s};
  return [=](Vec3 p) {
    const Vec3 q{std::cos(a) * p.x - std::sin(a) * p.y, std::sin(a) * p.x + std::cos(a) * p.y, p.z};
    return Vec3{q.x, std::cos(b) * q.y - std::sin(b) * q.z, std::sin(b) * q.y + std::cos(b) * q.z} + shift;
  };
}

struct Scene {
  Model wall, part;
};

/// A stiffener anywhere within the wall, crossing it or ending on it, at 30 to 90 degrees.
Scene random_scene() {
  constexpr double kSize = 0.1;
  const double part_size = kSize * uniform(0.5, 2);
  const double turn = uniform(0, 2 * std::numbers::pi), lean = uniform(0.52, std::numbers::pi / 2);
  const double below = *rc::gen::arbitrary<bool>() ? 0 : uniform(0.2, 0.4);
  const Vec3 along{std::cos(turn), std::sin(turn), 0}, across{-along.y, along.x, 0};
  const Vec3 up = std::cos(lean) * across + Vec3{0, 0, std::sin(lean)};
  const Vec3 middle{uniform(0.8, 1.2), uniform(0.8, 1.2), 0};
  const double length = uniform(0.5, 1.1);
  const auto motion = random_motion();
  Scene s;
  s.wall = scenes::moved(scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, kSize, "WALL", 0.15), motion);
  s.part = scenes::moved(scenes::plate(middle - 0.5 * length * along - below * up, length * along, (below + 0.4) * up,
                                       part_size, "PART", 0.1),
                         motion);
  return s;
}

TEST(RandomMerge, IsConformingAndFitForAnalysis) {
  const bool held = rc::check([] {
    const Scene s = random_scene();
    const auto merged = merge(s.wall, std::span(&s.part, 1));
    if (!merged) RC_FAIL(to_string(merged.error()));
    for (const Error& e : merged->report.broken_promises) RC_LOG() << to_string(e) << '\n';
    RC_ASSERT(merged->report.broken_promises.empty());
    const Model result = apply(s.wall, std::span(&s.part, 1), *merged);
    const CheckResult found = check(result);
    RC_ASSERT(found.sound());
    RC_ASSERT(found.n_orphan_nodes == 0u);
    RC_ASSERT(found.non_manifold_edges > 0u);
    const CheckResult wall = check(s.wall), part = check(s.part);
    RC_ASSERT(std::abs(found.area - wall.area - part.area) <= 1e-6 * found.area);
  });
  EXPECT_TRUE(held);
}

}  // namespace
}  // namespace meshgraft
