// Round meshes that lie on each other with facets of their own: tubes, walls of holes, pads, flanges.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "meshgraft/merge.hpp"
#include "scenes/expect.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

Model tube(std::size_t around, std::size_t along, double low, double high, double turned, const std::string& group) {
  const auto at = [=](double u, double v) {
    const double a = 2 * std::numbers::pi * u + turned;
    return Vec3{10 * std::cos(a), 10 * std::sin(a), std::lerp(low, high, v)};
  };
  return scenes::surface({at, around, along, true, false, 0, 1, group});
}

/// Facets of a shank and of the hole that it stands in are nowhere farther apart than the greater sagitta, 0.123; the
/// chord of an edge of the one, seen in the surface of the other, is up to twice as far.
TEST(Tubes, OfOneRadiusWithOtherFacetsAreOneWhereTheyLieOnEachOther) {
  const Model hole = tube(20, 6, 0, 20, 0, "HOLE"), shank = tube(22, 19, -20.3, 39.7, 0.27, "SHANK");
  MergeOptions options;
  options.tolerance = {0.185, false};
  const auto merged = merge(hole, std::span(&shank, 1), options);
  ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
  EXPECT_TRUE(merged->report.broken_promises.empty()) << scenes::first_problem(merged->report);
  EXPECT_EQ(merged->report.junction.size(), 2u);
  const double of_facets = 20 * 20 * 20 * std::sin(std::numbers::pi / 20);
  EXPECT_NEAR(merged->report.overlaps.at(0).area, of_facets, 0.006 * of_facets);
  scenes::expect_sound(apply(hole, std::span(&shank, 1), *merged));
}

/// Of few sides the facets of one are up to a tenth narrower than those of the other that they are laid on.
TEST(Tubes, OfFewSidesMayChangeTheirAreaByTheAngleOfTheirFacets) {
  struct Sides {
    std::size_t hole, bar;
  };
  for (const Sides sides : {Sides{9, 5}, Sides{8, 14}, Sides{12, 6}, Sides{5, 14}}) {
    SCOPED_TRACE(testing::Message() << sides.hole << " and " << sides.bar << " sides");
    const double coarse = std::numbers::pi / static_cast<double>(std::min(sides.hole, sides.bar));
    const double fine = std::numbers::pi / static_cast<double>(std::max(sides.hole, sides.bar));
    const Model hole = tube(sides.hole, 3, 0, 20, 0, "HOLE"), bar = tube(sides.bar, 6, -5.3, 25.7, 0.1, "BAR");
    MergeOptions options;
    options.tolerance = {18 * (1 - std::cos(coarse)), false};
    options.contact_angle = coarse + fine + 0.1;
    const auto merged = merge(hole, std::span(&bar, 1), options);
    ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
    EXPECT_TRUE(merged->report.broken_promises.empty()) << scenes::first_problem(merged->report);
    scenes::expect_sound(apply(hole, std::span(&bar, 1), *merged));
  }
}

/// A vessel, and a pad with facets of its own at a distance of more than half an edge. The facets of the vessel bulge
/// by up to half a unit; its new faces are as far again from them.
struct SaddlePad {
  double vessel_size, pad_radius, pad_size;
};

void expect_pad_joined(const SaddlePad& scene, Overlap overlap) {
  constexpr double kRadius = 100, kLength = 200, kHalfAngle = 0.6, kWidth = 90;
  const auto n = [](double length, double size) { return static_cast<std::size_t>(std::lround(length / size)); };
  const auto around = [](double r, double a, double z) { return Vec3{r * std::cos(a), r * std::sin(a), z}; };
  scenes::Surface vessel, pad;
  vessel.at = [=](double u, double v) { return around(kRadius, 2 * std::numbers::pi * u, kLength * v); };
  vessel.nu = n(2 * std::numbers::pi * kRadius, scene.vessel_size), vessel.nv = n(kLength, scene.vessel_size);
  vessel.closed_u = true, vessel.group = "VESSEL";
  pad.at = [=](double u, double v) {
    return around(scene.pad_radius, kHalfAngle * (2 * u - 1) + 0.03, 57 + kWidth * v);
  };
  pad.nu = n(2 * kHalfAngle * scene.pad_radius, scene.pad_size), pad.nv = n(kWidth, scene.pad_size);
  pad.group = "PAD";
  const Model base = scenes::surface(vessel), part = scenes::surface(pad);
  MergeOptions options;
  options.tolerance = {std::abs(scene.pad_radius - kRadius) + 1, false}, options.overlap = overlap;
  const auto merged = merge(base, std::span(&part, 1), options);
  ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
  EXPECT_TRUE(merged->report.broken_promises.empty()) << scenes::first_problem(merged->report);
  EXPECT_GE(merged->report.quality.min, 0.5);
  const double gap = std::abs(scene.pad_radius - kRadius);
  if (overlap == Overlap::kProject) {
    EXPECT_GE(merged->report.fidelity->max_distance, 0.9 * gap);
  }
  const auto after = scenes::area_by_group(apply(base, std::span(&part, 1), *merged));
  const double of_pad = 2 * kHalfAngle * kWidth * (overlap == Overlap::kKeepPart ? scene.pad_radius : kRadius);
  EXPECT_NEAR(after.at("PAD"), of_pad, 0.01 * of_pad);
}

TEST(SaddlePads, AtADistanceAreJoinedWhateverTheSizesOfTheirFacets) {
  for (const SaddlePad& scene :
       {SaddlePad{10, 106, 10}, SaddlePad{10, 94, 10}, SaddlePad{20, 103, 10}, SaddlePad{20, 106, 10},
        SaddlePad{20, 106, 5}, SaddlePad{10, 106, 20}, SaddlePad{10, 94, 20}, SaddlePad{10, 106, 40}})
    for (const Overlap overlap : {Overlap::kFuse, Overlap::kProject}) {
      SCOPED_TRACE(testing::Message() << scene.vessel_size << ", " << scene.pad_radius << ", " << scene.pad_size
                                      << (overlap == Overlap::kFuse ? " fused" : " projected"));
      expect_pad_joined(scene, overlap);
    }
}

/// Strips of the vessel beside the border of the pad went with what lay beneath it, and nothing was left to join.
TEST(SaddlePads, AtMoreThanAnEdgeMayReplaceWhatIsBeneathThem) {
  for (const SaddlePad& scene : {SaddlePad{5, 106, 10}, SaddlePad{10, 106, 10}, SaddlePad{20, 106, 10}}) {
    SCOPED_TRACE(testing::Message() << scene.vessel_size);
    expect_pad_joined(scene, Overlap::kKeepPart);
  }
}

/// Two plates with walls around a common hole, which one divides into 6 and the other into 10, or both into 16. Facets
/// of a round wall are turned from row to row, so that they lean over those of the other wall.
TEST(FusedContact, WallsOfAHoleThatAbutAreNoContact) {
  const auto flange = [](std::size_t n, double side, double outer, double turned) {
    const double half = std::numbers::pi / static_cast<double>(n);
    const auto around = [=](double r, double a, double z) {
      return Vec3{r * std::cos(a + turned), r * std::sin(a + turned), z};
    };
    scenes::Surface plate, wall;
    plate.at = [=](double u, double v) { return around(5 + (outer - 5) * v, 2 * std::numbers::pi * u, 0); };
    wall.at = [=](double u, double v) { return around(5, 2 * std::numbers::pi * u + 2 * half * v, 5 * side * v); };
    plate.nu = wall.nu = n, plate.nv = 3, wall.nv = 2, plate.closed_u = wall.closed_u = true;
    const std::array<Model, 2> both{scenes::surface(plate), scenes::surface(wall)};
    return scenes::welded(scenes::together(both));
  };
  struct Case {
    std::size_t of_base, of_part;
    double turned;
  };
  for (const Case c : {Case{6, 10, 0.1}, Case{6, 10, 0.5}, Case{6, 10, 0.627}, Case{16, 16, 0}, Case{16, 16, 0.3}}) {
    const Model base = flange(c.of_base, -1, 20, 0), part = flange(c.of_part, 1, 14, c.turned);
    for (const double tolerance : {0.01, 0.1}) {
      MergeOptions options;
      options.tolerance = {tolerance, true}, options.min_quality = 0.2;
      const auto merged = merge(base, std::span(&part, 1), options);
      ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
      EXPECT_TRUE(merged->report.broken_promises.empty()) << scenes::first_problem(merged->report);
      EXPECT_FALSE(merged->report.overlaps.empty());
    }
  }
}

/// Plane, around the z axis.
Model ring(double inner, double outer, std::size_t around, std::size_t across, const std::string& group) {
  const auto at = [=](double u, double v) {
    const double a = 2 * std::numbers::pi * u, r = std::lerp(inner, outer, v);
    return Vec3{r * std::cos(a), r * std::sin(a), 0};
  };
  return scenes::surface({at, around, across, true, false, 0, 1, group});
}

void expect_area_kept(const Model& base, const Model& part, const std::string& group) {
  MergeOptions options;
  options.min_quality = 0.2;
  const auto merged = merge(base, std::span(&part, 1), options);
  ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
  EXPECT_TRUE(merged->report.broken_promises.empty()) << scenes::first_problem(merged->report);
  const double before = scenes::area_by_group(part).at(group);
  EXPECT_NEAR(scenes::area_by_group(apply(base, std::span(&part, 1), *merged)).at(group), before, 0.02 * before);
}

/// Corners of few degrees, which are no sharp turns: nodes slid off them, or passed over them.
TEST(FusedContact, ARoundPadOfFewSidesKeepsItsArea) {
  for (const std::size_t around : {12u, 14u, 24u, 30u})
    for (const double size : {5.0, 11.0}) {
      const Model plate = scenes::plate({-25.3, -24.8, 0}, {50, 0, 0}, {0, 50, 0}, size, "PLATE");
      SCOPED_TRACE(testing::Message() << around << " around, on edges of " << size);
      expect_area_kept(plate, ring(8.4, 14, around, 2, "PAD"), "PAD");
    }
}

TEST(FusedContact, ANarrowFlangeOfFewSidesKeepsItsAreaBesideTheJunction) {
  const Model pipe = scenes::surface({[](double u, double v) {
                                        const double a = 2 * std::numbers::pi * u;
                                        return Vec3{5 * std::cos(a), 5 * std::sin(a), 20 * v - 9.7};
                                      },
                                      20, 6, true, false, 0, 1, "PIPE"});
  expect_area_kept(pipe, ring(5, 7.5, 20, 1, "FLANGE"), "FLANGE");
}

/// Edges of the rim of a flange are nowhere farther from the pipe than the sagitta of its facets, 0.086. Drawn onto the
/// pipe by their ends they pass its corners by as much again, and were no longer taken for joined to them: slivers.
TEST(Flanges, WithFacetsOfTheirOwnAreJoinedWhereTheirRimWasWithinTheTolerance) {
  const Model pipe = tube(24, 8, -10, 10, 0.13, "PIPE"), flange = ring(10, 20, 28, 4, "FLANGE");
  for (const double tolerance : {0.09, 0.12, 0.2}) {
    SCOPED_TRACE(testing::Message() << "tolerance " << tolerance);
    MergeOptions options;
    options.tolerance = {tolerance, false};
    const auto merged = merge(pipe, std::span(&flange, 1), options);
    ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
    EXPECT_TRUE(merged->report.broken_promises.empty()) << scenes::first_problem(merged->report);
    EXPECT_GE(merged->report.quality.min, 0.5);
    scenes::expect_sound(apply(pipe, std::span(&flange, 1), *merged));
  }
}

}  // namespace
}  // namespace meshgraft
