// Incisions: laws that every cut keeps, and the scenes an analyst meets.
#include "meshgraft/cut.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "meshgraft/check.hpp"
#include "meshgraft/merge.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

constexpr double kSize = 0.1;

Model plate(double jitter = 0.15) { return scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, kSize, "PLATE", jitter); }

/// A rib that stands on a wall, sharing its nodes along y = 0.5.
Model rib_on_wall() {
  const std::vector<Model> models{scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, kSize, "WALL"),
                                  scenes::plate({0, 0.5, 0}, {2, 0, 0}, {0, 0, 0.6}, kSize, "RIB")};
  return scenes::welded(scenes::together(models));
}

CutOptions dropping(Drop::What what, const std::string& group = {}) {
  CutOptions options;
  options.drop = {what, group};
  return options;
}
const CutOptions kDropInside = dropping(Drop::What::kInside), kDropOutside = dropping(Drop::What::kOutside);

double area(const Model& m) { return check(m).area; }

double dropped_area(const Merged& m) {
  double sum = 0;
  for (const DroppedEntry& d : m.report.dropped) sum += d.area;
  return sum;
}

Merged made(const Model& base, const CutTool& tool, const CutOptions& options) {
  Result<Merged> result = cut(base, tool, options);
  if (!result) throw std::runtime_error(to_string(result.error()));
  for (const Error& e : result->report.broken_promises) ADD_FAILURE() << to_string(e);
  return std::move(*result);
}

/// What every cut keeps.
Model expect_laws(const Model& base, const Merged& m) {
  const Model result = apply(base, {}, m);
  EXPECT_TRUE(check(result).sound());
  EXPECT_EQ(check(result).n_orphan_nodes, 0u);
  std::set<std::int64_t> kept_nodes;
  for (std::size_t n = 0; n < result.n_nodes(); ++n) kept_nodes.insert(result.node_label[n]);
  EXPECT_EQ(kept_nodes.size(), result.n_nodes());
  for (std::size_t n = 0; n < base.n_nodes(); ++n) {
    const bool removed = std::ranges::binary_search(m.graft.removed_nodes[0], NodeId(n));
    EXPECT_EQ(removed, !kept_nodes.contains(base.node_label[n]));
  }
  for (const NewElement& e : m.graft.new_elements) EXPECT_EQ(e.parent.input, 0u);
  EXPECT_EQ(result.groups.size(), base.groups.size());
  return result;
}

ErrorCode code_of(const Model& base, const CutTool& tool, const CutOptions& options) {
  const auto result = cut(base, tool, options);
  return result ? ErrorCode::kCannotHold : result.error().code;
}

TEST(Cut, APlaneThroughAPlate) {
  const Model base = plate();
  const Merged m = made(base, PlaneTool{{1.234, 0, 0}, {1, 0, 0}}, kDropOutside);
  const Model result = expect_laws(base, m);
  EXPECT_NEAR(area(result), 1.234, 1e-9);
  EXPECT_NEAR(dropped_area(m), 0.766, 1e-9);
  for (const Vec3 p : result.position) EXPECT_LE(p.x, 1.234 + 1e-12);
  ASSERT_EQ(m.report.junction.size(), 1u);
  EXPECT_NEAR(m.report.junction[0].length, 1, 1e-9);
  EXPECT_EQ(m.report.junction[0].kind, "cut");
  EXPECT_GE(m.report.quality.min, 0.5);
  EXPECT_GE(m.report.quality.mean, 0.85);
}

TEST(Cut, TheOtherSideOfAPlane) {
  const Model base = plate();
  const Model result = expect_laws(base, made(base, PlaneTool{{1.234, 0, 0}, {1, 0, 0}}, kDropInside));
  EXPECT_NEAR(area(result), 0.766, 1e-9);
}

TEST(Cut, APlaneBesideARowOfNodesLeavesNoSlivers) {
  const Model base = plate(0);
  for (const double beside : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7}) {
    const Merged m = made(base, PlaneTool{{1 + beside, 0, 0}, {1, 0, 0}}, kDropOutside);
    expect_laws(base, m);
    EXPECT_GE(m.report.quality.min, 0.5) << beside;
  }
}

TEST(Cut, APlaneThroughNodesLeavesThemAsTheyAre) {
  const Model base = plate(0);
  const Merged m = made(base, PlaneTool{{1, 0, 0}, {1, 0, 0}}, kDropOutside);
  const Model result = expect_laws(base, m);
  EXPECT_NEAR(area(result), 1, 1e-12);
  EXPECT_TRUE(m.graft.new_nodes.empty());
}

TEST(Cut, AnObliquePlaneThroughACylinder) {
  const Model base = scenes::cylinder({0, 0, 0}, {0, 0, 2}, 0.5, kSize);
  const Vec3 n = normalized({0.4, 0.3, 1});
  const Merged m = made(base, PlaneTool{{0, 0, 1.1}, n}, kDropOutside);
  const Model result = expect_laws(base, m);
  EXPECT_NEAR(area(result) + dropped_area(m), area(base), 1e-3 * area(base));
  ASSERT_EQ(m.report.junction.size(), 1u);
  EXPECT_TRUE(m.report.junction[0].closed);
  for (const NewNode& node : m.graft.new_nodes) EXPECT_LE(dot(n, node.position - Vec3{0, 0, 1.1}), 1e-12);
}

/// A shelf at z = 0.4 whose front slopes down through z = 0 at y = 0.2, with a dent that reaches `deep` below that.
Model dented(double deep) {
  scenes::Surface s;
  s.nu = 30, s.nv = 20;
  s.at = [&](double u, double v) {
    const double x = 2 * u, from_dent = std::hypot(x - 1, v - 0.7) / 0.3;
    return Vec3{x, v, std::min(0.4, 4 * (v - 0.2)) - (0.4 + deep) * std::max(0.0, 1 - from_dent * from_dent)};
  };
  return scenes::surface(s);
}

TEST(Cut, ASpotThatTheToolOnlyGrazesStaysWithWhatIsAround) {
  const Model base = dented(0.004);
  const PlaneTool tool{{0, 0, 0}, {0, 0, 1}};
  double sum = 0;
  for (const CutOptions& options : {kDropInside, kDropOutside}) {
    const Merged m = made(base, tool, options);
    sum += area(expect_laws(base, m));
    ASSERT_EQ(m.report.junction.size(), 1u);
    EXPECT_NEAR(m.report.junction[0].length, 2, 1e-9);
    const auto told = std::ranges::find(m.report.warnings, "tool-grazes", &Warning::name);
    ASSERT_NE(told, m.report.warnings.end());
    EXPECT_NE(told->what.find("deep"), std::string::npos) << told->what;
  }
  EXPECT_NEAR(sum, area(base), 1e-3 * area(base));
}

TEST(Cut, ASpotThatHoldsFacesIsCutOut) {
  const Merged m = made(dented(0.05), PlaneTool{{0, 0, 0}, {0, 0, 1}}, kDropInside);
  EXPECT_EQ(m.report.junction.size(), 2u);
  EXPECT_EQ(std::ranges::count(m.report.warnings, "tool-grazes", &Warning::name), 0);
}

TEST(Cut, APlaneNearlyParallelToTheBase) {
  const Model base = plate();
  for (const double angle : {0.12, 0.05, 0.02}) {
    const PlaneTool tool{{0.9, 0, 0}, {std::sin(angle), 0, std::cos(angle)}};
    const Model result = expect_laws(base, made(base, tool, kDropOutside));
    EXPECT_NEAR(area(result), 0.9, 1e-9) << angle;
  }
}

TEST(Cut, ABoxTakesTheCornerOfAPlate) {
  const Model base = plate();
  const Merged m = made(base, BoxTool{{1.51, 0.63, -1}, {3, 2, 1}}, kDropInside);
  EXPECT_NEAR(area(expect_laws(base, m)), 2 - 0.49 * 0.37, 1e-9);
}

TEST(Cut, ABoxCutsAHoleWithSharpCorners) {
  const Model base = plate();
  const Merged m = made(base, BoxTool{{0.73, 0.31, -0.2}, {1.21, 0.66, 0.2}}, kDropInside);
  EXPECT_NEAR(area(expect_laws(base, m)), 2 - 0.48 * 0.35, 1e-9);
  ASSERT_EQ(m.report.junction.size(), 1u);
  EXPECT_TRUE(m.report.junction[0].closed);
  EXPECT_EQ(m.report.junction[0].corners, 4u);
}

TEST(Cut, ACylinderCutsAHoleWhoseNodesAreOnTheTrueCylinder) {
  const Model base = plate();
  const CylinderTool tool{{1.02, 0.48, 0}, {0, 0, 2}, 0.234};
  const Merged m = made(base, tool, kDropInside);
  const Model result = expect_laws(base, m);
  EXPECT_NEAR(area(result), 2 - std::numbers::pi * 0.234 * 0.234, 0.01);
  double least = 1;
  std::size_t on_round = 0;
  for (const Vec3 p : result.position) {
    const double r = std::hypot(p.x - 1.02, p.y - 0.48);
    least = std::min(least, r);
    if (std::abs(r - 0.234) < 1e-12) ++on_round;
    EXPECT_NEAR(p.z, 0, 1e-15);
  }
  EXPECT_NEAR(least, 0.234, 1e-12);
  ASSERT_EQ(m.report.junction.size(), 1u);
  EXPECT_EQ(on_round, m.report.junction[0].nodes);
}

TEST(Cut, ASmallHoleInACoarsePlate) {
  const Model base = plate();
  const Merged m = made(base, CylinderTool{{1.02, 0.48, 0}, {0, 0, 1}, 0.03}, kDropInside);
  EXPECT_NEAR(area(expect_laws(base, m)), 2 - std::numbers::pi * 0.03 * 0.03, 1e-3);
}

TEST(Cut, TheDiscThatACylinderLeaves) {
  const Model base = plate();
  const Merged m = made(base, CylinderTool{{1.02, 0.48, 0}, {0, 0, 1}, 0.234}, kDropOutside);
  EXPECT_NEAR(area(expect_laws(base, m)), std::numbers::pi * 0.234 * 0.234, 0.01);
}

TEST(Cut, ACylinderThroughAPipeLeavesNodesOnBoth) {
  const Model base = scenes::cylinder({0, 0, 0}, {0, 0, 2}, 0.5, kSize);
  const CylinderTool tool{{0, 0, 1.03}, {1, 0, 0}, 0.21};
  const Merged m = made(base, tool, kDropInside);
  const Model result = expect_laws(base, m);
  EXPECT_EQ(m.report.junction.size(), 2u);
  EXPECT_LT(m.report.fidelity->max_distance_relative, 0.1);
  std::size_t on_round = 0;
  for (const Vec3 p : result.position) {
    const double r = std::hypot(p.y, p.z - 1.03);
    EXPECT_GE(r, 0.21 - 1e-9);
    if (std::abs(r - 0.21) < 1e-9) ++on_round;
  }
  EXPECT_EQ(on_round, m.report.junction[0].nodes + m.report.junction[1].nodes);
}

TEST(Cut, AHoleThroughARibOnAWallLeavesTheWall) {
  const Model base = rib_on_wall();
  const Merged m = made(base, CylinderTool{{1.03, 0, 0.31}, {0, 1, 0}, 0.13}, kDropInside);
  const Model result = expect_laws(base, m);
  EXPECT_NEAR(area(result), 2 + 1.2 - std::numbers::pi * 0.13 * 0.13, 3e-3);
  const auto wall = std::ranges::find(m.report.groups, "WALL", &GroupEntry::name);
  EXPECT_EQ(wall->members_before, wall->members_after);
  EXPECT_EQ(wall->area_before, wall->area_after);
}

TEST(Cut, ANotchInTheFootOfARibCrossesTheTLine) {
  const Model base = rib_on_wall();
  const Merged m = made(base, BoxTool{{0.83, 0.2, -0.3}, {1.24, 0.8, 0.21}}, kDropInside);
  EXPECT_NEAR(area(expect_laws(base, m)), 3.2 - 0.41 * 0.6 - 0.41 * 0.21, 1e-9);
}

TEST(Cut, APlaneAcrossATLine) {
  const Model base = rib_on_wall();
  const Merged m = made(base, PlaneTool{{1.13, 0, 0}, {1, 0.2, 0.1}}, kDropOutside);
  const Model result = expect_laws(base, m);
  EXPECT_NEAR(area(result) + dropped_area(m), 3.2, 1e-9);
  EXPECT_EQ(check(result).non_manifold_edges > 0, true);
}

TEST(Cut, APlaneAlongATLine) {
  const Model base = rib_on_wall();
  const Merged m = made(base, PlaneTool{{0, 0.5, 0}, {0, 1, 1}}, kDropOutside);
  EXPECT_NEAR(area(expect_laws(base, m)), 1, 1e-12);
  EXPECT_TRUE(m.graft.new_nodes.empty());
  EXPECT_EQ(code_of(base, PlaneTool{{0, 0.5, 0}, {0, 1, 0}}, kDropOutside), ErrorCode::kOverlap);
}

/// Both sides of planes across a base whose meshes cross or touch without being joined: together they are the base,
/// and nothing meets that did not meet before.
void expect_cuts_of_unjoined(const Model& base, const std::vector<double>& places) {
  for (const double x : places) {
    double sum = 0;
    for (const CutOptions& options : {kDropInside, kDropOutside}) {
      const Merged m = made(base, PlaneTool{{x, 0, 0}, {1, 0, 0}}, options);
      const Model result = apply(base, {}, m);
      const CheckResult found = check(result);
      EXPECT_EQ(found.n_degenerate_faces + found.n_duplicate_faces + found.n_orphan_nodes, 0u) << x;
      EXPECT_EQ(found.non_manifold_edges, 0u) << x;
      EXPECT_GE(found.min_q, std::min(0.5, check(base).min_q)) << x;
      EXPECT_NEAR(area(result) + dropped_area(m), area(base), 1e-9) << x;
      const bool inside = options.drop.what == Drop::What::kInside;
      for (std::size_t n = 0; n < result.n_nodes(); ++n)
        EXPECT_GE((inside ? 1 : -1) * (result.position[n].x - x), -0.11 * kSize) << x;
      sum += area(result);
    }
    EXPECT_NEAR(sum, area(base), 1e-9) << x;
  }
}

TEST(Cut, MeshesThatCrossWithoutBeingJoinedAreCutEachByItself) {
  const std::vector<Model> plates{scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, kSize, "DECK", 0.15),
                                  scenes::plate({0, 0.47, -0.3}, {2, 0, 0}, {0, 0.1, 0.6}, 0.8 * kSize, "WEB", 0.15)};
  expect_cuts_of_unjoined(scenes::together(plates), {0.53, 0.61, 0.77, 1.02, 1.05});
}

TEST(Cut, MeshesThatLieOnEachOtherWithoutBeingJoinedAreCutEachByItself) {
  const std::vector<Model> plates{scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, kSize, "LOWER", 0.15),
                                  scenes::plate({0, 0.2, 0}, {2, 0, 0}, {0, 0.6, 0}, 0.7 * kSize, "UPPER", 0.15)};
  expect_cuts_of_unjoined(scenes::together(plates), {0.53, 0.61, 0.77, 1.02, 1.05});
}

/// A sheet that crosses itself, along x = z = 0; of two groups that share the nodes of one line.
Model loop() {
  const auto half = [](double from, double to, const std::string& group) {
    scenes::Surface s;
    s.at = [=](double u, double v) {
      const double t = from + u * (to - from);
      return Vec3{t * t - 1, v, t * (t * t - 1)};
    };
    s.nu = 22, s.nv = 11, s.group = group;
    return scenes::surface(s);
  };
  const std::vector<Model> halves{half(-1.4, 0, "LEFT"), half(0, 1.5, "RIGHT")};
  return scenes::welded(scenes::together(halves));
}

TEST(Cut, AMeshThatCrossesItselfIsRefusedWithWhatToDoFirst) {
  const PlaneTool tool{{0, 0.53, 0}, {0, 1, 0}};
  const Model base = loop();
  const auto refused = cut(base, tool, kDropOutside);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kJunctionNotResolved);
  EXPECT_NE(refused.error().hint.find("meshgraft merge BASE --join"), std::string::npos) << refused.error().hint;

  MergeOptions options;
  options.joins = {{"LEFT", "RIGHT"}};
  const auto joined = merge(base, {}, options);
  ASSERT_TRUE(joined) << to_string(joined.error());
  const Model model = apply(base, {}, *joined);
  const Merged m = made(model, tool, kDropOutside);
  EXPECT_NEAR(area(expect_laws(model, m)) + dropped_area(m), area(model), 1e-3 * area(model));
}

TEST(Cut, AToolMadeFromNumbersIsNamedWithoutAnElement) {
  const auto m = cut(plate(), PlaneTool{{0, 0, 0}, {0, 0, 1}}, kDropOutside);
  ASSERT_FALSE(m);
  EXPECT_NE(m.error().what.find("plane 0,0,0,0,0,1"), std::string::npos) << to_string(m.error());
  EXPECT_EQ(m.error().what.find("of plane"), std::string::npos) << to_string(m.error());
}

TEST(Cut, AGroupChoosesThePieceAndNothingElseIsCut) {
  // A plane through two plates; only the end of one of them shall go.
  const std::vector<Model> models{scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, kSize, "ONE", 0.15),
                                  scenes::plate({0, 0, 1}, {2, 0, 0}, {0, 1, 0}, kSize, "TWO", 0.15)};
  Model base = scenes::together(models);
  const Merged both = made(base, PlaneTool{{1.23, 0, 0}, {1, 0, 0}}, kDropOutside);
  EXPECT_NEAR(area(expect_laws(base, both)), 2.46, 1e-9);

  ModelBuilder builder;
  std::vector<NodeId> nodes;
  for (const Vec3 p : base.position) nodes.push_back(builder.add_node(p));
  for (std::size_t e = 0; e < base.n_elements(); ++e) {
    const auto v = base.nodes_of(ElementId(e));
    const ElementId f = builder.add_face(nodes[v[0].value], nodes[v[1].value], nodes[v[2].value]);
    const Vec3 p = base.position[v[0].value];
    builder.add_to_group(p.z > 0.5 ? "TWO" : "ONE", f);
    if (p.z < 0.5 && p.x > 1.7) builder.add_to_group("TIP", f);
  }
  base = builder.build();
  const Merged m = made(base, PlaneTool{{1.23, 0, 0}, {1, 0, 0}}, dropping(Drop::What::kGroup, "TIP"));
  EXPECT_NEAR(area(expect_laws(base, m)), 3.23, 1e-9);
  const auto two = std::ranges::find(m.report.groups, "TWO", &GroupEntry::name);
  EXPECT_EQ(two->rule, "untouched");
  const auto tip = std::ranges::find(m.report.groups, "TIP", &GroupEntry::name);
  EXPECT_EQ(tip->members_after, 0u);
  EXPECT_TRUE(std::ranges::count(m.report.warnings, "emptied-group", &Warning::name) == 1);

  EXPECT_EQ(code_of(base, PlaneTool{{1.23, 0, 0}, {1, 0, 0}}, dropping(Drop::What::kGroup, "ONE")), ErrorCode::kUsage);
  EXPECT_EQ(code_of(base, PlaneTool{{1.23, 0, 0}, {1, 0, 0}}, dropping(Drop::What::kGroup, "NONE")), ErrorCode::kUsage);
  // The tool touches the base at its border only: nothing would be left.
  EXPECT_EQ(code_of(plate(0), BoxTool{{0, 0, -1}, {2, 1, 1}}, dropping(Drop::What::kGroup, "PLATE")),
            ErrorCode::kPartsApart);
}

TEST(Cut, AToolThatMissesIsPartsApart) {
  const Model base = plate();
  EXPECT_EQ(code_of(base, BoxTool{{5, 5, 5}, {6, 6, 6}}, kDropInside), ErrorCode::kPartsApart);
  EXPECT_EQ(code_of(base, BoxTool{{-5, -5, -5}, {6, 6, 6}}, kDropInside), ErrorCode::kPartsApart);
  EXPECT_EQ(code_of(base, PlaneTool{{0, 0, 3}, {0, 0, 1}}, kDropOutside), ErrorCode::kPartsApart);
}

TEST(Cut, AToolOfQuadrilateralsCutsLikeItsTrianglesAndIsNamedByItsLabels) {
  ModelBuilder b;
  std::vector<NodeId> corner;
  for (int k = 0; k < 8; ++k)
    corner.push_back(b.add_node({k % 2 == 0 ? 0.73 : 1.21, (k / 2) % 2 == 0 ? 0.31 : 0.66, k < 4 ? -0.2 : 0.2}));
  ElementAttributes quad;
  quad.shape = Shape::kQuad;
  for (std::int64_t label = 501;
       const auto& q : std::array<std::array<std::size_t, 4>, 6>{
           {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}})
    b.add_element(quad, std::array{corner[q[0]], corner[q[1]], corner[q[2]], corner[q[3]]}, label++);
  Model tool = b.build("tool.unv");
  const CutTool cutting(&std::as_const(tool));
  const Model base = plate();
  const Merged m = made(base, cutting, kDropInside);
  expect_laws(base, m);
  ASSERT_EQ(m.report.dropped.size(), 1u);
  EXPECT_NEAR(m.report.dropped[0].area, 0.48 * 0.35, 1e-9);
  tool.position[0].z = tool.position[1].z = tool.position[2].z = tool.position[3].z = 0;
  const auto refused = cut(base, cutting, kDropInside);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().what.find("element 501 of tool.unv"), std::string::npos) << refused.error().what;
}

TEST(Cut, SenselessToolsAreRefused) {
  const Model base = plate();
  EXPECT_EQ(code_of(base, BoxTool{{1, 1, 1}, {0, 2, 2}}, kDropInside), ErrorCode::kUsage);
  EXPECT_EQ(code_of(base, PlaneTool{{1, 1, 1}, {0, 0, 0}}, kDropInside), ErrorCode::kUsage);
  EXPECT_EQ(code_of(base, CylinderTool{{1, 1, 1}, {0, 0, 1}, 0}, kDropInside), ErrorCode::kUsage);
  EXPECT_EQ(code_of(base, CylinderTool{{1, NAN, 1}, {0, 0, 1}, 1}, kDropInside), ErrorCode::kUsage);
  EXPECT_EQ(code_of(base, BoxTool{{0.5, 0.2, 0}, {1, 0.7, 1}}, kDropInside), ErrorCode::kOverlap);
}

TEST(Cut, AMeshCutsAsTheBoxItDescribes) {
  const Model base = plate();
  const Model sphere = scenes::sphere({1.01, 0.52, 0.05}, 0.3, 12);
  const Merged m = made(base, &sphere, kDropInside);
  const Model result = expect_laws(base, m);
  EXPECT_NEAR(area(result), 2 - std::numbers::pi * (0.09 - 0.0025), 0.01);
  EXPECT_EQ(result.groups.size(), 1u);  // no trace of the tool
}

TEST(Cut, AnOpenMeshCutsByTheSidesOfItsOrientation) {
  const Model base = plate();
  const Model sheet = scenes::plate({1.13, -0.5, -0.5}, {0.1, 2, 0}, {0, 0, 1}, 0.13, "TOOL");
  const Model result = expect_laws(base, made(base, &sheet, kDropOutside));
  const Model other = expect_laws(base, made(base, &sheet, kDropInside));
  EXPECT_NEAR(area(result) + area(other), 2, 1e-9);
  // Its normal u x v = (0.1, 2, 0) x (0, 0, 1) points to +x.
  EXPECT_NEAR(area(result), 1.13 + 0.05, 1e-9);
}

TEST(Cut, AnOpenMeshThatEndsInsideTheBaseIsRefusedWithThePlace) {
  const Model base = plate();
  const Model sheet = scenes::plate({1.13, -0.5, -0.5}, {0, 1.1, 0}, {0, 0, 1}, 0.13, "TOOL");
  const auto result = cut(base, &sheet, kDropOutside);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kNotSeparated);
  EXPECT_NE(result.error().what.find("(1.13, 0.6, 0)"), std::string::npos) << result.error().what;
}

TEST(Cut, BeamsAndNodesGoWithTheirFaces) {
  Model faces = plate(0);
  ModelBuilder builder;
  std::vector<NodeId> nodes;
  for (const Vec3 p : faces.position) nodes.push_back(builder.add_node(p));
  for (std::size_t e = 0; e < faces.n_elements(); ++e) {
    const auto v = faces.nodes_of(ElementId(e));
    builder.add_to_group("PLATE", builder.add_face(nodes[v[0].value], nodes[v[1].value], nodes[v[2].value]));
  }
  // Beams along y = 0.5, masses at both ends, a spring to the ground.
  std::vector<std::pair<double, NodeId>> line;
  for (std::size_t n = 0; n < nodes.size(); ++n)
    if (std::abs(faces.position[n].y - 0.5) < 1e-9) line.emplace_back(faces.position[n].x, nodes[n]);
  std::ranges::sort(line);
  for (std::size_t k = 1; k < line.size(); ++k)
    builder.add_to_group("BEAM", builder.add_line(line[k - 1].second, line[k].second));
  const ElementAttributes mass{Shape::kPoint, 161}, spring{Shape::kOther, 136};
  const std::array left{line.front().second}, right{line.back().second};
  builder.add_to_group("MASS", builder.add_element(mass, left));
  builder.add_to_group("MASS", builder.add_element(mass, right));
  const std::array span{line.front().second, line.back().second};
  const ElementId spanning = builder.add_element(spring, span);
  const Model base = builder.build();
  (void)spanning;

  const Merged m = made(base, PlaneTool{{1.234, 0, 0}, {1, 0, 0}}, kDropOutside);
  const Model result = apply(base, {}, m);
  const auto beam = std::ranges::find(m.report.groups, "BEAM", &GroupEntry::name);
  EXPECT_NEAR(beam->length_before, 2, 1e-12);
  EXPECT_NEAR(beam->length_after, 1.234, 1e-9);
  EXPECT_EQ(std::ranges::count(m.report.warnings, "spanning-element", &Warning::name), 1);
  // The spring from end to end stays, and so does its node without faces, and what else is on it.
  std::size_t beyond = 0;
  for (const Vec3 p : result.position) beyond += p.x > 1.3 ? 1 : 0;
  EXPECT_EQ(beyond, 1u);
}

TEST(Cut, ALooseBeamThatTheToolCrossesIsRefused) {
  const Model faces = plate(0);
  ModelBuilder builder;
  std::vector<NodeId> nodes;
  for (const Vec3 p : faces.position) nodes.push_back(builder.add_node(p));
  for (std::size_t e = 0; e < faces.n_elements(); ++e) {
    const auto v = faces.nodes_of(ElementId(e));
    builder.add_to_group("PLATE", builder.add_face(nodes[v[0].value], nodes[v[1].value], nodes[v[2].value]));
  }
  // A beam that stands alone, and a frame over the plate.
  const NodeId far = builder.add_node({1.5, 0.5, 3});
  const ElementId alone = builder.add_line(far, builder.add_node({1.7, 0.5, 3}));
  ModelBuilder with_frame = builder;
  const NodeId top = with_frame.add_node({1, 0.5, 1});
  const ElementId left = with_frame.add_line(nodes.front(), top);
  with_frame.add_line(top, nodes.back());
  const Model base = with_frame.build();
  const auto crossing = cut(base, PlaneTool{{0.7, 0, 0}, {1, 0, 0}}, kDropOutside);
  ASSERT_FALSE(crossing);
  EXPECT_EQ(crossing.error().code, ErrorCode::kUnsupportedElement);
  const std::string name = "element " + std::to_string(base.element_label[left.value]);
  EXPECT_NE(crossing.error().what.find(name), std::string::npos) << crossing.error().what;
  // A hole between the feet of the frame that only the air above it touches.
  EXPECT_EQ(code_of(base, BoxTool{{0.4, 0.1, -1}, {0.6, 0.4, 2}}, kDropInside), ErrorCode::kUnsupportedElement);
  // Without the frame, the beam goes with the side it is on.
  const Merged m = made(builder.build(), PlaneTool{{0.7, 0, 0}, {1, 0, 0}}, kDropOutside);
  EXPECT_TRUE(std::ranges::binary_search(m.graft.removed_elements[0], alone));
  EXPECT_TRUE(std::ranges::binary_search(m.graft.removed_nodes[0], far));
}

/// A cut where a feature within the tolerance is near is a little off the tool and straightened, and a corner
/// smaller than a tenth of an edge is cut short: by less than this area.
constexpr double kBent = 0.01 * kSize;

/// Random cuts leave strips too narrow for good triangles; that is said, and no matter of these laws.
bool is_poor_quality(const Error& e) { return e.what.find("Q below") != std::string::npos; }

TEST(Cut, AdviceIsAboutTheTool) {
  CutOptions options = kDropInside;
  options.zone.min_quality = 0.9;
  const auto m = cut(plate(), BoxTool{{0.73, 0.02, -0.2}, {1.21, 0.66, 0.2}}, options);
  ASSERT_TRUE(m) << to_string(m.error());
  ASSERT_FALSE(m->report.broken_promises.empty());
  for (const Error& e : m->report.broken_promises) EXPECT_EQ(e.hint.find("trim"), std::string::npos) << e.hint;
}

TEST(Cut, ACylinderNearlyTangentToAWall) {
  const Model base = rib_on_wall();
  for (double y = 0.085; y < 0.099; y += 0.001) {
    const auto m = cut(base, CylinderTool{{1, y, 0}, normalized({0.145, 0.117, 0.982}), 0.4}, kDropInside);
    ASSERT_TRUE(m) << to_string(m.error());
    for (const Error& e : m->report.broken_promises) EXPECT_TRUE(is_poor_quality(e)) << y << ": " << to_string(e);
    EXPECT_TRUE(check(apply(base, {}, *m)).sound());
  }
}

TEST(Cut, AreaIsKeptOrDropped) {
  EXPECT_TRUE(rc::check("area before = area after + area dropped, for planes", [] {
    const auto number = [](int low, int high) { return 0.01 * *rc::gen::inRange(low, high); };
    const Vec3 point{number(50, 150), number(20, 80), 0};
    const Vec3 normal{number(-100, 101), number(-100, 101), number(-60, 61)};
    RC_PRE(std::hypot(normal.x, normal.y) > 0.3);
    const Model base = *rc::gen::arbitrary<bool>() ? rib_on_wall() : plate();
    const auto m = cut(base, PlaneTool{point, normal}, kDropOutside);
    if (!m) RC_FAIL(to_string(m.error()));
    for (const Error& e : m->report.broken_promises)
      if (!is_poor_quality(e)) RC_FAIL(to_string(e));
    const Model result = apply(base, {}, *m);
    RC_ASSERT(check(result).sound());
    RC_ASSERT(std::abs(area(result) + dropped_area(*m) - area(base)) < kBent);
    for (const NewNode& n : m->graft.new_nodes) RC_ASSERT(dot(normalized(normal), n.position - point) < 0.01 * kSize);
  }));
}

TEST(Cut, TheTwoSidesOfACutAreAllThereWas) {
  EXPECT_TRUE(rc::check("inside + outside = all, for holes", [] {
    const auto number = [](int low, int high) { return 0.01 * *rc::gen::inRange(low, high); };
    const CylinderTool tool{{number(0, 200), number(0, 100), 0}, {number(-30, 31), number(-30, 31), 1}, number(8, 40)};
    RC_LOG() << tool.point.x << ' ' << tool.point.y << " axis " << tool.axis.x << ' ' << tool.axis.y << " r "
             << tool.radius << '\n';
    const Model base = plate();
    for (const CutOptions& options : {kDropInside, kDropOutside}) {
      const auto m = cut(base, tool, options);
      if (!m) RC_FAIL(to_string(m.error()));
      for (const Error& e : m->report.broken_promises)
        if (!is_poor_quality(e)) RC_FAIL(to_string(e));
      const Model result = apply(base, {}, *m);
      RC_ASSERT(check(result).sound());
      RC_ASSERT(std::abs(area(result) + dropped_area(*m) - 2) < 0.02);
    }
  }));
}

}  // namespace
}  // namespace meshgraft
