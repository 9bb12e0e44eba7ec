// Bolts, nuts and holes of four sides, as a coarse mesher leaves them: facets lean to each other by up to the angle
// between two sides, and stand off each other by up to the sagitta of one.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "geometry/angles.hpp"
#include "meshgraft/merge.hpp"
#include "scenes/expect.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

constexpr double kRadius = 5;
const double kSagitta = kRadius * (1 - std::cos(std::numbers::pi / 4));  // of one side: 1.464

/// In eighths of the circle, so that what shall be in one place is, up to the last bit.
Vec3 around(double r, std::size_t eighth, double z, double turned = 0) {
  const double a = std::numbers::pi / 4 * static_cast<double>(eighth % 8) + turned;
  return {r * std::cos(a), r * std::sin(a), z};
}

/// A wall of four sides with a row of four nodes at each height, each turned by half a side against the one before.
Model wall(const std::vector<double>& heights, const std::string& group, double turned = 0) {
  ModelBuilder builder;
  std::vector<std::array<NodeId, 4>> row;
  for (std::size_t j = 0; j < heights.size(); ++j) {
    row.emplace_back();
    for (std::size_t i = 0; i < 4; ++i) row[j][i] = builder.add_node(around(kRadius, 2 * i + j, heights[j], turned));
  }
  for (std::size_t j = 1; j < row.size(); ++j)
    for (std::size_t i = 0; i < 4; ++i) {
      const NodeId a = row[j - 1][i], b = row[j - 1][(i + 1) % 4], c = row[j][i], d = row[j][(i + 1) % 4];
      builder.add_to_group(group, builder.add_face(a, b, c));
      builder.add_to_group(group, builder.add_face(c, b, d));
    }
  return builder.build(group);
}

/// Plane, around the rim of such a wall.
Model cap(double z, double outer, std::size_t across) {
  ModelBuilder builder;
  std::vector<std::array<NodeId, 4>> row;
  for (std::size_t j = 0; j <= across; ++j) {
    row.emplace_back();
    const double r = std::lerp(kRadius, outer, static_cast<double>(j) / static_cast<double>(across));
    for (std::size_t i = 0; i < 4; ++i) row[j][i] = builder.add_node(around(r, 2 * i, z));
  }
  for (std::size_t j = 1; j < row.size(); ++j)
    for (std::size_t i = 0; i < 4; ++i) {
      const NodeId a = row[j - 1][i], b = row[j - 1][(i + 1) % 4], c = row[j][i], d = row[j][(i + 1) % 4];
      builder.add_to_group("CAP", builder.add_face(a, c, d));
      builder.add_to_group("CAP", builder.add_face(a, d, b));
    }
  return builder.build("cap");
}

Model flange(double depth, double outer, std::size_t across, const std::string& group) {
  const std::array<Model, 2> both{cap(0, outer, across), wall({0, 0.5 * depth, depth}, group)};
  return scenes::welded(scenes::together(both));
}

/// 12 thick.
Model drilled_plate() {
  const std::array<Model, 3> all{cap(0, 20, 3), wall({0, 6, 12}, "HOLE"), cap(12, 20, 3)};
  return scenes::welded(scenes::together(all));
}

/// Lies on the plate.
Model nut(std::size_t across) {
  const std::array<Model, 3> all{cap(12, 10, across), wall({12, 15, 18}, "NUT"), cap(18, 10, across)};
  return scenes::welded(scenes::together(all));
}

void expect_merged(const Model& base, std::span<const Model> parts) {
  MergeOptions options;
  options.tolerance = {0.99 * kSagitta, false};
  options.contact_angle = radians(50);
  const auto merged = merge(base, parts, options);
  ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
  EXPECT_TRUE(merged->report.broken_promises.empty()) << scenes::first_problem(merged->report);
  EXPECT_FALSE(merged->report.overlaps.empty());
  scenes::expect_sound(apply(base, parts, *merged));
}
void expect_merged(const Model& base, const Model& part) { expect_merged(base, std::span(&part, 1)); }

/// Facets of the wall lean over the plate around the hole, within the tolerance: they abut all the same.
TEST(CoarseContact, WallsOfFourSidesThatAbutAreNoContactWhereTheirPlatesAre) {
  expect_merged(flange(-10, 20, 3, "LOWER"), flange(3, 14, 2, "UPPER"));
  expect_merged(flange(-10, 20, 3, "LOWER"), flange(3.2, 14, 2, "UPPER"));
}

/// Nodes of the one are over the middle of a facet of the other, and edges over edges at any angle.
TEST(CoarseContact, ABoltOfFourSidesIsOneWithTheWallOfItsHole) {
  expect_merged(drilled_plate(), wall({-4, 4.5, 13, 21.5, 30}, "BOLT"));
  expect_merged(drilled_plate(), wall({-4, 4.5, 13, 21.5, 30}, "BOLT", radians(20)));
  expect_merged(drilled_plate(), wall({-6, 2, 10, 18, 26}, "BOLT"));
  expect_merged(drilled_plate(), wall({-6, 2, 10, 18, 26}, "BOLT", radians(45)));
  expect_merged(drilled_plate(), wall({-4, 3, 9, 16, 23, 30}, "BOLT"));
}

TEST(CoarseContact, ABoltIsOneWithPlateAndNutInOneCall) {
  for (const double turned : {0.0, radians(20), radians(45)})
    for (const std::size_t across : {2u, 3u}) {
      SCOPED_TRACE(testing::Message() << turned << ' ' << across);
      const Model bolt = wall({-4, 4.5, 13, 21.5, 30}, "BOLT", turned);
      expect_merged(drilled_plate(), std::array{bolt, nut(across)});
      expect_merged(drilled_plate(), std::array{nut(across), bolt});
    }
}

/// The length or angle after an option in a hint.
double advised(const std::string& hint, const std::string& option) {
  return std::stod(hint.substr(hint.find(option) + option.size()));
}

TEST(CoarseContact, TheOptionsThatARefusalNamesMakeOneOfBoth) {
  for (const double turned : {0.0, radians(20)}) {
    const Model base = drilled_plate(), part = wall({-4, 4.5, 13, 21.5, 30}, "BOLT", turned);
    MergeOptions options;
    const auto refused = merge(base, std::span(&part, 1), options);
    ASSERT_FALSE(refused.has_value());
    const std::string hint = refused.error().hint;
    ASSERT_NE(hint.find("--tolerance"), std::string::npos) << hint;
    options.tolerance = {advised(hint, "--tolerance "), false};
    options.contact_angle = radians(advised(hint, "--angle "));
    const auto merged = merge(base, std::span(&part, 1), options);
    ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
    EXPECT_TRUE(merged->report.broken_promises.empty()) << scenes::first_problem(merged->report);
    scenes::expect_sound(apply(base, std::span(&part, 1), *merged));
  }
}

}  // namespace
}  // namespace meshgraft
