// Laws of meshes that lie on each other, over random plates and those that were once wrong.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

#include "checks.hpp"
#include "plate_pairs.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

using checks::PlatePair;

constexpr double kQuarter = std::numbers::pi / 2;

double number(double low, double high) { return low + (high - low) * *rc::gen::inRange(0, 1000) / 1000.0; }

/// Anywhere and of any edge length.
PlatePair any_pair() {
  PlatePair p;
  p.size = *rc::gen::element(1.0, 1.0, 0.43, 0.8, 1.7, 0.25, 4.0);
  p.x = number(-1, 5), p.y = number(-1, 5), p.turn = number(0, std::numbers::pi);
  p.length = number(1.5, 5), p.width = number(1.5, 5);
  p.base_jitter = *rc::gen::element(0.0, 0.3), p.jitter = *rc::gen::element(0.0, 0.3);
  p.noise = *rc::gen::element(0.0, 0.0, 1e-15, 1e-13, 1e-9, 1e-7, 1e-6, 1e-5, 1e-4);  // about the weld length too
  p.tilt = *rc::gen::element(0.0, 1.0) * number(0, 1.5);
  p.staggered = *rc::gen::arbitrary<bool>();
  return p;
}

/// Some lean, within the tolerance.
PlatePair leaning(PlatePair p) {
  if (*rc::gen::inRange(0, 4) == 0) p.lean = 0.4 * checks::tolerance(p);
  return p;
}

/// The lattices of both share nodes, edges or lines.
PlatePair any_aligned_pair() {
  PlatePair p = any_pair();
  p.size = *rc::gen::element(1.0, 1.0, 0.5, 0.25, 0.125, 2.0);
  p.turn = *rc::gen::element(0.0, kQuarter / 2, kQuarter, 2 * kQuarter);
  const double step = *rc::gen::element(1.0, 0.5);
  p.x = step * *rc::gen::inRange(-2, 13), p.y = step * *rc::gen::inRange(-2, 13);
  p.length = std::max(1.0, p.size * *rc::gen::inRange(1, 7));
  p.width = std::max(1.0, p.size * *rc::gen::inRange(1, 7));
  return p;
}

void expect_no_area_lost(const PlatePair& pair) {
  const std::vector<Model> models = checks::models(pair);
  GroupSets sets;
  const auto after = corefine(checks::complex_of(models, sets), sets, {});
  ASSERT_TRUE(after.has_value()) << after.error().what;
  for (const std::string& fault : checks::faults(pair, models, *after, sets)) ADD_FAILURE() << fault;
}

void assert_no_area_is_lost(const PlatePair& pair) {
  RC_PRE(checks::common_area(pair) > 0.05);
  const std::vector<Model> models = checks::models(pair);
  GroupSets sets;
  const auto after = corefine(checks::complex_of(models, sets), sets, {});
  RC_LOG() << checks::to_string(pair) << '\n';
  if (!after) RC_LOG() << after.error().what << '\n';
  RC_ASSERT(after.has_value());
  const auto faults = checks::faults(pair, models, *after, sets);
  for (const std::string& fault : faults) RC_LOG() << fault << '\n';
  RC_ASSERT(faults.empty());
}

RC_GTEST_PROP(OverlayLaws, NoAreaIsLostOrCountedTwice, ()) { assert_no_area_is_lost(leaning(any_pair())); }

RC_GTEST_PROP(OverlayLaws, NoAreaIsLostBetweenAlignedMeshes, ()) {
  assert_no_area_is_lost(leaning(any_aligned_pair()));
}

RC_GTEST_PROP(OverlayLaws, AKeptBaseIsCutOnlyWhereBordersCross, ()) {
  const PlatePair pair = leaning(*rc::gen::arbitrary<bool>() ? any_pair() : any_aligned_pair());
  RC_PRE(checks::common_area(pair) > 0.05);
  RC_LOG() << checks::to_string(pair) << '\n';
  const std::vector<Model> models = checks::models(pair);
  GroupSets sets;
  CorefineOptions options;
  options.overlap = Overlap::kKeepBase;
  const auto after = corefine(checks::complex_of(models, sets), sets, options);
  RC_ASSERT(after.has_value());
  const auto faults = checks::faults_of_kept_base(pair, models, *after);
  for (const std::string& fault : faults) RC_LOG() << fault << '\n';
  RC_ASSERT(faults.empty());
}

RC_GTEST_PROP(OverlayLaws, AMotionOfTheSceneMovesTheResult, ()) {
  const PlatePair pair = leaning(*rc::gen::arbitrary<bool>() ? any_pair() : any_aligned_pair());
  RC_PRE(checks::common_area(pair) > 0.05);
  RC_LOG() << checks::to_string(pair) << '\n';
  const double angle = number(0, 6.28), share = number(-1, 1);
  const Vec3 axis = normalized(Vec3{share, std::sqrt(1 - share * share), 0.5}), shift{number(-9, 9), number(-9, 9), 7};
  const auto motion = [&](Vec3 p) {
    return dot(p, axis) * axis + std::cos(angle) * (p - dot(p, axis) * axis) + std::sin(angle) * cross(axis, p) + shift;
  };
  const std::vector<Model> models = checks::models(pair);
  std::vector<Model> moved;
  for (const Model& m : models) moved.push_back(scenes::moved(m, motion));
  GroupSets sets;
  const auto here = corefine(checks::complex_of(models, sets), sets, {});
  auto there = corefine(checks::complex_of(moved, sets), sets, {});
  RC_ASSERT(here.has_value());
  RC_ASSERT(there.has_value());
  Corefined back = *here;
  for (Vec3& p : back.complex.position) p = motion(p);
  // Ties are broken by rounding, within the weld length.
  constexpr double kTie = 1e-5;
  RC_ASSERT(checks::junction_distance(back, *there) < kTie);
  RC_ASSERT(checks::junction_distance(*there, back) < kTie);
  RC_ASSERT(std::abs(checks::layered_area(here->complex) - checks::layered_area(there->complex)) < kTie);
}

/// A piece of the border ran within the weld length of an edge of the base, now on one side of it, now on the other.
TEST(Overlay, ABorderMayWindAroundAnEdge) {
  expect_no_area_lost({.x = 0.5, .y = 3, .length = 1, .width = 1, .size = 0.25, .noise = 1e-6, .tilt = 0.3945});
  expect_no_area_lost({.x = 4, .y = 4, .length = 2, .width = 2, .turn = kQuarter / 2, .size = 0.5, .noise = 1e-6});
}

/// Edges of the plate along the free edge of the base, from one side of a node to the other.
TEST(Overlay, AnEdgeOverAFreeEdgeTakesItsNodes) {
  expect_no_area_lost(
      {.x = 2, .y = 2.5, .length = 4, .width = 4, .turn = kQuarter, .size = 2, .lean = 0.004, .staggered = true});
  expect_no_area_lost({.x = 5, .y = 2.5, .length = 2, .width = 5, .lean = 0.004, .base_jitter = 0.3, .noise = 1e-4});
}

/// Features that are snapped bring faces onto the other mesh that did not lie on it before.
TEST(Overlay, FacesThatSnappingBringsOntoTheOtherMeshAreCovered) {
  expect_no_area_lost({.x = 4.286,
                       .y = 3.53,
                       .length = 3.2815,
                       .width = 4.3175,
                       .turn = 0.3549895,
                       .size = 0.43,
                       .lean = 0.00172,
                       .noise = 1e-6,
                       .tilt = 0.6825});
  expect_no_area_lost({.x = 2.594,
                       .y = -0.124,
                       .length = 4.867,
                       .width = 4.727,
                       .turn = 2.5980205,
                       .size = 0.43,
                       .jitter = 0.3,
                       .noise = 1e-7,
                       .tilt = 1.212});
  expect_no_area_lost({.x = 3.008,
                       .y = -0.01,
                       .length = 2.354,
                       .width = 4.3245,
                       .turn = 2.368691,
                       .size = 1.7,
                       .base_jitter = 0.3,
                       .noise = 1e-9,
                       .tilt = 0.2985});
}

/// A piece of the border lay on the other mesh only as that one saw it: a corner had been snapped beside it.
TEST(Overlay, APieceOfTheBorderBesideASnappedCornerIsFollowed) {
  expect_no_area_lost({.x = 1.28,
                       .y = -0.25,
                       .length = 3.7365,
                       .width = 2.214,
                       .turn = 1.3037225,
                       .base_jitter = 0.3,
                       .noise = 1e-9,
                       .tilt = 0.63,
                       .staggered = true});
}

/// A corner of the plate became a point of the free edge; a corner of the base beyond it had nowhere to lie.
TEST(Overlay, ACornerBeyondASnappedCornerStaysFree) {
  expect_no_area_lost({.x = 2.942,
                       .y = 0.95,
                       .length = 1.619,
                       .width = 4.727,
                       .turn = 0.9581575,
                       .size = 0.8,
                       .base_jitter = 0.3,
                       .noise = 1e-6,
                       .tilt = 0.105});
}

/// The same, where what was left between edge and node was a face without area, or the same face twice.
TEST(Overlay, NoSliverIsLeftBesideAFreeEdge) {
  expect_no_area_lost(
      {.x = 3.5, .y = 2.5, .length = 5, .width = 6, .turn = 2 * kQuarter, .lean = 0.004, .tilt = 1.449});
  expect_no_area_lost({.x = 1,
                       .y = 4.5,
                       .length = 3,
                       .width = 1.5,
                       .turn = kQuarter,
                       .size = 0.5,
                       .lean = 0.002,
                       .noise = 1e-4,
                       .tilt = 1.224,
                       .staggered = true});
}

}  // namespace
}  // namespace meshgraft
