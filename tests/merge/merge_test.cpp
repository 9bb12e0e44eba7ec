// The whole pipeline: laws that every merge keeps, whatever the scene.
#include "meshgraft/merge.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "geometry/quality.hpp"
#include "merge/merge_laws.hpp"
#include "meshgraft/check.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

using namespace merge_laws;

/// A wall with a node in the middle of one edge, on one side only: a face without area closes the slit.
Model wall_with_flat_face(Vec3 near) {
  const Model whole = wall(0);
  ModelBuilder builder;
  for (const Vec3 p : whole.position) builder.add_node(p);
  bool is_cut = false;
  for (std::size_t e = 0; e < whole.n_elements(); ++e) {
    const auto v = whole.nodes_of(ElementId(e));
    const Triangle t = whole.corners(ElementId(e));
    if (is_cut || distance(centroid(t), near) > 0.6 * kSize) {
      builder.add_face(v[0], v[1], v[2]);
      continue;
    }
    is_cut = true;
    const NodeId middle = builder.add_node(midpoint(t[0], t[1]));
    builder.add_face(v[0], middle, v[2]), builder.add_face(middle, v[1], v[2]), builder.add_face(v[0], v[1], middle);
  }
  return builder.build();
}

/// A piece that sticks out beyond the border of the other plate may be a sliver: no sign of a finer mesh there.
TEST(Merge, WhatContactLeavesOfAFaceSaysNothingOfTheSizeThere) {
  constexpr double kEdge = 0.08, kJitter = 0.2;
  const Model base = scenes::staggered_plate({-1, -0.7, 0}, {2, 0, 0}, {0, 1.4, 0}, kEdge, "WALL", kJitter);
  const Model strake = scenes::staggered_plate({-0.6, -0.45, 0}, {1.2, 0, 0}, {0, 0.9, 0}, kEdge, "STRAKE", kJitter);
  for (const int degrees : {7, 20, 33, 46, 59, 72, 85}) {
    const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
    const Model part = scenes::moved(strake, [&](Vec3 p) {
      return Vec3{0.93 + c * p.x - s * p.y, 0.52 + s * p.x + c * p.y, 0};
    });
    const auto result = merge(base, std::span(&part, 1));
    ASSERT_TRUE(result) << to_string(result.error());
    EXPECT_LE(std::ranges::max(result->report.zone.bandwidth), 6) << degrees;
  }
}

/// A wall in which the face nearest to a point uses a node twice.
Model wall_with_collapsed_face(Vec3 near) {
  const Model whole = wall(0);
  std::size_t nearest = 0;
  const auto far = [&](std::size_t e) { return distance(centroid(whole.corners(ElementId(e))), near); };
  for (std::size_t e = 0; e < whole.n_elements(); ++e)
    if (far(e) < far(nearest)) nearest = e;
  ModelBuilder builder;
  for (const Vec3 p : whole.position) builder.add_node(p);
  for (std::size_t e = 0; e < whole.n_elements(); ++e) {
    const auto v = whole.nodes_of(ElementId(e));
    builder.add_face(v[0], e == nearest ? v[0] : v[1], v[2]);
  }
  return builder.build();
}

TEST(Merge, AFaceThatUsesANodeTwiceIsNamedOrLeftAsItIs) {
  const Model part = stiffener(0.43, 1.57, 0.97, 0.3, 0.4);
  int n_merged = 0, n_named = 0;
  for (const double x : {0.6, 0.83, 1.0, 1.17, 1.4})
    for (const double y : {0.95, 1.03, 1.1, 1.17, 1.25, 1.8}) {
      const auto result = merge(wall_with_collapsed_face({x, y, 0}), std::span(&part, 1));
      if (result) {
        EXPECT_TRUE(result->report.broken_promises.empty()) << to_string(result->report.broken_promises.front());
        ++n_merged;
      } else {
        EXPECT_EQ(result.error().code, ErrorCode::kDegenerateFace) << to_string(result.error());
        if (result.error().what.find("uses a node twice") != std::string::npos) ++n_named;
      }
    }
  EXPECT_GE(n_merged, 4);
  EXPECT_GE(n_named, 4);
}

std::ptrdiff_t n_flat(const Model& model) {
  std::ptrdiff_t n = 0;
  for (std::size_t e = 0; e < model.n_elements(); ++e) n += aspect_ratio(model.corners(ElementId(e))) < 1e-9 ? 1 : 0;
  return n;
}

/// Many are replaced by good ones, which is told; the others are named.
TEST(Merge, AFaceWithoutAreaThatCannotBeRemeshedIsNamed) {
  const Model part = stiffener(0.43, 1.57, 0.97, 0.3, 0.4);
  std::ptrdiff_t n_merged = 0, n_named = 0, n_told = 0;
  for (const double x : {0.6, 0.83, 1.0, 1.17})
    for (const double y : {0.95, 1.03, 1.1, 1.17, 1.8}) {
      const Model wall = wall_with_flat_face({x, y, 0});
      const auto result = merge(wall, std::span(&part, 1));
      if (result) {
        EXPECT_TRUE(result->report.broken_promises.empty()) << to_string(result->report.broken_promises.front());
        const auto told = std::ranges::count(result->report.warnings, "mended-face", &Warning::name);
        const Model merged = apply(wall, std::span(&part, 1), *result);
        EXPECT_EQ(told, n_flat(wall) - n_flat(merged)) << x << ' ' << y;
        ++n_merged, n_told += told;
      } else {
        EXPECT_EQ(result.error().code, ErrorCode::kDegenerateFace) << to_string(result.error());
        if (result.error().what.find("would have to be remeshed") != std::string::npos) ++n_named;
      }
    }
  EXPECT_GE(n_merged, 4);
  EXPECT_GE(n_named, 1);
  EXPECT_GE(n_told, 1);
}

/// No program computes with it, so that its being there is no secret.
TEST(Merge, AFaceWithoutAreaBesideTheZoneStaysAndIsTold) {
  const Model part = stiffener(0.43, 1.57, 0.97, 0.3, 0.4);
  for (const Model& wall : {wall_with_flat_face({0.3, 0.2, 0}), wall_with_collapsed_face({0.3, 0.2, 0})}) {
    const auto result = merge(wall, std::span(&part, 1));
    ASSERT_TRUE(result) << to_string(result.error());
    EXPECT_TRUE(result->report.broken_promises.empty()) << to_string(result->report.broken_promises.front());
    EXPECT_EQ(n_flat(wall), 1);
    EXPECT_EQ(n_flat(apply(wall, std::span(&part, 1), *result)), 1);
    EXPECT_EQ(std::ranges::count(result->report.warnings, "flat-face", &Warning::name), 1);
    EXPECT_EQ(std::ranges::count(result->report.warnings, "mended-face", &Warning::name), 0);
  }
}

TEST(Merge, ACrossingPlateKeepsAllPromises) {
  const Model base = wall();
  const std::vector<Model> parts{stiffener(0.33, 1.61, 0.97, 0.31, 0.43)};
  const Merged m = merged(base, parts);
  expect_laws(base, parts, m);
  ASSERT_EQ(m.report.junction.size(), 1u);
  EXPECT_NEAR(m.report.junction[0].length, 1.28, 1e-9);
  EXPECT_GE(m.report.quality.min, 0.5);
}

TEST(Merge, APlateThatEndsOnTheWallKeepsAllPromises) {
  const Model base = wall();
  const std::vector<Model> parts{stiffener(0.33, 1.61, 0.97, 0, 0.43)};
  const Merged m = merged(base, parts);
  expect_laws(base, parts, m);
  EXPECT_GE(m.report.quality.min, 0.5);
}

TEST(Merge, ARibOnACylinderStaysOnItsSurface) {
  const Model base = scenes::cylinder({0, 0, 0}, {0, 0, 2}, 0.7, kSize);
  const std::vector<Model> parts{scenes::plate({0.45, 0.11, 0.31}, {0.7, 0, 0}, {0, 0, 1.3}, kSize, "RIB", 0.15)};
  const Merged m = merged(base, parts);
  expect_laws(base, parts, m);
  EXPECT_LT(m.report.fidelity->max_distance_relative, 0.1);
}

TEST(Merge, TwoPartsThatCrossEachOtherAndTheWallMeetInOneNode) {
  const Model base = wall();
  const std::vector<Model> parts{stiffener(0.33, 1.61, 0.97, 0.31, 0.43),
                                 scenes::plate({0.91, 0.4, 0}, {0, 1.2, 0}, {0, 0, 0.35}, 0.09, "SECOND", 0.15)};
  const Merged m = merged(base, parts);
  expect_laws(base, parts, m);
  const Model result = apply(base, parts, m);
  std::map<NodeId, std::set<std::string>> around;
  for (std::size_t e = 0; e < result.n_elements(); ++e)
    for (const NodeId n : result.nodes_of(ElementId(e))) around[n].merge(names(result, result.element_groups[e]));
  EXPECT_TRUE(std::ranges::any_of(around, [](const auto& n) { return n.second.size() == 3; }));
}

TEST(Merge, RandomStandingPlatesKeepAllPromises) {
  EXPECT_TRUE(rc::check([] {
    const auto unit = [] { return *rc::gen::inRange(0, 1000) / 1000.0; };
    const double x0 = 0.15 + 0.5 * unit(), x1 = x0 + 0.4 + 0.7 * unit(), y = 0.3 + 1.4 * unit();
    const bool ends = *rc::gen::arbitrary<bool>();
    const double size = kSize * (0.6 + 0.8 * unit());
    const Model base = wall(0.2 * unit());
    const std::vector<Model> parts{stiffener(x0, x1, y, ends ? 0 : 0.3, 0.43, size)};
    const Result<Merged> m = merge(base, parts);
    RC_ASSERT(m.has_value());
    RC_LOG(m->report.broken_promises.empty() ? "" : to_string(m->report.broken_promises.front()));
    RC_ASSERT(m->report.broken_promises.empty());
    expect_laws(base, parts, *m);
  }));
}

TEST(Merge, IsTheSameTwice) {
  const Model base = wall();
  const std::vector<Model> parts{stiffener(0.33, 1.61, 0.97, 0.31, 0.43)};
  const Model a = apply(base, parts, merged(base, parts)), b = apply(base, parts, merged(base, parts));
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.nodes, b.nodes);
  EXPECT_EQ(a.element_label, b.element_label);
  EXPECT_EQ(a.element_groups, b.element_groups);
}

TEST(Merge, SwappingTheInputsKeepsTheSizeOfEverything) {
  const Model wall_model = wall(), part = stiffener(0.33, 1.61, 0.97, 0.31, 0.43);
  const Merged a = merged(wall_model, {part}), b = merged(part, {wall_model});
  EXPECT_NEAR(a.report.junction.at(0).length, b.report.junction.at(0).length, 1e-9);
  EXPECT_EQ(a.report.junction[0].nodes, b.report.junction[0].nodes);
  ASSERT_EQ(b.report.groups.size(), 2u);
  EXPECT_EQ(a.report.groups[0].name, b.report.groups[1].name);
  EXPECT_NEAR(a.report.groups[0].area_after, b.report.groups[1].area_after, 1e-9);
}

TEST(Merge, ExplicitNodesStayAndCoveringGroupsStillCover) {
  Model plain = wall(0);
  ModelBuilder b;
  for (const Vec3 p : plain.position) b.add_node(p);
  for (std::size_t e = 0; e < plain.n_elements(); ++e) {
    const auto n = plain.nodes_of(ElementId(e));
    b.add_to_group("WALL", b.add_face(n[0], n[1], n[2]));
  }
  for (std::size_t n = 0; n < plain.n_nodes(); ++n) b.add_to_group("ALL", NodeId(n));
  const NodeId bolt(10 * 21 + 9);  // at (0.9, 1), close to the junction
  b.add_to_group("BOLT", bolt);
  const Model base = b.build();
  const std::vector<Model> parts{stiffener(0.33, 1.61, 0.96, 0.31, 0.43)};
  const Merged m = merged(base, parts);
  expect_laws(base, parts, m);
  const Model result = apply(base, parts, m);
  std::set<std::string> at_bolt;
  for (std::size_t n = 0; n < result.n_nodes(); ++n)
    if (result.node_label[n] == base.node_label[bolt.value]) at_bolt = names(result, result.node_groups[n]);
  EXPECT_EQ(at_bolt, (std::set<std::string>{"ALL", "BOLT"}));
  for (std::size_t e = 0; e < result.n_elements(); ++e) {
    if (!names(result, result.element_groups[e]).contains("WALL")) continue;
    for (const NodeId n : result.nodes_of(ElementId(e))) {
      EXPECT_TRUE(names(result, result.node_groups[n.value]).contains("ALL"));
    }
  }
  for (const GroupEntry& g : m.report.groups) EXPECT_TRUE(g.name != "BOLT" || g.members_after == 1);
}

TEST(Merge, AnOldTLineOfTheBaseIsCrossedAndStays) {
  const std::array<Model, 3> pieces{scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, kSize, "WALL"),
                                    scenes::plate({0, 1, 0}, {2, 0, 0}, {0, 1, 0}, kSize, "WALL"),
                                    scenes::plate({0, 1, 0}, {2, 0, 0}, {0, 0, 0.4}, kSize, "RIB")};
  const Model base = scenes::welded(scenes::together(pieces));
  const std::vector<Model> parts{
      scenes::plate({0.87, 0.33, -0.31}, {0, 1.38, 0}, {0, 0, 0.94}, kSize, "STIFFENER", 0.15)};
  expect_laws(base, parts, merged(base, parts));
}

TEST(Merge, APartSharingNodesWithTheBaseIsJoinedThere) {
  const Model base = wall(0);
  const std::vector<Model> parts{scenes::plate({0.3, 1, 0}, {1.2, 0, 0}, {0, 0, 0.7}, kSize, "STIFFENER")};
  const Merged m = merged(base, parts);
  expect_laws(base, parts, m);
  EXPECT_NEAR(m.report.junction.at(0).length, 1.2, 1e-9);
}

TEST(Merge, AShortPartIsPulledOntoTheWallAndEachMoveIsReported) {
  const double gap = 0.004 * kSize;
  const Model base = wall();
  std::vector<Model> parts{stiffener(0.33, 1.61, 0.97, 0, 0.43)};
  parts[0] = scenes::moved(parts[0], [=](Vec3 p) { return p + Vec3{0, 0, gap}; });
  const Merged m = merged(base, parts);
  expect_laws(base, parts, m);
  for (const MovedEntry& moved : m.report.moved) {
    EXPECT_EQ(moved.input, 1u);
    EXPECT_NEAR(moved.distance, gap, 1e-12);
  }
  // The whole foot, also the nodes that the remeshing has taken away.
  const auto of_foot = [&](Vec3 p) { return p.z == gap; };
  EXPECT_EQ(m.report.moved.size(), static_cast<std::size_t>(std::ranges::count_if(parts[0].position, of_foot)));
}

TEST(Merge, ALeaningPartThatEndsShortOfTheWallIsExtendedInItsOwnPlane) {
  const double lean = 0.8, gap = 0.4 * kSize;
  const Vec3 up{0, std::cos(lean), std::sin(lean)}, normal{0, -std::sin(lean), std::cos(lean)};
  const Model base = wall();
  const std::vector<Model> parts{
      scenes::staggered_plate({0.33, 0.97, gap}, {1.28, 0, 0}, 0.43 * up, kSize, "PART", 0.15)};
  MergeOptions options;
  options.tolerance = {0.5 * kSize, false};
  const Merged m = merged(base, parts, options);
  EXPECT_TRUE(m.report.broken_promises.empty());
  ASSERT_FALSE(m.report.moved.empty());
  for (const MovedEntry& moved : m.report.moved) {
    EXPECT_NEAR(dot(moved.to - moved.from, normal), 0, 1e-12);
    EXPECT_NEAR(moved.to.z, 0, 1e-12);
  }
  const auto part = std::ranges::find(m.report.groups, "PART", &GroupEntry::name);
  EXPECT_NEAR(part->area_after - part->area_before, 1.28 * gap / std::sin(lean), 1e-9);
  EXPECT_NE(part->rule.find("stretched over gaps"), std::string::npos);
}

TEST(Merge, ABaseThatEndsShortOfAPartIsToldToBeThePart) {
  const std::vector<Model> parts{wall()};
  const Model base = scenes::staggered_plate({0.33, 0.97, 0.4 * kSize}, {1.28, 0, 0}, {0, 0, 0.43}, kSize, "STIFFENER");
  MergeOptions options;
  options.tolerance = {0.5 * kSize, false};
  const auto result = merge(base, parts, options);
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().code, ErrorCode::kPartsApart);
  EXPECT_NE(result.error().hint.find("never moved"), std::string::npos) << result.error().hint;
}

TEST(Merge, CoarseTubesKeepTheirSurfaceAndTheirEnds) {
  // Facets that turn by 13, 21 and 24 degrees, of faces that are all Q 0.72.
  const Model base = scenes::cylinder({0, 0, 0}, {0, 0, 2}, 0.45, kSize, "RUN");
  const std::vector<Model> parts{scenes::cylinder({-1, 0.03, 1.04}, {1, 0.03, 1.04}, 0.3, 0.11, "BRANCH"),
                                 scenes::cylinder({0.02, -1, 0.95}, {0, 1, 0.95}, 0.25, 0.105, "BRANCH_2")};
  const Merged m = merged(base, parts);
  for (const Error& e : m.report.broken_promises) ADD_FAILURE() << to_string(e);
  EXPECT_LE(m.report.fidelity->max_distance_relative, 0.085);
  EXPECT_GE(m.report.quality.min, 0.5);
  EXPECT_GE(m.report.quality.mean, 0.83);
}

TEST(Merge, SmallFacesAmongLargeOnesOfACurvedMeshAreFollowedToo) {
  const auto uneven = [](double t) { return t + 0.5 / (14 * std::numbers::pi) * std::sin(14 * std::numbers::pi * t); };
  const auto bumps = [&](double u, double v) {
    const double x = 2 * uneven(u), y = 2 * uneven(v);
    return Vec3{x, y, 0.08 * std::cos(6 * x) * std::cos(7 * y)};
  };
  for (const double y : {0.78, 1.02}) {
    const Model base = scenes::surface({bumps, 21, 21, false, false, 0.2, 1, "BUMPS"});
    const Merged m = merged(base, {stiffener(0.33, 1.61, y, 0.4, 0.4, 0.07)});
    for (const Error& e : m.report.broken_promises) ADD_FAILURE() << to_string(e);
    EXPECT_GE(m.report.quality.min, 0.5);
    EXPECT_LE(m.report.fidelity->removed.max_distance_relative, 0.1);
  }
}

TEST(Merge, AnEndNearTheJunctionKeepsItsShape) {
  // A pipe of 20 facets through a wall of 40, askew: the end inside is three rows from the junction.
  const auto run = [](double u, double v) {
    const double a = 2 * std::numbers::pi * u;
    return Vec3{50 * std::cos(a), 50 * std::sin(a), 400 * v - 200};
  };
  const auto branch = [](double u, double v) {
    const double a = 2 * std::numbers::pi * u, along = 200 * v / std::numbers::sqrt2,
                 across = 35 * std::sin(a) / std::numbers::sqrt2;
    return Vec3{along - across, 35 * std::cos(a), along + across};
  };
  const Model base = scenes::surface({run, 40, 30, true, false, 0, 1, "RUN"});
  const Merged m = merged(base, {scenes::surface({branch, 20, 15, true, false, 0, 1, "BRANCH"})});
  for (const Error& e : m.report.broken_promises) ADD_FAILURE() << to_string(e);
  EXPECT_GE(m.report.quality.min, 0.5);
}

TEST(Merge, EdgesThatNearlyMeetAreNamed) {
  // Two stiffeners, one of them short of the wall by less, or more, than a quarter of an edge; or standing off it.
  const auto misses = [](double short_by) {
    const std::vector<Model> both{stiffener(0.4, 1.6, 0.72, 0.3, 0.4), stiffener(0.4, 1.6, 1.12, -short_by, 0.4)};
    const Merged m = merged(wall(), {scenes::together(both)});
    return std::ranges::count(m.report.warnings, "near-miss", &Warning::name);
  };
  EXPECT_EQ(misses(0.02), 1);
  EXPECT_EQ(misses(0.04), 0);
  EXPECT_EQ(misses(0), 0);
}

TEST(Merge, PartsApartAreAnErrorUnlessAllowed) {
  const Model base = wall();
  const std::vector<Model> parts{stiffener(0.33, 1.61, 0.97, 0.31, 0.43), stiffener(0.3, 1.2, 0.5, -1, 1.5)};
  const auto result = merge(base, parts);
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().code, ErrorCode::kPartsApart);
  MergeOptions options;
  options.allow_apart = true;
  const Merged m = merged(base, parts, options);
  expect_laws(base, parts, m);
  ASSERT_FALSE(m.report.warnings.empty());
  EXPECT_EQ(m.report.warnings.back().name, "parts-apart");
  const Merged alone = merged(base, {parts[1]}, options);
  EXPECT_TRUE(alone.graft.removed_elements[0].empty());
  EXPECT_EQ(apply(base, std::vector{parts[1]}, alone).n_elements(), base.n_elements() + parts[1].n_elements());
}

TEST(Merge, PartsWithoutFacesAreRefused) {
  const Model base = wall();
  ModelBuilder b;
  b.add_line(b.add_node({0, 0, 0}), b.add_node({1, 0, 0}));
  EXPECT_EQ(merge(base, std::vector{b.build()}).error().code, ErrorCode::kNoFaces);
}

TEST(Merge, TheReportIsValidJsonAndAddsUp) {
  const Model base = wall();
  const std::vector<Model> parts{stiffener(0.33, 1.61, 0.97, 0.31, 0.43)};
  std::vector<std::string> stages;
  MergeOptions options;
  options.progress = [&](std::string_view stage, double done) {
    EXPECT_TRUE(done >= 0 && done <= 1);
    stages.emplace_back(stage);
  };
  const Merged m = merged(base, parts, options);
  EXPECT_FALSE(stages.empty());
  EXPECT_EQ(stages.size(), m.report.timings.size());
  const auto json = nlohmann::json::parse(to_json(m.report));
  const std::uint64_t before = base.n_elements() + parts[0].n_elements();
  EXPECT_EQ(json["zone"]["faces_removed"].get<std::uint64_t>() + json["untouched"]["elements"].get<std::uint64_t>(),
            before);
  EXPECT_EQ(json["quality"]["faces"], json["zone"]["faces_created"]);
  EXPECT_EQ(json["inputs"].size(), 2u);
  EXPECT_EQ(json["labels"].size(), m.labels.shifted_nodes[1].size() + m.labels.shifted_elements[1].size());
}

}  // namespace
}  // namespace meshgraft
