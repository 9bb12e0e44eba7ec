// Laws of a merge over random stiffeners on random walls.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
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
    double moved = 0;  // area that the nodes pulled within the tolerance may sweep
    for (const MovedEntry& entry : merged->report.moved) moved += entry.distance * part.mean_edge_length;
    RC_ASSERT(std::abs(found.area - wall.area - part.area) <= 1e-6 * found.area + moved);
  });
  EXPECT_TRUE(held);
}

/// Nodes on one side of a random plane near the middle of the model, and a few single ones.
Model with_node_group(Model m, const std::string& name) {
  const std::size_t n = m.n_nodes();
  const Vec3 through = m.position[*rc::gen::inRange(std::size_t{0}, n)];
  const Vec3 normal{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
  std::vector<bool> in(n);
  for (std::size_t v = 0; v < n; ++v) in[v] = dot(normal, m.position[v] - through) > 0;
  for (int k = 0; k < 3; ++k) in[*rc::gen::inRange(std::size_t{0}, n)] = true;
  const GroupId group(m.groups.size());
  m.groups.push_back({name});
  for (std::size_t v = 0; v < n; ++v) {
    if (!in[v]) continue;
    m.node_groups[v] = m.group_sets.with(m.node_groups[v], group);
    ++m.groups.back().n_nodes;
  }
  return m;
}

bool is_in(const Model& m, std::size_t node, const std::string& name) {
  return std::ranges::any_of(m.group_sets.members(m.node_groups[node]),
                             [&](GroupId g) { return m.groups[g.value].name == name; });
}

TEST(RandomMerge, OneNameInBothInputsUnitesTheirNodesAndChangesNothingElse) {
  const bool held = rc::check([] {
    const Scene s = random_scene();
    const Model wall = with_node_group(s.wall, "LOAD"), part = with_node_group(s.part, "LOAD");
    Model renamed = part;
    renamed.groups.back().name = "OTHER";
    const auto one = merge(wall, std::span(&part, 1)), two = merge(wall, std::span(&renamed, 1));
    RC_ASSERT(one.has_value() && two.has_value());
    const Model united = apply(wall, std::span(&part, 1), *one), apart = apply(wall, std::span(&renamed, 1), *two);
    RC_ASSERT(united.position == apart.position);
    RC_ASSERT(united.nodes == apart.nodes);
    for (std::size_t v = 0; v < united.n_nodes(); ++v)
      RC_ASSERT(is_in(united, v, "LOAD") == (is_in(apart, v, "LOAD") || is_in(apart, v, "OTHER")));
  });
  EXPECT_TRUE(held);
}

}  // namespace
}  // namespace meshgraft
