// Many parts in one call, and a model joined with itself.
#include "merge/components.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "meshgraft/check.hpp"
#include "meshgraft/merge.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

constexpr double kSize = 0.1;

Model wall() { return scenes::staggered_plate({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, kSize, "WALL", 0.15); }

/// On the wall, `short_by` off it.
Model along_x(double y, double short_by = 0, const std::string& group = "ALONG_X") {
  return scenes::staggered_plate({0.31, y, short_by}, {1.3, 0, 0}, {0, 0, 0.4}, 0.09, group, 0.15);
}
Model along_y(double x, const std::string& group = "ALONG_Y") {
  return scenes::staggered_plate({x, 0.37, -0.2}, {0, 1.2, 0}, {0, 0, 0.5}, kSize, group, 0.15);
}
/// Ends on the joint of the wall with what stands on the line y.
Model on_the_joint(double y) {
  return scenes::staggered_plate({0.5, y, 0}, {0.9, 0, 0}, {0, 0.3, 0.3}, kSize, "BRACE", 0.15);
}

Merged merged(const Model& base, const std::vector<Model>& parts, const MergeOptions& options = {}) {
  Result<Merged> result = merge(base, parts, options);
  if (!result) throw std::runtime_error(to_string(result.error()));
  for (const Error& e : result->report.broken_promises) ADD_FAILURE() << to_string(e);
  EXPECT_TRUE(check(apply(base, parts, *result)).sound());
  return std::move(*result);
}

using Corners = std::array<std::array<double, 3>, 3>;

/// The faces of a model by their coordinates, ascending, each from its smallest corner on.
std::vector<Corners> faces_of(const Model& model) {
  std::vector<Corners> faces;
  for (std::size_t e = 0; e < model.n_elements(); ++e) {
    if (!model.is_face(ElementId(e))) continue;
    Corners corners;
    for (std::size_t k = 0; const Vec3 p : model.corners(ElementId(e))) corners[k++] = {p.x, p.y, p.z};
    std::ranges::rotate(corners, std::ranges::min_element(corners));
    faces.push_back(corners);
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

double area_of_group(const Report& report, const std::string& name) {
  const auto at = std::ranges::find(report.groups, name, &GroupEntry::name);
  return at == report.groups.end() ? 0 : at->area_after;
}

TEST(ManyParts, TheirOrderChangesNothingButLabels) {
  // Parts that cross each other, stop short of the wall, and end on the joint of two others.
  const Model base = wall();
  const std::vector<Model> parts{along_x(0.83, 0.0004), along_y(0.71), along_y(1.23, "OTHER"), on_the_joint(0.83)};
  const Merged first = merged(base, parts);
  EXPECT_GE(first.report.quality.min, 0.5);
  EXPECT_FALSE(first.report.moved.empty());
  const std::vector<Corners> expected = faces_of(apply(base, parts, first));
  std::array<std::size_t, 4> order{0, 1, 2, 3};
  constexpr int kStep = 5;  // of the 24 permutations; prime to their number
  for (int k = 1; k <= 20; ++k) {
    std::ranges::next_permutation(order);
    if (k % kStep != 0) continue;
    std::vector<Model> permuted;
    for (const std::size_t part : order) permuted.push_back(parts[part]);
    EXPECT_TRUE(faces_of(apply(base, permuted, merged(base, permuted))) == expected) << k;
  }
}

TEST(ManyParts, ThreeSurfacesMeetInOnePoint) {
  const std::vector<Model> parts{along_x(0.9), along_y(0.9)};
  const Merged m = merged(wall(), parts);
  EXPECT_GE(m.report.quality.min, 0.5);
  EXPECT_EQ(std::ranges::count(m.report.junction, std::vector<std::uint32_t>{0, 1}, &PolylineSummary::inputs), 2);
}

TEST(SelfMerge, AnAssemblyGivesWhatItsPartsGive) {
  const Model base = wall();
  const std::vector<Model> parts{along_y(0.71), along_x(0.83, 0.0004)};  // the larger one first, as they are joined
  const Model assembly = scenes::together(std::array{base, parts[0], parts[1]});
  const Merged together = merged(assembly, {}), apart = merged(base, parts);
  EXPECT_TRUE(faces_of(apply(assembly, {}, together)) == faces_of(apply(base, parts, apart)));
  ASSERT_EQ(together.report.components.size(), 3u);
  EXPECT_EQ(together.report.components[0].groups, std::vector<std::string>{"WALL"});
  EXPECT_EQ(together.report.moved.size(), apart.report.moved.size());
  EXPECT_FALSE(together.report.moved.empty());
}

TEST(SelfMerge, AMeshThatWouldBeDeletedAsAWholeIsAnErrorAsIfItWereAPart) {
  const Model assembly = scenes::together(
      std::array{wall(), scenes::staggered_plate({0.55, 0.55, 0}, {0.5, 0, 0}, {0, 0.5, 0}, 0.09, "DOUBLER", 0.15)});
  MergeOptions options;
  options.overlap = Overlap::kKeepBase;
  const auto result = merge(assembly, {}, options);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kOverlap);
  EXPECT_NE(result.error().what.find("faces of the mesh of element"), std::string::npos) << result.error().what;
}

TEST(SelfMerge, AToleranceAboveTheSizeOfAMeshIsAnErrorWithBothFigures) {
  const Model assembly = scenes::together(std::array{wall(), along_x(0.8)});
  MergeOptions options;
  options.tolerance = {1.5, false};  // the wall is 2.8 across, the other mesh 1.36
  const auto result = merge(assembly, {}, options);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kUsage);
  EXPECT_NE(result.error().what.find("tolerance of 1.5"), std::string::npos) << result.error().what;
  EXPECT_NE(result.error().what.find("is only 1.36"), std::string::npos) << result.error().what;
}

TEST(SelfMerge, MeshesThatDoNotMeetAreAnError) {
  const Model apart = scenes::together(std::array{wall(), along_x(0.8, 0.3)});
  const auto result = merge(apart, {});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kPartsApart);
  EXPECT_NE(result.error().what.find("2 connected meshes"), std::string::npos);
}

TEST(SelfMerge, OneConnectedMeshHasNothingToJoin) {
  const auto result = merge(wall(), {});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kPartsApart);
  EXPECT_NE(result.error().hint.find("--join"), std::string::npos);
}

TEST(Join, OnlyFacesOfTheNamedGroupsAreJoined) {
  const Model assembly = scenes::together(std::array{wall(), along_x(0.6, 0, "FIRST"), along_x(1.4, 0, "SECOND")});
  MergeOptions options;
  options.joins = {{"WALL", "FIRST"}};
  Result<Merged> m = merge(assembly, {}, options);
  ASSERT_TRUE(m) << to_string(m.error());
  for (const Error& e : m->report.broken_promises) ADD_FAILURE() << to_string(e);
  const auto rule = [&](const char* name) {
    return std::ranges::find(m->report.groups, name, &GroupEntry::name)->rule;
  };
  EXPECT_EQ(rule("SECOND"), "untouched");
  EXPECT_NE(rule("FIRST"), "untouched");
  options.joins.push_back({"SECOND", "WALL"});
  m = merge(assembly, {}, options);
  ASSERT_TRUE(m) << to_string(m.error());
  EXPECT_NE(rule("SECOND"), "untouched");
}

TEST(Join, WhatElseCrossesThereIsLeftAsItWas) {
  const Model across = scenes::plate({0.9, 0.31, -0.1}, {0.05, 1.3, 0}, {0, 0, 0.5}, 0.09, "ACROSS", 0.15);
  const Model assembly = scenes::together(std::array{wall(), along_x(0.97, -0.04, "ALONG"), across});
  MergeOptions options;
  options.joins = {{"WALL", "ALONG"}};
  const auto m = merge(assembly, {}, options);
  ASSERT_TRUE(m) << to_string(m.error());
  for (const Error& e : m->report.broken_promises) ADD_FAILURE() << to_string(e);
  EXPECT_EQ(std::ranges::count(m->report.warnings, std::string("input-intersects"), &Warning::name), 1);
  EXPECT_EQ(std::ranges::find(m->report.groups, "ACROSS", &GroupEntry::name)->rule, "untouched");
}

TEST(Join, AGroupOfAConnectedMeshStaysConnectedWithTheRest) {
  // The rib crosses the border between the halves of the wall; only one of them is joined to it.
  const Model halves =
      scenes::welded(scenes::together(std::array{scenes::plate({0, 0, 0}, {1, 0, 0}, {0, 2, 0}, kSize, "LEFT"),
                                                 scenes::plate({1, 0, 0}, {1, 0, 0}, {0, 2, 0}, kSize, "RIGHT")}));
  const Model rib = scenes::plate({0.3, 0.83, -0.2}, {0.7, 0, 0}, {0, 0, 0.5}, 0.09, "RIB", 0.15);
  const Model assembly = scenes::together(std::array{halves, rib});
  MergeOptions options;
  options.joins = {{"LEFT", "RIB"}};
  const Merged m = merged(assembly, {}, options);
  EXPECT_GE(m.report.quality.min, 0.5);
  EXPECT_NEAR(area_of_group(m.report, "RIGHT"), 2, 1e-9);
  EXPECT_EQ(m.report.components.size(), 3u);
}

TEST(Join, TwoGroupsOfOneConnectedMeshAreJoinedWhereTheyCross) {
  // A frame of a wall, a rib on its edge, and a plate from the rib's far edge back through the wall.
  const Model frame =
      scenes::welded(scenes::together(std::array{scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, kSize, "WALL"),
                                                 scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 0, 1}, kSize, "RIB"),
                                                 scenes::plate({0, 0, 1}, {2, 0, 0}, {0, 1.7, -1.7}, kSize, "BACK")}));
  EXPECT_FALSE(merge(frame, {}));
  MergeOptions options;
  options.joins = {{"WALL", "BACK"}};
  const Merged m = merged(frame, {}, options);
  EXPECT_GE(m.report.quality.min, 0.5);
  ASSERT_EQ(m.report.junction.size(), 1u);
  EXPECT_NEAR(m.report.junction[0].length, 2, 1e-6);
}

TEST(Join, WhatGroupsShareAlreadyIsNoJunction) {
  // A rib along the edge of a wall, bent back so that it ends on the wall once more.
  const Model bent =
      scenes::welded(scenes::together(std::array{scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, kSize, "WALL"),
                                                 scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 0, 1}, kSize, "RIB"),
                                                 scenes::plate({0, 0, 1}, {2, 0, 0}, {0, 0.93, -1}, kSize, "RIB")}));
  MergeOptions options;
  options.joins = {{"WALL", "RIB"}};
  const Merged m = merged(bent, {}, options);
  ASSERT_EQ(m.report.junction.size(), 1u);
  EXPECT_NEAR(m.report.junction[0].length, 2, 1e-6);
  EXPECT_EQ(m.report.junction[0].kind, "touching");

  const Model angle =
      scenes::welded(scenes::together(std::array{scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, kSize, "WALL"),
                                                 scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 0, 1}, kSize, "RIB")}));
  const auto nothing = merge(angle, {}, options);
  ASSERT_FALSE(nothing.has_value());
  EXPECT_EQ(nothing.error().code, ErrorCode::kPartsApart);
}

TEST(Join, GroupsThatDoNotExistOrDoNotMeetAreErrors) {
  const Model assembly = scenes::together(std::array{wall(), along_x(0.6, 0, "FIRST"), along_x(1.4, 0, "SECOND")});
  MergeOptions options;
  options.joins = {{"WALL", "THIRD"}};
  auto m = merge(assembly, {}, options);
  ASSERT_FALSE(m);
  EXPECT_EQ(m.error().code, ErrorCode::kUsage);
  EXPECT_NE(m.error().what.find("THIRD"), std::string::npos);
  options.joins = {{"WALL", "FIRST"}, {"FIRST", "SECOND"}};
  m = merge(assembly, {}, options);
  ASSERT_FALSE(m);
  EXPECT_EQ(m.error().code, ErrorCode::kPartsApart);
  EXPECT_NE(m.error().what.find("SECOND"), std::string::npos);
}

/// The first in order was the one with the smaller coordinates: which of two doublers over each other stayed depended
/// on where they were.
TEST(ComponentOrder, OfPartsWithEquallyManyElementsDoesNotDependOnTheirPlace) {
  const auto half_turn = [](Vec3 p) { return Vec3{-p.x, -p.y, p.z}; };
  const Model base = wall(), first = along_x(0.5), second = along_x(1.5, 0, "OTHER");
  const Model turned_base = scenes::moved(base, half_turn), turned_first = scenes::moved(first, half_turn),
              turned_second = scenes::moved(second, half_turn);
  const auto as_they_are = components_of(std::array{&base, &first, &second}, {});
  const auto turned = components_of(std::array{&turned_base, &turned_first, &turned_second}, {});
  ASSERT_TRUE(as_they_are.has_value() && turned.has_value());
  EXPECT_EQ(as_they_are->input_order, turned->input_order);
}

}  // namespace
}  // namespace meshgraft
