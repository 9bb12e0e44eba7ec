// Laws of a merge over open seams: nodes and free edges of one mesh in one place, not connected.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "meshgraft/check.hpp"
#include "meshgraft/merge.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

constexpr double kSize = 0.1;

double uniform(double low, double high) {
  constexpr int kSteps = 1 << 20;
  return low + (high - low) * *rc::gen::inRange(0, kSteps + 1) / kSteps;
}

/// Two plates side by side, `width` apart; the second has edges of another length if the seam does not match.
Model split_plate(Vec3 origin, Vec3 u, Vec3 v, double width, double second_size) {
  const Vec3 half = 0.5 * u, gap = width * normalized(u);
  return scenes::together(std::array{scenes::plate(origin, half, v, kSize, "LEFT", 0.15),
                                     scenes::plate(origin + half + gap, half, v, second_size, "RIGHT", 0.15)});
}

/// Nodes that faces of both groups have.
std::size_t n_shared(const Model& m) {
  std::array<std::set<NodeId>, 2> nodes;
  for (std::size_t e = 0; e < m.n_elements(); ++e)
    for (const GroupId g : m.group_sets.members(m.element_groups[e]))
      for (const std::size_t k : {0, 1})
        if (m.groups[g.value].name == (k == 0 ? "LEFT" : "RIGHT"))
          for (const NodeId n : m.nodes_of(ElementId(e))) nodes[k].insert(n);
  return static_cast<std::size_t>(std::ranges::count_if(nodes[0], [&](NodeId n) { return nodes[1].contains(n); }));
}

bool says_seam(const Report& report) {
  return std::ranges::any_of(report.warnings, [](const Warning& w) { return w.name == "seam-joined"; });
}

struct Scene {
  Model wall, part;
  double width = 0;     // of the seam
  bool matches = true;  // node on node
};

/// A part across the seam of the wall, through it or ending on it; or a wall under, or through, the seam of the part.
Scene random_scene(bool seam_in_wall) {
  const double width = *rc::gen::element(0.0, 1e-14, 1e-10, 1e-7, 1e-6, 1e-5, 1e-4, 4e-4);
  const double second_size = *rc::gen::element(1.0, 1.0, 0.5) * kSize;
  const double turn = uniform(-1, 1), lean = uniform(0.8, std::numbers::pi / 2);
  const double below = *rc::gen::element(0.0, 0.3);
  // Through nodes of the seam, up to rounding, or clear of them: a piece of an edge of the seam stays as short as it
  // is.
  const double y = *rc::gen::element(1.05, 1.0, 1.0 + 1e-7, 1.0 + 0.4 * width) + 0.1 * *rc::gen::inRange(-4, 5);
  const Vec3 along = *rc::gen::arbitrary<bool>() ? Vec3{1, 0, 0} : Vec3{std::cos(turn), std::sin(turn), 0};
  const Vec3 up = std::cos(lean) * Vec3{-along.y, along.x, 0} + Vec3{0, 0, std::sin(lean)};
  const Vec3 middle{1, y, 0};
  const Vec3 from = middle - 0.45 * along - below * up, height = (below + 0.4) * up;
  if (seam_in_wall)
    return {split_plate({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, width, second_size),
            scenes::plate(from, 0.9 * along, height, kSize, "PART", 0.1), width, second_size == kSize};
  return {scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, kSize, "WALL", 0.15),
          split_plate(from, 0.9 * along, height, width, second_size), width, second_size == kSize};
}

void joins_over_seams(bool seam_in_wall) {
  const bool held = rc::check([=] {
    const Scene s = random_scene(seam_in_wall);
    const auto merged = merge(s.wall, std::span(&s.part, 1));
    if (!merged) RC_FAIL(to_string(merged.error()));
    for (const Error& e : merged->report.broken_promises) RC_LOG() << to_string(e) << '\n';
    RC_ASSERT(merged->report.broken_promises.empty());
    RC_ASSERT(says_seam(merged->report));
    const Model result = apply(s.wall, std::span(&s.part, 1), *merged);
    const std::size_t shared = n_shared(result);
    RC_ASSERT(shared == 1u || (!seam_in_wall && shared > 0u));
    const CheckResult found = check(result), wall = check(s.wall), part = check(s.part);
    RC_ASSERT(found.non_manifold_edges > 0u);
    if (s.matches) RC_ASSERT(found.n_coincident_nodes <= wall.n_coincident_nodes + part.n_coincident_nodes);
    RC_ASSERT(std::abs(found.area - wall.area - part.area) <=
              1e-6 * found.area + 4 * static_cast<double>(shared) * s.width * kSize);
  });
  EXPECT_TRUE(held);
}

TEST(Seams, OfAWallShareOneNodeWhereAPartCrossesThem) { joins_over_seams(true); }
TEST(Seams, OfAPartShareNodesWhereItMeetsTheWall) { joins_over_seams(false); }

TEST(Seams, KeepTheirNodesBesideTheJunction) {
  const Model wall = split_plate({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, 0, kSize);
  const Model part = scenes::plate({0.5, 0.95, -0.3}, {1, 0, 0}, {0, 0, 0.6}, kSize, "PART");
  const auto merged = merge(wall, std::span(&part, 1));
  ASSERT_TRUE(merged);
  const Model result = apply(wall, std::span(&part, 1), *merged);
  const std::set<std::int64_t> labels(result.node_label.begin(), result.node_label.end());
  for (std::size_t n = 0; n < wall.n_nodes(); ++n) {
    const bool on_seam = wall.position[n].x == 1;
    EXPECT_TRUE(!on_seam || labels.contains(wall.node_label[n])) << wall.node_label[n];
  }
}

TEST(Seams, OfBothMeshesShareTheNodeInWhichTheyCross) {
  for (const double width : {0.0, 1e-10, 1e-7, 1e-4}) {
    const Model wall = split_plate({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, width, kSize);
    for (const double y : {1.03, 1.0})
      for (const double x : {0.5, 0.5 + 0.5 * width})
        for (const double below : {0.3, 0.33}) {
          const Model part = split_plate({x, y, -below}, {1, 0, 0}, {0, 0, 0.6}, width, kSize);
          const auto merged = merge(wall, std::span(&part, 1));
          SCOPED_TRACE(testing::Message() << width << ' ' << y << ' ' << x << ' ' << below);
          if (!merged) {
            ADD_FAILURE() << to_string(merged.error());
            continue;
          }
          for (const Error& e : merged->report.broken_promises) ADD_FAILURE() << to_string(e);
          EXPECT_TRUE(says_seam(merged->report));
        }
  }
}

constexpr double kRadius = 0.5;

/// Around the z axis, with or without an open seam along it.
Model tube(double from, double to, bool has_seam, const std::string& group) {
  scenes::Surface s;
  s.at = [=](double u, double v) {
    const double angle = 2 * std::numbers::pi * u;
    return Vec3{kRadius * std::cos(angle), kRadius * std::sin(angle), from + v * (to - from)};
  };
  s.nu = 30, s.nv = static_cast<std::size_t>(std::lround((to - from) / kSize)), s.closed_u = !has_seam, s.group = group;
  return scenes::surface(s);
}

TEST(Seams, OfOneEdgeAreSewnWhereBothEndsAreJoined) {
  const Model base = tube(0, 0.5, false, "LOWER");
  const std::array<Model, 2> parts{tube(0.5, 0.5 + kSize, true, "RING"), tube(0.5 + kSize, 1, false, "UPPER")};
  const auto merged = merge(base, parts);
  ASSERT_TRUE(merged);
  for (const Error& e : merged->report.broken_promises) ADD_FAILURE() << to_string(e);
  EXPECT_TRUE(says_seam(merged->report));
  EXPECT_EQ(check(apply(base, parts, *merged)).free_edges, 2u * 30u);
}

TEST(Seams, AreSewnBetweenTwoPlatesThatCrossOneEdge) {
  scenes::Surface s;
  s.at = [](double u, double v) {
    const double angle = 2 * std::numbers::pi * u;
    return Vec3{kRadius * std::cos(angle), kRadius * std::sin(angle), 0.9 * v};
  };
  s.nu = 30, s.nv = 3, s.group = "TUBE";
  const Model base = scenes::surface(s);
  const auto wall = [](double z, const std::string& group) {
    return scenes::plate({-1, -1, z}, {2, 0, 0}, {0, 2, 0}, kSize, group);
  };
  const std::array<Model, 2> parts{wall(0.38, "LOWER"), wall(0.52, "UPPER")};
  const auto merged = merge(base, parts);
  ASSERT_TRUE(merged);
  for (const Error& e : merged->report.broken_promises) ADD_FAILURE() << to_string(e);
  EXPECT_TRUE(says_seam(merged->report));
}

/// Of narrow faces, as programs for drawing write tubes: many sides, long facets, and a seam.
Model tube_of_narrow_faces(bool has_seam, std::size_t n_sides) {
  scenes::Surface s;
  s.at = [](double u, double v) {
    const double angle = 2 * std::numbers::pi * u;
    return Vec3{kRadius * std::cos(angle), kRadius * std::sin(angle), 5 * v};
  };
  s.nu = n_sides, s.nv = 11, s.closed_u = !has_seam, s.group = "TUBE";
  return scenes::surface(s);
}

TEST(Seams, OfNarrowFacesAreTheCauseOfWhatIsPoorBesideThem) {
  const Model base = tube_of_narrow_faces(true, 36);
  const Model part = scenes::plate({-0.8, -0.8, 2.4}, {1.6, 0, 0}, {0, 1.6, 0}, 2 * kSize, "WALL");
  const auto merged = merge(base, std::span(&part, 1));
  ASSERT_TRUE(merged);
  for (const Error& e : merged->report.broken_promises) ADD_FAILURE() << to_string(e);
  for (const Warning& w : merged->report.warnings)
    if (w.name == "poor-face") {
      EXPECT_NE(w.what.find("an edge of 0.455 that stays as it is in the input"), std::string::npos) << w.what;
    }
}

TEST(Zone, MayEndAcrossNarrowFaces) {
  const Model base = tube_of_narrow_faces(false, 72);
  const Model part = scenes::plate({-0.8, -0.8, 2.4}, {1.6, 0, 0}, {0, 1.6, 0}, 2 * kSize, "WALL");
  const auto merged = merge(base, std::span(&part, 1));
  ASSERT_TRUE(merged);
  for (const Error& e : merged->report.broken_promises) ADD_FAILURE() << to_string(e);
  EXPECT_EQ(merged->report.quality.below, 0u);
}

}  // namespace
}  // namespace meshgraft
