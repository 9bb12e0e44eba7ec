// Flat plates at distances over each other, each turned and shifted in its plane.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "core/union_find.hpp"
#include "geometry/quality.hpp"
#include "meshgraft/merge.hpp"
#include "scenes/expect.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

struct Plate {
  double length, width, turn, x, y, size, height;
};

struct Stack {
  std::vector<Plate> plates;  // the base first
  double tolerance = 0;
};

/// Just above the sum of the gaps; a wall, and what overlaps it and each other in part.
const std::array<Stack, 2> kStacks{Stack{{{200, 160, 0, 0, 0, 10.08, 0},
                                          {66.61, 90.16, 3.16, 47.59, 37.33, 10.62, 3.76},
                                          {114.66, 75.57, 4.3, 6.3, -35.99, 9.54, 7.49}},
                                         7.861},
                                   Stack{{{200, 160, 0, 0, 0, 8.73, 0},
                                          {85.74, 80.2, 5.28, 53.04, -22.6, 9.23, 3.46},
                                          {105.1, 106.36, 0.77, -1.21, -49.95, 9.13, 6.93},
                                          {60.59, 61.08, 5.54, 19.89, 9.76, 9.6, 10.39}},
                                         10.915}};

using Motion = std::function<Vec3(Vec3)>;

std::vector<Model> models_of(
    const Stack& stack, const Motion& motion = [](Vec3 p) { return p; }) {
  std::vector<Model> models;
  for (const Plate& p : stack.plates) {
    const Vec3 u{std::cos(p.turn), std::sin(p.turn), 0}, v{-u.y, u.x, 0}, centre{p.x, p.y, p.height};
    const Vec3 corner = centre - 0.5 * p.length * u - 0.5 * p.width * v;
    const std::string name = "PLATE" + std::to_string(models.size());
    models.push_back(scenes::moved(scenes::staggered_plate(corner, p.length * u, p.width * v, p.size, name), motion));
  }
  return models;
}

Result<Merged> merged_stack(const std::vector<Model>& models, double tolerance, Overlap overlap) {
  MergeOptions options;
  options.tolerance = {tolerance, false}, options.overlap = overlap;
  return merge(models[0], std::span(models).subspan(1), options);
}

/// Strips beside a border that another plate had bent were told to lie over each other, or on the plate whose border
/// it was.
TEST(PlateStacks, AreJoinedWithAToleranceOfTheSumOfTheirGaps) {
  for (const Stack& stack : kStacks)
    for (const Overlap overlap : {Overlap::kFuse, Overlap::kProject, Overlap::kKeepPart}) {
      SCOPED_TRACE(testing::Message() << stack.plates.size() << " plates, variant " << static_cast<int>(overlap));
      const std::vector<Model> models = models_of(stack);
      const auto merged = merged_stack(models, stack.tolerance, overlap);
      ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
      EXPECT_TRUE(merged->report.broken_promises.empty()) << scenes::first_problem(merged->report);
      if (overlap == Overlap::kProject) continue;
      const Model result = apply(models[0], std::span(models).subspan(1), *merged);
      scenes::expect_sound(result);
      if (overlap == Overlap::kKeepPart) continue;
      const auto after = scenes::area_by_group(result);
      for (std::size_t k = 0; k < stack.plates.size(); ++k) {
        const double area = stack.plates[k].length * stack.plates[k].width;
        // Ways down beside borders, of three quarters of an edge length, add to it.
        EXPECT_NEAR(after.at("PLATE" + std::to_string(k)), area, 0.04 * area) << k;
      }
    }
}

/// Beyond an edge of the base two plates come down to it, and lie on each other there: both have its nodes already.
TEST(PlateStacks, ThatReachBeyondTheBaseAreJoinedThereToo) {
  const std::array<Stack, 2> stacks{Stack{{{200, 160, 0, 0, 0, 9.59, 0},
                                           {103.75, 67.75, 1.51, 21.51, 48.06, 11.06, 4.92},
                                           {64.07, 127.94, 3.06, -4.61, 21.41, 9.87, 7.75}},
                                          5.161},
                                    Stack{{{200, 160, 0, 0, 0, 10.73, 0},
                                           {145.05, 92.66, 1.25, -41.66, -8.45, 9.8, 2.61},
                                           {149.14, 126.55, 3.04, -16.73, -33.38, 10.76, 5.23}},
                                          2.744}};
  for (const Stack& stack : stacks)
    for (const Overlap overlap : {Overlap::kFuse, Overlap::kProject}) {
      SCOPED_TRACE(testing::Message() << stack.plates[1].size << ", variant " << static_cast<int>(overlap));
      const std::vector<Model> models = models_of(stack);
      const auto merged = merged_stack(models, stack.tolerance, overlap);
      ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
      EXPECT_TRUE(merged->report.broken_promises.empty()) << scenes::first_problem(merged->report);
      if (overlap == Overlap::kFuse) scenes::expect_sound(apply(models[0], std::span(models).subspan(1), *merged));
    }
}

/// How far a place is inside the outline of a plate, seen from above; negative outside.
double depth(const Plate& p, Vec3 at) {
  const Vec3 u{std::cos(p.turn), std::sin(p.turn), 0}, d = at - Vec3{p.x, p.y, 0};
  return std::min(p.length / 2 - std::abs(dot(u, d)), p.width / 2 - std::abs(u.x * d.y - u.y * d.x));
}

/// Faces of a model over a place, seen from above.
int layers_at(const Model& m, Vec3 at) {
  int n = 0;
  for (std::size_t e = 0; e < m.n_elements(); ++e) {
    const Triangle t = m.corners(ElementId(e));
    const auto is_left = [&](std::size_t k) {
      const Vec3 d = t[(k + 1) % 3] - t[k];
      return d.x * (at.y - t[k].y) - d.y * (at.x - t[k].x) > 0;
    };
    n += is_left(0) == is_left(1) && is_left(1) == is_left(2) ? 1 : 0;
  }
  return n;
}

/// Of the plates there, those that are within the tolerance of the next are one layer.
int layers_expected(const Stack& stack, Vec3 at) {
  std::vector<double> heights;
  for (const Plate& p : stack.plates)
    if (depth(p, at) > 0) heights.push_back(p.height);
  int n = heights.empty() ? 0 : 1;
  for (std::size_t k = 1; k < heights.size(); ++k) n += heights[k] - heights[k - 1] > stack.tolerance ? 1 : 0;
  return n;
}

/// Nothing is lost or counted twice farther from all outlines than what whole faces may round.
void expect_layers(const Stack& stack, const Model& result) {
  constexpr double kRounded = 12, kStep = 3.1;  // an edge is about 10
  for (double x = -140; x < 140; x += kStep)
    for (double y = -140; y < 140; y += kStep) {
      const Vec3 at{x, y, 0};
      if (std::ranges::any_of(stack.plates, [&](const Plate& p) { return std::abs(depth(p, at)) < kRounded; }))
        continue;
      EXPECT_EQ(layers_at(result, at), layers_expected(stack, at)) << x << ' ' << y;
    }
}

void expect_connected(const Model& m) {
  UnionFind sets(m.n_nodes());
  for (std::size_t e = 0; e < m.n_elements(); ++e)
    for (const NodeId n : m.nodes_of(ElementId(e))) sets.unite(m.nodes_of(ElementId(e))[0].value, n.value);
  for (std::size_t e = 0; e < m.n_elements(); ++e)
    ASSERT_EQ(sets.find(m.nodes_of(ElementId(e))[0].value), sets.find(m.nodes_of(ElementId(0))[0].value));
}

/// With a layer that is kept, the plates beneath or above it go where they lie on it, and those that lay on them end
/// there too: told by what was recorded, as no layer stands for them.
void expect_kept(const Stack& stack, Overlap overlap) {
  SCOPED_TRACE(testing::Message() << stack.plates[1].length << ", variant " << static_cast<int>(overlap));
  const std::vector<Model> models = models_of(stack);
  const auto merged = merged_stack(models, stack.tolerance, overlap);
  ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
  EXPECT_TRUE(merged->report.broken_promises.empty()) << scenes::first_problem(merged->report);
  const Model result = apply(models[0], std::span(models).subspan(1), *merged);
  scenes::expect_sound(result);
  expect_connected(result);
  expect_layers(stack, result);
}

const Stack kOnOneOnTheBase{{{200, 160, 0, 0, 0, 9.59, 0},
                             {62.33, 125.21, 3.45, 53.73, -6.47, 9.71, 2.56},
                             {88.85, 83.12, 0.97, -35.44, 19.89, 10.05, 4.68}},
                            2.69};
const Stack kThreeInARow{{{200, 160, 0, 0, 0, 10.81, 0},
                          {74.21, 104.62, 5.44, 57.5, -41.58, 9.49, 4.41},
                          {122.88, 79.74, 5.91, -29.25, -30.02, 9.91, 8.45},
                          {79.78, 118.97, 4.07, -53.58, 12.78, 10.31, 12.39}},
                         4.63};
const Stack kInANotch{{{200, 160, 0, 0, 0, 10.68, 0},
                       {147.17, 76.76, 5.46, -14.7, 3.09, 10.54, 2.03},
                       {98.01, 60.8, 3.84, -8.34, 26.61, 9.51, 3.51}},
                      2.13};

/// The last plate was apart, or its edge new, where the one beneath it had gone.
TEST(PlateStacks, WhatLiesOnAPlateThatGoesEndsOnWhatIsKept) {
  for (const Overlap overlap : {Overlap::kKeepBase, Overlap::kKeepPart}) {
    expect_kept(kOnOneOnTheBase, overlap);
    expect_kept(kThreeInARow, overlap);
  }
}

/// What a plate that goes covered of the base are whole faces. In a notch of their outline the plate on it came to lie
/// on the face there, all corners alike, and was left on it.
TEST(PlateStacks, ANotchInWhatLayOnTheBaseIsClosed) {
  for (const Overlap overlap : {Overlap::kKeepBase, Overlap::kKeepPart}) expect_kept(kInANotch, overlap);
}

/// A corner of the largest plate lies on another one that is laid on the base later: it covers less of the larger
/// one's faces in contact than it leaves.
TEST(PlateStacks, ACornerIsLaidDownWithWhatItLiesOn) {
  expect_kept({{{200, 160, 0, 0, 0, 8.95, 0},
                {61.75, 106.53, 2.91, -36.71, 22.49, 10.82, 2.2},
                {69.47, 93.98, 1.42, -58.47, 39.63, 9.72, 4.04},
                {144.76, 66.5, 5.34, 46.76, 23, 10.28, 6.36}},
               2.436},
              Overlap::kKeepBase);
}

/// Places, one unit apart at most, on the outline of a plate where those of others cross it.
std::vector<Vec3> outline_crossings(const Stack& stack, std::size_t k) {
  const Plate& p = stack.plates[k];
  const Vec3 u{std::cos(p.turn), std::sin(p.turn), 0}, v{-u.y, u.x, 0}, centre{p.x, p.y, 0};
  std::vector<Vec3> found;
  const auto look = [&](Vec3 from, Vec3 way) {
    for (double t = 0; t < 1; t += 0.5 / norm(way)) {
      const Vec3 at = from + t * way;
      for (std::size_t other = 0; other < stack.plates.size(); ++other)
        if (other != k && std::abs(depth(stack.plates[other], at)) < 1) found.push_back(at);
    }
  };
  const Vec3 a = 0.5 * p.length * u, b = 0.5 * p.width * v;
  look(centre - a - b, 2 * a), look(centre - a + b, 2 * a), look(centre - a - b, 2 * b), look(centre + a - b, 2 * b);
  return found;
}

/// Within the tolerance of all: one side is kept of every layer, and needs nodes only where other outlines cross its
/// own.
TEST(PlateStacks, TheKeptSideOfAStackStaysAsItIsButWhereOutlinesCross) {
  const std::array<Stack, 2> stacks{Stack{{{200, 160, 0, 0, 0, 9.87, 0},
                                           {124.37, 119.1, 3.79, 42.95, 4.49, 10.62, 3.78},
                                           {116.12, 105.21, 2.41, -7.49, -20.25, 10.73, 6.93}},
                                          7.28},
                                    Stack{{{200, 160, 0, 0, 0, 10.73, 0},
                                           {89.88, 74.66, 5.16, -52.29, -45.83, 9.43, 4.84},
                                           {148.65, 101.65, 0.62, 3.58, 10.85, 9.55, 8.03}},
                                          8.43}};
  for (const Stack& stack : stacks)
    for (const Overlap overlap : {Overlap::kKeepBase, Overlap::kKeepPart}) {
      expect_kept(stack, overlap);
      const std::vector<Model> models = models_of(stack);
      const auto merged = merged_stack(models, stack.tolerance, overlap);
      ASSERT_TRUE(merged.has_value());
      // The base, or the plate with the fewest elements.
      std::size_t kept = 0;
      for (std::size_t k = 1; overlap == Overlap::kKeepPart && k < models.size(); ++k)
        if (kept == 0 || models[k].n_elements() < models[kept].n_elements()) kept = k;
      constexpr double kZone = 45;  // edges are about 10: three neighbourhoods, more where faces would be poor
      const std::vector<Vec3> crossings = outline_crossings(stack, kept);
      for (const ElementId e : merged->graft.removed_elements[kept]) {
        const Vec3 c = centroid(models[kept].corners(e));
        const auto is_near = [&](Vec3 p) { return std::hypot(p.x - c.x, p.y - c.y) < kZone; };
        EXPECT_TRUE(std::ranges::any_of(crossings, is_near)) << c.x << ' ' << c.y;
      }
    }
}

/// Which layer stays does not depend on the order of the parts: the base, or the part with the fewest elements.
TEST(PlateStacks, TheKeptSideDoesNotDependOnTheOrder) {
  const Stack stack{{{200, 160, 0, 0, 0, 9.87, 0},
                     {124.37, 119.1, 3.79, 42.95, 4.49, 10.62, 3.78},
                     {116.12, 105.21, 2.41, -7.49, -20.25, 10.73, 6.93}},
                    7.28};
  const std::vector<Model> models = models_of(stack), turned{models[0], models[2], models[1]};
  ASSERT_LT(models[2].n_elements(), models[1].n_elements());
  for (const Overlap overlap : {Overlap::kKeepBase, Overlap::kKeepPart}) {
    std::array<std::map<std::string, double>, 2> areas;
    for (const std::size_t k : {0, 1}) {
      const std::vector<Model>& all = k == 0 ? models : turned;
      const auto merged = merged_stack(all, stack.tolerance, overlap);
      ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
      areas[k] = scenes::area_by_group(apply(all[0], std::span(all).subspan(1), *merged));
    }
    for (const auto& [group, area] : areas[0]) EXPECT_NEAR(areas[1].at(group), area, 1e-3 * area) << group;
    const bool is_base = overlap == Overlap::kKeepBase;
    const double whole = is_base ? 200 * 160 : 116.12 * 105.21;
    EXPECT_NEAR(areas[0].at(is_base ? "PLATE0" : "PLATE2"), whole, 1e-3 * whole);
  }
}

/// No good face fits between its nodes and the free edge of the base, a quarter of an edge length beside them.
TEST(PlateStacks, AKeptPlateNextToAFreeEdgeIsRemeshedThereAndNowhereElse) {
  const Stack stack{{{200, 160, 0, 0, 0, 10, 0}, {80, 60, 0.01, 5, 47.1, 10, 1}}, 1.05};
  const std::vector<Model> models = models_of(stack);
  const auto merged = merged_stack(models, stack.tolerance, Overlap::kKeepPart);
  ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
  EXPECT_TRUE(merged->report.broken_promises.empty()) << scenes::first_problem(merged->report);
  scenes::expect_sound(apply(models[0], std::span(models).subspan(1), *merged));
  const auto& gone = merged->graft.removed_elements[1];
  EXPECT_FALSE(gone.empty());
  for (const ElementId e : gone) EXPECT_GT(centroid(models[1].corners(e)).y, 40);
}

}  // namespace
}  // namespace meshgraft
