// Places on the surface as it was: the fast way against the sure one.
#include "remesh/reference.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cut.hpp"
#include "geometry/closest.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

/// A sheet with waves of the given height, ten edges long.
struct Waves {
  cut::Scene scene;
  Brep brep;
  std::vector<std::uint8_t> in_zone;

  explicit Waves(double height) {
    const Model flat = scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, 0.1, "WAVES", 0.2);
    cut::add(scene,
             scenes::moved(flat,
                           [&](Vec3 p) {
                             return p + Vec3{0, 0, height * std::sin(2 * std::numbers::pi * p.x)};
                           }),
             0);
    brep = read_brep(scene.complex, {}, {}, scene.groups);
    in_zone.assign(scene.complex.n_faces(), 1);
  }
};

double within(double low, double high) { return low + (high - low) * 1e-6 * *rc::gen::inRange(0, 1'000'001); }

RC_GTEST_PROP(Reference, AWalkEndsOnTheSurfaceNoNearerThanTheNearestPlace, ()) {
  static const Waves waves(0.1);
  static const Reference reference(waves.scene.complex, waves.brep, waves.in_zone);
  const SheetId sheet = waves.brep.sheet_of_face[0];
  RC_ASSERT(!waves.brep.sheets[sheet.value].planar);
  const Vec3 p{within(-0.1, 2.1), within(-0.1, 2.1), within(-0.2, 0.2)};
  const FaceId from(*rc::gen::inRange<std::size_t>(0, waves.scene.complex.n_faces()));
  const Foot walked = reference.walk(sheet, p, from), nearest = reference.project(sheet, p, from);
  const Vec3 there = closest_on_triangle(p, waves.scene.complex.corners(walked.face)).point;
  RC_ASSERT(distance(walked.point, there) <= 1e-12);
  RC_ASSERT(std::abs(walked.distance - distance(p, walked.point)) <= 1e-12);
  RC_ASSERT(walked.distance >= nearest.distance - 1e-12);
  RC_ASSERT(reference.project(sheet, p, FaceId{}).distance == nearest.distance);
}

/// As far as vertices are tried: within a tenth of an edge of the surface, from a face two edges away at most.
RC_GTEST_PROP(Reference, AWalkFromNearbyFindsTheNearestPlace, ()) {
  static const Waves waves(0.1);
  static const Reference reference(waves.scene.complex, waves.brep, waves.in_zone);
  const SheetId sheet = waves.brep.sheet_of_face[0];
  const FaceId from(*rc::gen::inRange<std::size_t>(0, waves.scene.complex.n_faces()));
  const Vec3 start = centroid(waves.scene.complex.corners(from));
  const double x = std::clamp(start.x + within(-0.2, 0.2), 0.0, 2.0);
  const Vec3 p{x, std::clamp(start.y + within(-0.2, 0.2), 0.0, 2.0),
               0.1 * std::sin(2 * std::numbers::pi * x) + within(-0.01, 0.01)};
  RC_ASSERT(std::abs(reference.walk(sheet, p, from).distance - reference.project(sheet, p, from).distance) <= 1e-3);
}

TEST(Reference, InAMadeUpSheetAWalkStaysWhereItIs) {
  Waves waves(0.1);
  for (Sheet& sheet : waves.brep.sheets) sheet.made_up = true;
  const Reference reference(waves.scene.complex, waves.brep, waves.in_zone);
  const Foot foot = reference.walk(waves.brep.sheet_of_face[7], {1, 2, 3}, FaceId(std::size_t{7}));
  EXPECT_EQ(foot.point, (Vec3{1, 2, 3}));
  EXPECT_EQ(foot.distance, 0);
}

}  // namespace
}  // namespace meshgraft
