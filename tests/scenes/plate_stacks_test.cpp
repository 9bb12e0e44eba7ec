// Flat plates at distances over each other, each turned and shifted in its plane.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

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
