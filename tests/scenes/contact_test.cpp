// Meshes that lie on each other: every scene, fused and projected, keeps the promises.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "meshgraft/merge.hpp"
#include "scenes/expect.hpp"
#include "support/catalogue.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

const std::vector<scenes::Merge>& all_scenes() {
  static const std::vector<scenes::Merge> all = scenes::contact_catalogue();
  return all;
}

double whole_area(const Model& model) {
  double sum = 0;
  for (std::size_t e = 0; e < model.n_elements(); ++e)
    if (model.is_face(ElementId(e))) sum += scenes::area_of(model, ElementId(e));
  return sum;
}

class Contact : public testing::TestWithParam<std::size_t> {
 protected:
  void merge_with(Overlap overlap) {
    const scenes::Merge& scene = all_scenes()[GetParam()];
    MergeOptions options = scene.options;
    options.overlap = overlap;
    auto merged = merge(scene.base, scene.parts, options);
    ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
    merged_ = std::move(*merged);
    EXPECT_TRUE(merged_.report.broken_promises.empty()) << scenes::first_problem(merged_.report);
    EXPECT_FALSE(merged_.report.junction.empty());
    EXPECT_GE(merged_.report.quality.min, scene.min_q);
    EXPECT_EQ(std::ranges::count(merged_.report.warnings, "fine-zone", &Warning::name), 0);
    result_ = apply(scene.base, scene.parts, merged_);
    before_ = scenes::area_by_group(scene.base);
    area_before_ = whole_area(scene.base);
    for (const Model& part : scene.parts) {
      for (const auto& [name, area] : scenes::area_by_group(part)) before_[name] += area;
      area_before_ += whole_area(part);
    }
  }

  Merged merged_;
  Model result_;
  std::map<std::string, double> before_;
  double area_before_ = 0;
};

TEST_P(Contact, FusedFacesAreInTheGroupsOfBoth) {
  ASSERT_NO_FATAL_FAILURE(merge_with(Overlap::kFuse));
  scenes::expect_sound(result_);
  // One group of both inputs counts the common area once.
  const auto after = scenes::area_by_group(result_);
  for (const auto& [name, area] : before_)
    if (before_.size() > 1) {
      EXPECT_NEAR(after.at(name), area, 0.015 * area) << name;
    }
}

TEST_P(Contact, ProjectedLayersAreOnTheSameNodesAndKeepAllTheirArea) {
  ASSERT_NO_FATAL_FAILURE(merge_with(Overlap::kProject));
  EXPECT_NEAR(whole_area(result_), area_before_, 0.01 * area_before_);
  const auto after = scenes::area_by_group(result_);
  for (const auto& [name, area] : before_) EXPECT_NEAR(after.at(name), area, 0.015 * area) << name;
  std::map<std::set<std::uint32_t>, std::size_t> on_nodes;
  for (std::size_t e = 0; e < result_.n_elements(); ++e) {
    std::set<std::uint32_t> nodes;
    for (const NodeId n : result_.nodes_of(ElementId(e))) nodes.insert(n.value);
    EXPECT_LE(++on_nodes[nodes], 1 + all_scenes()[GetParam()].parts.size());
  }
}

using Corners = std::array<std::array<double, 3>, 3>;

/// Bit for bit, in any order of the corners.
Corners corners_of(const Model& model, ElementId e) {
  Corners corners{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 p = model.corners(e)[k];
    corners[k] = {p.x, p.y, p.z};
  }
  std::ranges::sort(corners);
  return corners;
}

/// Places of the faces of a model that are not in another.
std::vector<Vec3> lost_faces(const Model& model, const Model& result) {
  std::set<Corners> left;
  for (std::size_t e = 0; e < result.n_elements(); ++e) left.insert(corners_of(result, ElementId(e)));
  std::vector<Vec3> lost;
  for (std::size_t e = 0; e < model.n_elements(); ++e) {
    const auto t = model.corners(ElementId(e));
    if (!left.contains(corners_of(model, ElementId(e)))) lost.push_back((t[0] + t[1] + t[2]) / 3);
  }
  return lost;
}

const scenes::Merge& scene_named(const std::string& name) {
  return *std::ranges::find(all_scenes(), name, &scenes::Merge::name);
}

Result<Merged> merged_keeping(const scenes::Merge& scene, Overlap overlap) {
  MergeOptions options = scene.options;
  options.overlap = overlap;
  return merge(scene.base, scene.parts, options);
}

TEST(KeptContact, APartThatLiesOnTheBaseAsAWholeStaysBitForBit) {
  for (const char* name : {"doubler", "doubler_turned", "saddle_pad"}) {
    const scenes::Merge& scene = scene_named(name);
    const auto merged = merged_keeping(scene, Overlap::kKeepPart);
    ASSERT_TRUE(merged.has_value()) << name << ' ' << to_string(merged.error());
    EXPECT_TRUE(merged->report.broken_promises.empty()) << name << ' ' << scenes::first_problem(merged->report);
    const Model result = apply(scene.base, scene.parts, *merged);
    EXPECT_TRUE(meshgraft::check(result).sound()) << name;
    EXPECT_TRUE(lost_faces(scene.parts[0], result).empty()) << name;
  }
}

/// Where the free edges of both cross, the kept mesh needs a node: at (2, 0.27) and (2, 1.37).
TEST(KeptContact, TheKeptBaseChangesOnlyWhereBordersCross) {
  const scenes::Merge& scene = scene_named("partial_overlap_1_1");
  const auto merged = merged_keeping(scene, Overlap::kKeepBase);
  ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
  EXPECT_TRUE(merged->report.broken_promises.empty()) << scenes::first_problem(merged->report);
  const Model result = apply(scene.base, scene.parts, *merged);
  EXPECT_TRUE(meshgraft::check(result).sound());
  for (const Vec3 p : lost_faces(scene.base, result))
    EXPECT_LT(std::min(norm(p - Vec3{2, 0.27, 0}), norm(p - Vec3{2, 1.37, 0})), 0.5);
}

/// Where nothing is left of the other mesh at a node of its border, the kept mesh needs none there.
TEST(KeptContact, AMeshOnWhichTheOtherEndsOnItsNodesStaysBitForBit) {
  const scenes::Merge& scene = scene_named("identical_meshes");
  for (const Overlap overlap : {Overlap::kKeepBase, Overlap::kKeepPart}) {
    const auto merged = merged_keeping(scene, overlap);
    ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
    EXPECT_TRUE(merged->report.broken_promises.empty()) << scenes::first_problem(merged->report);
    const Model result = apply(scene.base, scene.parts, *merged);
    EXPECT_TRUE(lost_faces(overlap == Overlap::kKeepBase ? scene.base : scene.parts[0], result).empty());
  }
}

/// The corner of the first part is no feature any more where that is one mesh with the base, but its groups end there.
TEST(KeptContact, ACornerOfOnePartOnAnEdgeOfTheNextStays) {
  const Model base = scenes::staggered_plate({0, 0, 0}, {8, 0, 0}, {0, 12, 0}, 1, "BASE");
  const std::vector<Model> parts{scenes::staggered_plate({4, 10, 0}, {0, -6, 0}, {3, 0, 0}, 1, "SECOND"),
                                 scenes::staggered_plate({1, 0, 0}, {3, 0, 0}, {0, 6, 0}, 1, "FIRST")};
  MergeOptions options;
  options.overlap = Overlap::kKeepPart;
  const auto merged = merge(base, parts, options);
  ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
  EXPECT_TRUE(merged->report.broken_promises.empty()) << scenes::first_problem(merged->report);
  const auto after = scenes::area_by_group(apply(base, parts, *merged));
  EXPECT_NEAR(after.at("BASE"), 96 - 36, 1e-6);
  EXPECT_NEAR(after.at("FIRST"), 18, 1e-6);
  EXPECT_NEAR(after.at("SECOND"), 18, 1e-6);
}

/// Of these the mesh that ends on the other was too narrow a zone, or got edges where the gap had bent it.
TEST(KeptContact, WhatEndsOnTheKeptMeshIsOfTheQualityAskedFor) {
  const auto expect_good = [](const char* name, Overlap overlap) {
    const scenes::Merge& scene = scene_named(name);
    const auto merged = merged_keeping(scene, overlap);
    ASSERT_TRUE(merged.has_value()) << name << ' ' << to_string(merged.error());
    EXPECT_TRUE(merged->report.broken_promises.empty()) << name << ' ' << scenes::first_problem(merged->report);
    EXPECT_GE(merged->report.quality.min, scene.min_q) << name;
    EXPECT_GE(merged->report.quality.mean, 0.85) << name;
    EXPECT_TRUE(meshgraft::check(apply(scene.base, scene.parts, *merged)).sound()) << name;
  };
  for (const char* name : {"partial_overlap_1_1", "partial_overlap_1_8", "three_in_partial_overlap"})
    expect_good(name, Overlap::kKeepBase);
  for (const char* name :
       {"doubler_above", "doubler_below", "doubler_at_free_edge", "doubler_in_corner", "partial_overlap_1_8",
        "three_in_partial_overlap", "two_doublers_on_one_place", "doubler_on_doubler", "three_doublers_on_one_place",
        "doubler_on_doubler_apart", "doubler_beyond_doubler_apart", "plate_between_wall_and_doubler",
        "doubler_and_web_through_a_line", "doubler_and_webs_through_a_point", "leaning_doublers",
        "doublers_apart_over_and_under_t_line"})
    expect_good(name, Overlap::kKeepPart);
}

/// The walls beside the common one go on in the same planes: near each other, and yet on each other nowhere.
TEST(KeptContact, OfTwoBoxesOnEachOtherTheCommonWallIsKeptOnce) {
  const auto box = [](double z, const char* group) {
    const auto wall = [&](Vec3 origin, Vec3 u, Vec3 v) {
      return scenes::plate(origin + Vec3{0, 0, z}, u, v, 0.5, group);
    };
    const Vec3 x{1, 0, 0}, y{0, 1, 0}, up{0, 0, 1};
    const std::array walls{wall({}, y, x), wall(up, x, y),  wall({}, x, up),
                           wall(y, up, x), wall({}, up, y), wall(x, y, up)};
    return scenes::welded(scenes::together(walls));
  };
  const Model base = box(0, "LOWER");
  const std::vector<Model> parts{box(1, "UPPER")};
  for (const Overlap overlap : {Overlap::kKeepBase, Overlap::kKeepPart}) {
    MergeOptions options;
    options.overlap = overlap;
    const auto merged = merge(base, parts, options);
    ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
    EXPECT_TRUE(merged->report.broken_promises.empty()) << scenes::first_problem(merged->report);
    EXPECT_NEAR(whole_area(apply(base, parts, *merged)), 11, 1e-9);
    ASSERT_EQ(merged->report.overlaps.size(), 1u);
    const OverlapEntry& entry = merged->report.overlaps[0];
    EXPECT_EQ(entry.rule, "deleted");
    EXPECT_EQ(entry.inputs, (overlap == Overlap::kKeepBase ? std::vector{0u, 1u} : std::vector{1u, 0u}));
    EXPECT_NEAR(entry.area, 1, 1e-9);
  }
}

/// A base, and what lies on it in one direction or the other within the tolerance of 0.04, must merge.
void expect_stack(const Model& base, const std::vector<Model>& parts, Overlap overlap) {
  MergeOptions options;
  options.tolerance = {0.04, false}, options.overlap = overlap;
  const auto merged = merge(base, parts, options);
  ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
  EXPECT_TRUE(merged->report.broken_promises.empty()) << scenes::first_problem(merged->report);
  if (overlap != Overlap::kProject) {
    EXPECT_TRUE(meshgraft::check(apply(base, parts, *merged)).sound());
  }
}

/// Beside the border of a part at a distance the base is bent, more steeply than faces in contact may be: what lies on
/// it was told by how it lay then, and some of the base stayed under the next part.
TEST(KeptContact, APartMayCoverWhereTheBorderOfAnotherHasBentTheBase) {
  const Model wall = scenes::staggered_plate({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, 0.1, "WALL", 0.15);
  for (const double beyond : {0.04, 0.07, 0.1, 0.13})
    for (const double height : {0.02, 0.035}) {
      SCOPED_TRACE(testing::Message() << beyond << " beyond the border, at " << height);
      const Model first = scenes::staggered_plate({0.53, 0.47, height}, {0.9, 0, 0}, {0, 1.03, 0}, 0.1, "FIRST", 0.15);
      const Model second =
          scenes::staggered_plate({0.53 - beyond, 0.77, height}, {0.5, 0, 0}, {0, 0.43, 0}, 0.1, "SECOND", 0.15);
      expect_stack(wall, {first, second}, Overlap::kKeepPart);
    }
}

/// The mesh of one part has a node on the T-line at each of its edges: several within what slides to the border of the
/// next part that crosses the line.
TEST(KeptContact, NodesOfALineThatCrossesABorderDoNotSlideToOnePlace) {
  const std::array<Model, 3> pieces{scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, 0.2, "WALL"),
                                    scenes::plate({0, 1, 0}, {2, 0, 0}, {0, 1, 0}, 0.2, "WALL"),
                                    scenes::plate({0, 1, 0}, {2, 0, 0}, {0, 0, -0.4}, 0.2, "RIB")};
  const Model wall = scenes::welded(scenes::together(pieces));
  for (const double x : {1.69, 1.7, 1.71, 1.72, 1.73, 1.74}) {
    SCOPED_TRACE(testing::Message() << "border at " << x);
    const Model first = scenes::plate({1.43, 0.24, 0}, {0.85, 0, 0}, {0, 0.95, 0}, 0.1, "FIRST", 0.15);
    const Model second = scenes::plate({x, 0.55, 0.0135}, {0.92, 0, 0}, {0, 0.79, 0}, 0.2, "SECOND", 0.15);
    expect_stack(wall, {first, second}, Overlap::kKeepPart);
  }
}

/// A plate that leans over the edge of another is in reach of that with a node beyond it: where rounding said so, the
/// node came into the place where the edges of the two cross.
TEST(FusedContact, ANodeBeyondTheBorderDoesNotMoveToWhereItsEdgeCrossesThat) {
  const auto turned = [](Vec3 p) {
    const Vec3 q{p.x, std::cos(1.1) * p.y - std::sin(1.1) * p.z, std::sin(1.1) * p.y + std::cos(1.1) * p.z};
    return Vec3{std::cos(0.7) * q.x - std::sin(0.7) * q.y, std::sin(0.7) * q.x + std::cos(0.7) * q.y, q.z};
  };
  const Model wall = scenes::moved(scenes::plate({0, 0, 0}, {1, 0, 0}, {0, 0.6, 0}, 0.05, "WALL"), turned);
  for (const double beyond : {0.0082, 0.0083, 0.0084, 0.0085, 0.0086}) {
    SCOPED_TRACE(testing::Message() << beyond << " beyond the edge");
    const auto leaning = [&](Vec3 p) {
      return turned(p - Vec3{0, 0, 0.0075 + 0.0029 * (p.x - 0.489) + 0.00655 * (p.y + 0.133)});
    };
    const Model part =
        scenes::moved(scenes::plate({0.271, -0.55 - beyond, 0}, {0.4546, 0, 0}, {0, 0.85, 0}, 0.05, "PART"), leaning);
    MergeOptions options;
    options.tolerance = {0.015086, false};
    const auto merged = merge(wall, std::span(&part, 1), options);
    ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
    EXPECT_TRUE(merged->report.broken_promises.empty()) << scenes::first_problem(merged->report);
    EXPECT_GE(merged->report.quality.min, 0.5);
  }
}

/// The corner faces of a doubler are among those of its layer: kept, on their own nodes, beside others that descend
/// from them. These were taken for faces where the doubler never was, and its surface there for gone.
TEST(ProjectedContact, ALayerMayHaveFacesOfTheInputAndOthersBesideThem) {
  const Model wall = scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, 0.2, "WALL");
  for (const double x : {0.91, 1.01, 1.06})
    for (const Vec3 sides : {Vec3{0.58, 0.48, 0}, Vec3{0.64, 0.58, 0}, Vec3{0.6, 0.6, 0}, Vec3{0.56, 0.42, 0}}) {
      SCOPED_TRACE(testing::Message() << "corner at " << x << ", " << sides.x << " by " << sides.y);
      const Model doubler = scenes::plate({x, 0.85, 0}, {sides.x, 0, 0}, {0, sides.y, 0}, 0.2, "DOUBLER", 0.15);
      MergeOptions options;
      options.overlap = Overlap::kProject;
      const auto merged = merge(wall, std::span(&doubler, 1), options);
      ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
      EXPECT_TRUE(merged->report.broken_promises.empty()) << scenes::first_problem(merged->report);
    }
}

/// What is left of the part is a strip of 0.015 along nodes of the base 0.1 apart.
TEST(KeptContact, WhereTheKeptNodesLeaveNoGoodFacesTheyAreRemeshed) {
  const Model wall = scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, 0.1, "WALL");
  const Model part = scenes::plate({-0.015, 0.43, 0}, {0.83, 0, 0}, {0, 0.9, 0}, 0.1, "PART");
  MergeOptions options;
  options.overlap = Overlap::kKeepBase;
  const auto kept = merge(wall, std::span(&part, 1), options);
  ASSERT_TRUE(kept.has_value()) << to_string(kept.error());
  EXPECT_TRUE(kept->report.broken_promises.empty()) << scenes::first_problem(kept->report);
  for (const Vec3 p : lost_faces(wall, apply(wall, std::span(&part, 1), *kept))) EXPECT_LT(p.x, 1.2);

  options.min_quality = 0.95;  // more than there can be: the other way is named
  const auto poor = merge(wall, std::span(&part, 1), options);
  ASSERT_TRUE(poor.has_value()) << to_string(poor.error());
  ASSERT_FALSE(poor->report.broken_promises.empty());
  EXPECT_NE(poor->report.broken_promises[0].hint.find("--overlap fuse"), std::string::npos)
      << to_string(poor->report.broken_promises[0]);
  EXPECT_EQ(poor->report.broken_promises[0].hint.find("--size"), std::string::npos);
}

/// The face of the doubler on the nodes of a poor one of the base, which is not remeshed, was held against the merge.
TEST(ProjectedContact, ALayerOnAPoorFaceOfTheInputIsToldAsSuch) {
  const Model wall = scenes::moved(scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, 0.1, "WALL"), [](Vec3 p) {
    return norm(p - Vec3{1, 1, 0}) < 1e-9 ? p + Vec3{0.06, 0.05, 0} : p;
  });
  const Model doubler = scenes::plate({0.45, 0.42, 0}, {1.2, 0, 0}, {0, 1.1, 0}, 0.1, "DOUBLER", 0.15);
  MergeOptions options;
  options.overlap = Overlap::kProject;
  const auto merged = merge(wall, std::span(&doubler, 1), options);
  ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
  EXPECT_TRUE(merged->report.broken_promises.empty()) << scenes::first_problem(merged->report);
  const auto told = std::ranges::find(merged->report.warnings, "poor-face", &Warning::name);
  ASSERT_NE(told, merged->report.warnings.end());
  EXPECT_NE(told->what.find("which stays as it is"), std::string::npos) << told->what;
}

/// By formula: the second plate has 0.63 x 1.1 on the wall, the third 0.47 x 0.93, all three 0.47 x 0.54 in common.
TEST(Stacks, TheReportNamesEachSetOfMeshesThatLieOnEachOther) {
  const scenes::Merge& scene = scene_named("three_in_partial_overlap");
  for (const Overlap overlap : {Overlap::kFuse, Overlap::kProject}) {
    const auto merged = merged_keeping(scene, overlap);
    ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
    std::map<std::set<std::uint32_t>, double> areas;
    for (const OverlapEntry& entry : merged->report.overlaps) {
      EXPECT_EQ(entry.rule, overlap == Overlap::kFuse ? "fused" : "projected");
      areas[{entry.inputs.begin(), entry.inputs.end()}] += entry.area;
    }
    const std::map<std::set<std::uint32_t>, double> expected{
        {{0, 1}, 0.4392}, {{0, 2}, 0.1833}, {{1, 2}, 0.3618}, {{0, 1, 2}, 0.2538}};
    ASSERT_EQ(areas.size(), expected.size());
    for (const auto& [inputs, area] : expected) EXPECT_NEAR(areas[inputs], area, 1e-6);
  }
}

TEST(KeptContact, ToDeleteAWholePartIsRefused) {
  const auto merged = merged_keeping(scene_named("doubler"), Overlap::kKeepBase);
  ASSERT_FALSE(merged.has_value());
  EXPECT_EQ(merged.error().code, ErrorCode::kOverlap);
  EXPECT_NE(merged.error().what.find("all 119 faces"), std::string::npos) << merged.error().what;
}

/// A profile with a flat leg on a plate; each has a group of nodes and one of faces that lie wholly on the other.
TEST(KeptContact, GroupsThatLieWhollyOnWhatIsDroppedAreEmptiedWithAWarning) {
  const auto with_groups = [](const Model& model, const std::string& side, double low, double high) {
    ModelBuilder b = scenes::faces_of(model);
    const auto is_in = [&](Vec3 p) { return p.z == 0 && low < p.x && p.x < high && 0.4 < p.y && p.y < 1.6; };
    for (std::size_t n = 0; n < model.n_nodes(); ++n)
      if (is_in(model.position[n])) b.add_to_group(side + "_NODES", NodeId(n));
    for (std::size_t e = 0; e < model.n_elements(); ++e)
      if (std::ranges::all_of(model.corners(ElementId(e)), is_in)) b.add_to_group(side + "_FACES", ElementId(e));
    return b.build();
  };
  const Model plate = scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, 0.1, "PLATE", 0.15);
  const std::array legs{scenes::plate({0.57, 0.33, 0}, {0.4, 0, 0}, {0, 1.3, 0}, 0.1, "PROFILE"),
                        scenes::plate({0.97, 0.33, 0}, {0, 0, 0.4}, {0, 1.3, 0}, 0.1, "PROFILE")};
  const Model base = with_groups(plate, "UNDER", 0.6, 0.95);
  const Model part = with_groups(scenes::welded(scenes::together(legs)), "OVER", 0.5, 0.95);
  for (const auto& [overlap, emptied] :
       {std::pair{Overlap::kKeepBase, "OVER"}, std::pair{Overlap::kKeepPart, "UNDER"}}) {
    MergeOptions options;
    options.overlap = overlap;
    const auto merged = merge(base, std::span(&part, 1), options);
    ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
    EXPECT_TRUE(merged->report.broken_promises.empty()) << scenes::first_problem(merged->report);
    EXPECT_EQ(std::ranges::count(merged->report.warnings, "emptied-group", &Warning::name), 2);
    for (const GroupEntry& group : merged->report.groups) {
      EXPECT_EQ(group.members_after == 0, group.name.starts_with(emptied)) << group.name;
      if (group.members_after == 0) {
        EXPECT_EQ(group.rule, "reduced by what was dropped") << group.name;
      }
    }
    scenes::expect_sound(apply(base, std::span(&part, 1), *merged));
  }
}

TEST(Stacks, AProfileWithBothLegsOverTheEdgeOfAPlateIsRefusedWithTheirDistance) {
  const Model plate = scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, 0.1, "PLATE", 0.15);
  constexpr double kOff = 0.02;
  scenes::Surface profile;  // a leg on each side of the plate, a web beyond its edge
  profile.at = [](double u, double v) {
    const double along = 7 * v, leg = std::min(along, 7 - along);
    return Vec3{0.4 + 1.2 * u, 0.75 + 0.1 * std::min(leg, 3.0), along < 3.5 ? kOff : -kOff};
  };
  profile.nu = 12, profile.nv = 7, profile.group = "PROFILE";
  const Model part = scenes::surface(profile);
  MergeOptions options;
  options.tolerance = {1.5 * kOff, false};
  for (const Overlap overlap : {Overlap::kFuse, Overlap::kProject, Overlap::kKeepBase, Overlap::kKeepPart}) {
    options.overlap = overlap;
    const auto merged = merge(plate, std::span(&part, 1), options);
    ASSERT_FALSE(merged.has_value());
    EXPECT_EQ(merged.error().code, ErrorCode::kOverlap);
    EXPECT_NE(merged.error().what.find("two layers of one mesh, 0.04 apart"), std::string::npos) << merged.error().what;
  }
}

/// A roof of any steepness and a ridge tile on it, whose nodes are elsewhere. What runs down one side of it from the
/// ridge is ahead on the other side too if the fold is sharper than a right angle.
TEST(FusedContact, ABorderIsFollowedOverAFold) {
  const auto roof = [](double steepness, Vec3 from, double along, double down, double size, const std::string& group) {
    scenes::Surface s;
    s.at = [=](double u, double v) {
      const double x = from.x + along * u, w = down * (2 * v - 1);
      return Vec3{x, from.y + w * std::cos(steepness), from.z - std::abs(w) * std::sin(steepness)};
    };
    s.nu = static_cast<std::size_t>(std::lround(along / size));
    s.nv = 2 * static_cast<std::size_t>(std::lround(down / size));
    s.group = group;
    return scenes::surface(s);
  };
  for (const double degrees : {25.0, 40.0, 50.0, 55.0, 65.0, 70.0})
    for (const double gap : {0.0, 0.01}) {
      SCOPED_TRACE(testing::Message() << "each side " << degrees << " degrees steep, " << gap << " apart");
      const double steepness = degrees * std::numbers::pi / 180;
      const Model base = roof(steepness, {0, 0, 0}, 2, 1, 0.1, "ROOF");
      const Model tile = roof(steepness, {0.53, 0, gap}, 0.83, 0.47, 0.09, "TILE");
      MergeOptions options;
      options.tolerance = {0.2, true};
      const auto merged = merge(base, std::span(&tile, 1), options);
      ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
      EXPECT_TRUE(merged->report.broken_promises.empty()) << scenes::first_problem(merged->report);
      EXPECT_GE(merged->report.quality.min, 0.5);
      // Straight down onto the roof its eaves come to lie higher up.
      EXPECT_NEAR(merged->report.overlaps.at(0).area, 2 * 0.83 * (0.47 - gap * std::sin(steepness)), 1e-3);
    }
}

/// A rim of nodes in two node groups, as programs write that list the nodes of each face: they were taken for named
/// ones.
TEST(FusedContact, NodesOnTheFoldOfAProfileStayInTheNodeGroupsOfBothLegs) {
  constexpr double kSize = 0.1, kFold = 1.23;
  const Model plate = scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, kSize, "PLATE", 0.15);
  scenes::Surface profile;  // a foot on the plate, a web at its end
  profile.at = [](double u, double v) {
    const double along = 0.8 * u;
    return Vec3{kFold - std::max(0.4 - along, 0.0), 0.13 + 0.7 * v, std::max(along - 0.4, 0.0)};
  };
  profile.nu = 8, profile.nv = 7;
  const Model legs = scenes::surface(profile);
  ModelBuilder builder = scenes::faces_of(legs);
  for (std::size_t n = 0; n < legs.n_nodes(); ++n) {
    if (legs.position[n].z < 1e-9) builder.add_to_group("FOOT", NodeId(n));
    if (legs.position[n].x > kFold - 1e-9) builder.add_to_group("WEB", NodeId(n));
  }
  const Model part = builder.build();
  const auto merged = merge(plate, std::span(&part, 1));
  ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
  EXPECT_TRUE(merged->report.broken_promises.empty()) << scenes::first_problem(merged->report);
  EXPECT_GE(merged->report.quality.min, 0.5);
  const Model result = apply(plate, std::span(&part, 1), *merged);
  std::vector<double> on_fold;
  for (std::size_t n = 0; n < result.n_nodes(); ++n) {
    const Vec3 p = result.position[n];
    if (std::abs(p.x - kFold) > 1e-9 || std::abs(p.z) > 1e-9 || p.y < 0.13 - 1e-9 || p.y > 0.83 + 1e-9) continue;
    on_fold.push_back(p.y);
    std::set<std::string> groups;
    for (const GroupId g : result.group_sets.members(result.node_groups[n])) groups.insert(result.groups[g.value].name);
    EXPECT_EQ(groups, (std::set<std::string>{"FOOT", "WEB"})) << p.y;
  }
  std::ranges::sort(on_fold);
  ASSERT_GE(on_fold.size(), 6u);
  for (std::size_t i = 1; i < on_fold.size(); ++i) EXPECT_GE(on_fold[i] - on_fold[i - 1], 0.5 * kSize);
}

TEST(FusedContact, NodeGroupsOfThreeMeshesCoverTheirFacesStill) {
  const auto doubler = [](Vec3 origin, const std::string& name) {
    const Model plain = scenes::plate(origin, {0.6, 0.1, 0}, {-0.1, 0.6, 0}, 0.09, name, 0.15);
    ModelBuilder builder = scenes::faces_of(plain);
    for (std::size_t e = 0; e < plain.n_elements(); ++e) builder.add_to_group(name, ElementId(e));
    for (std::size_t n = 0; n < plain.n_nodes(); ++n) builder.add_to_group(name + "_NODES", NodeId(n));
    return builder.build();
  };
  const Model plate = scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, 0.1, "PLATE", 0.15);
  const std::vector<Model> parts{doubler({0.5, 0.5, 0}, "A"), doubler({0.83, 0.77, 0}, "B")};
  const auto merged = merge(plate, parts);
  ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
  EXPECT_TRUE(merged->report.broken_promises.empty()) << scenes::first_problem(merged->report);
  const Model result = apply(plate, parts, *merged);
  const auto names = [&](GroupSetId set) {
    std::set<std::string> all;
    for (const GroupId g : result.group_sets.members(set)) all.insert(result.groups[g.value].name);
    return all;
  };
  std::size_t n_asked = 0;
  for (std::size_t e = 0; e < result.n_elements(); ++e) {
    const std::set<std::string> of_face = names(result.element_groups[e]);
    for (const NodeId n : result.nodes_of(ElementId(e)))
      for (const char* name : {"A", "B"}) {
        if (!of_face.contains(name)) continue;
        EXPECT_TRUE(names(result.node_groups[n.value]).contains(std::string(name) + "_NODES")) << name;
        ++n_asked;
      }
  }
  EXPECT_GT(n_asked, 300u);
}

/// A lap narrower than what is snapped, alone or as the end of a wider one, is one all the same.
TEST(FusedContact, NarrowLapsAreJoined) {
  constexpr double kSize = 0.1;
  const Model plate = scenes::plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, kSize, "PLATE", 0.15);
  struct Lap {
    double at_start, at_end, height;  // over the edge at x = 1
  };
  for (const Lap lap : {Lap{0.0099, 0.0099, 0}, Lap{0.009, 0.009, 0.008}, Lap{-0.005, 0.015, 0.002}}) {
    const Vec3 from{1 - lap.at_start, 0.13, lap.height}, along{lap.at_start - lap.at_end, 0.7, 0};
    const Model part = scenes::plate(from, {0.8, 0, 0}, along, 0.9 * kSize, "PART", 0.15);
    MergeOptions options;
    options.tolerance = {0.1, true};
    const auto merged = merge(plate, std::span(&part, 1), options);
    ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
    EXPECT_TRUE(merged->report.broken_promises.empty()) << scenes::first_problem(merged->report);
    for (const Warning& warning : merged->report.warnings) EXPECT_NE(warning.name, "partly-in-reach") << warning.what;
  }
}

/// A lap of 2 % of the edges is followed with triangles as small; the tolerance that is advised leaves it out.
TEST(FusedContact, ALapThatMakesTheZoneMuchFinerIsToldWithTheToleranceThatLeavesItOut) {
  constexpr double kSize = 0.1, kLap = 0.002;
  const Model plate = scenes::plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, kSize, "PLATE");
  const Model part = scenes::plate({1 - kLap, 0, 0}, {0.8, 0, 0}, {0, 1, 0}, kSize, "PART");
  const auto told = [](const Merged& m) { return std::ranges::find(m.report.warnings, "fine-zone", &Warning::name); };
  MergeOptions options;
  const auto fine = merge(plate, std::span(&part, 1), options);
  ASSERT_TRUE(fine.has_value()) << to_string(fine.error());
  ASSERT_NE(told(*fine), fine->report.warnings.end());
  const std::string &what = told(*fine)->what, before = "--tolerance of ";
  ASSERT_NE(what.find(before), std::string::npos) << what;
  options.tolerance = {std::stod(what.substr(what.find(before) + before.size())), false};
  EXPECT_LT(options.tolerance.value, 3 * kLap);
  const auto coarse = merge(plate, std::span(&part, 1), options);
  ASSERT_TRUE(coarse.has_value()) << to_string(coarse.error());
  EXPECT_TRUE(coarse->report.broken_promises.empty()) << scenes::first_problem(coarse->report);
  EXPECT_EQ(told(*coarse), coarse->report.warnings.end());
}

INSTANTIATE_TEST_SUITE_P(Scenes, Contact, testing::Range(std::size_t{0}, all_scenes().size()), [](const auto& scene) {
  std::string name = all_scenes()[scene.param].name;
  for (char& c : name)
    if (c == '-') c = '_';
  return name;
});

}  // namespace
}  // namespace meshgraft
