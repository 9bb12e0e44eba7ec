// Loose ends of parts beyond the junction.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

#include "meshgraft/check.hpp"
#include "meshgraft/merge.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

constexpr double kSize = 0.1;

Model wall() { return scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, kSize, "WALL", 0.15); }

Model rib(double below, double above, double y = 0.97) {
  return scenes::plate({0.33, y, -below}, {1.28, 0, 0}, {0, 0, below + above}, kSize, "RIB", 0.15);
}

MergeOptions trimming(double length) {
  MergeOptions options;
  options.trim = length;
  return options;
}

double area(const Model& m) { return check(m).area; }

Result<Merged> merged(const Model& base, const std::vector<Model>& parts, double length) {
  return merge(base, parts, trimming(length));
}

TEST(Trim, DropsWhatSticksOutByLessThanTheLength) {
  const Model base = wall();
  const std::vector<Model> parts{rib(0.07, 0.43)};
  const auto m = merged(base, parts, 0.08);
  ASSERT_TRUE(m) << to_string(m.error());
  for (const Error& e : m->report.broken_promises) ADD_FAILURE() << to_string(e);
  const Model result = apply(base, parts, *m);
  EXPECT_TRUE(check(result).sound());
  EXPECT_NEAR(area(result), 4 + 1.28 * 0.43, 1e-9);
  ASSERT_EQ(m->report.dropped.size(), 1u);
  const DroppedEntry& end = m->report.dropped[0];
  EXPECT_EQ(end.input, 1u);
  EXPECT_EQ(end.cause, "trimmed");
  EXPECT_NEAR(end.area, 1.28 * 0.07, 1e-9);
  EXPECT_NEAR(end.at.z, -0.035, 1e-9);
  EXPECT_EQ(end.groups, std::vector<std::string>{"RIB"});
  const auto rib_entry = std::ranges::find(m->report.groups, "RIB", &GroupEntry::name);
  EXPECT_NEAR(rib_entry->area_after, 1.28 * 0.43, 1e-9);
  EXPECT_NE(rib_entry->rule.find("dropped"), std::string::npos) << rib_entry->rule;
}

TEST(Trim, LeavesWhatSticksOutFarther) {
  const Model base = wall();
  const std::vector<Model> parts{rib(0.09, 0.43)};
  const auto m = merged(base, parts, 0.08);
  ASSERT_TRUE(m) << to_string(m.error());
  EXPECT_TRUE(m->report.dropped.empty());
  EXPECT_NEAR(area(apply(base, parts, *m)), 4 + 1.28 * 0.52, 1e-9);
}

TEST(Trim, LeavesBothEndsWhereTheLengthWouldDropTheWholePart) {
  const Model base = wall();
  const std::vector<Model> parts{rib(0.2, 0.3)};
  const auto m = merged(base, parts, 0.5);
  ASSERT_TRUE(m) << to_string(m.error());
  EXPECT_TRUE(m->report.dropped.empty());
}

TEST(Trim, LeavesThePieceBetweenTwoWalls) {
  const std::vector<Model> walls{wall(), scenes::plate({0, 0, 0.2}, {2, 0, 0}, {0, 2, 0}, kSize, "WALL2")};
  const Model base = scenes::together(walls);
  const std::vector<Model> parts{rib(0.05, 0.9)};
  const auto m = merged(base, parts, 0.3);
  ASSERT_TRUE(m) << to_string(m.error());
  for (const Error& e : m->report.broken_promises) ADD_FAILURE() << to_string(e);
  ASSERT_EQ(m->report.dropped.size(), 1u);  // the end below the first wall
  EXPECT_LT(m->report.dropped[0].at.z, 0);
}

TEST(Trim, LeavesAnEndThatABeamHolds) {
  Model part = rib(0.07, 0.43);
  NodeId lowest(std::size_t{0});
  for (std::size_t n = 0; n < part.n_nodes(); ++n)
    if (part.position[n].z < part.position[lowest.value].z) lowest = NodeId(n);
  ModelBuilder builder;
  std::vector<NodeId> nodes;
  for (const Vec3 p : part.position) nodes.push_back(builder.add_node(p));
  for (std::size_t e = 0; e < part.n_elements(); ++e) {
    const auto v = part.nodes_of(ElementId(e));
    builder.add_to_group("RIB", builder.add_face(nodes[v[0].value], nodes[v[1].value], nodes[v[2].value]));
  }
  builder.add_line(nodes[lowest.value], builder.add_node(part.position[lowest.value] - Vec3{0, 0, 1}));
  const Model base = wall();
  const std::vector<Model> parts{builder.build()};
  const auto m = merged(base, parts, 0.08);
  ASSERT_TRUE(m) << to_string(m.error());
  EXPECT_TRUE(m->report.dropped.empty());
}

TEST(Trim, ATubeThroughAWallLosesItsRing) {
  const Model base = wall();
  const std::vector<Model> parts{scenes::cylinder({1, 1, -0.1}, {1, 1, 0.8}, 0.4, kSize, "TUBE")};
  const auto m = merged(base, parts, 0.15);
  ASSERT_TRUE(m) << to_string(m.error());
  for (const Error& e : m->report.broken_promises) ADD_FAILURE() << to_string(e);
  ASSERT_EQ(m->report.dropped.size(), 1u);
  const Model result = apply(base, parts, *m);
  EXPECT_TRUE(check(result).sound());
  for (const Vec3 p : result.position) EXPECT_GE(p.z, -1e-9);
}

TEST(Trim, AreaIsKeptOrDropped) {
  EXPECT_TRUE(rc::check("area before = area after + area dropped", [] {
    const double below = 0.01 * *rc::gen::inRange(2, 20), above = 0.01 * *rc::gen::inRange(30, 60);
    const double length = 0.01 * *rc::gen::inRange(3, 25), y = 0.001 * *rc::gen::inRange(500, 1500);
    const Model base = wall();
    const std::vector<Model> parts{rib(below, above, y)};
    const auto m = merged(base, parts, length);
    RC_ASSERT(m.has_value());
    RC_ASSERT(m->report.broken_promises.empty());
    double dropped = 0;
    for (const DroppedEntry& d : m->report.dropped) dropped += d.area;
    RC_ASSERT(std::abs(area(apply(base, parts, *m)) + dropped - area(base) - area(parts[0])) < 1e-9);
    if (length > below + 1e-9) RC_ASSERT(m->report.dropped.size() == 1u);
    if (length < below - 1e-9) RC_ASSERT(m->report.dropped.empty());
  }));
}

/// A rib of square faces, whose foot is in one row of nodes.
Model straight_rib(double below) {
  return scenes::plate({0.33, 0.97, -below}, {1.28, 0, 0}, {0, 0, 0.6}, kSize, "RIB");
}

std::ptrdiff_t n_sticking_out(const Report& report) {
  return std::ranges::count(report.warnings, "sticks-out", &Warning::name);
}

TEST(Penetration, WithinTheToleranceIsDrawnBackAsAWholeOrTold) {
  const Model base = wall();
  for (const double below : {0.04, 0.08, 0.09, 0.095, 0.12}) {  // 0.095 is the limit, but for rounding
    SCOPED_TRACE(below);
    const std::vector<Model> parts{straight_rib(below)};
    MergeOptions options;
    options.tolerance = {1.1 * below, false};
    const auto m = merge(base, parts, options);
    ASSERT_TRUE(m) << to_string(m.error());
    for (const Error& e : m->report.broken_promises) ADD_FAILURE() << to_string(e);
    const bool told = n_sticking_out(m->report) == 1;
    if (below != 0.095) {
      EXPECT_EQ(told, below > 0.095);
    }
    EXPECT_EQ(told, m->report.moved.empty());
    EXPECT_NEAR(std::ranges::min(apply(base, parts, *m).position, {}, &Vec3::z).z, told ? -below : 0, 1e-12);
  }
}

/// A rib whose foot goes down from the wall to 0.12 below it, and that may lean.
Model tapered_rib(double lean) {
  return scenes::moved(straight_rib(0), [&](Vec3 p) {
    const double z = p.z - 0.12 * (p.x - 0.33) / 1.28 * (1 - p.z / 0.6);
    return Vec3{p.x, p.y + lean * z, z};
  });
}

TEST(Penetration, OfAFootThatGoesDownStaysWhereItIsDeepAndCanBeTrimmed) {
  const Model base = wall();
  for (const double lean : {0.0, 0.7}) {
    SCOPED_TRACE(lean);
    const std::vector<Model> parts{tapered_rib(lean)};
    MergeOptions options;
    options.tolerance = {0.125, false};
    const auto m = merge(base, parts, options);
    ASSERT_TRUE(m) << to_string(m.error());
    for (const Error& e : m->report.broken_promises) ADD_FAILURE() << to_string(e);
    EXPECT_GE(m->report.quality.min, 0.5);
    EXPECT_FALSE(m->report.moved.empty());
    EXPECT_EQ(n_sticking_out(m->report), 1);
    options.trim = 0.16;
    const auto trimmed = merge(base, parts, options);
    ASSERT_TRUE(trimmed) << to_string(trimmed.error());
    EXPECT_EQ(trimmed->report.dropped.size(), 1u);
    EXPECT_EQ(n_sticking_out(trimmed->report), 0);
    EXPECT_GE(std::ranges::min(apply(base, parts, *trimmed).position, {}, &Vec3::z).z, -1e-12);
  }
}

TEST(Penetration, IsNotToldOnceItIsTrimmed) {
  const Model base = wall();
  const std::vector<Model> parts{straight_rib(0.12)};
  MergeOptions options = trimming(0.13);
  options.tolerance = {0.15, false};
  const auto m = merge(base, parts, options);
  ASSERT_TRUE(m) << to_string(m.error());
  EXPECT_EQ(m->report.dropped.size(), 1u);
  EXPECT_EQ(n_sticking_out(m->report), 0);
}

}  // namespace
}  // namespace meshgraft
