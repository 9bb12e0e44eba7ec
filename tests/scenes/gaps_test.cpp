// Parts that end a share of an edge length short of the base, or as far beyond it, are joined along their own surface.
#include <gtest/gtest.h>

#include "meshgraft/merge.hpp"
#include "scenes/expect.hpp"
#include "support/catalogue.hpp"

namespace meshgraft {
namespace {

const std::vector<scenes::Merge>& all_scenes() {
  static const std::vector<scenes::Merge> all = scenes::gap_catalogue();
  return all;
}

class Gaps : public testing::TestWithParam<std::size_t> {};

TEST_P(Gaps, AreClosedAndEachMoveIsReported) {
  const scenes::Merge& scene = all_scenes()[GetParam()];
  const auto merged = merge(scene.base, scene.parts, scene.options);
  ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
  const Report& report = merged->report;
  EXPECT_TRUE(report.broken_promises.empty()) << scenes::first_problem(report);
  EXPECT_GE(report.quality.min, scene.min_q);
  EXPECT_GE(report.quality.mean, scene.mean_q);
  EXPECT_LE(report.fidelity.max_distance_relative, scene.max_off);

  double joined = 0;
  for (const PolylineSummary& p : report.junction) joined += p.length;
  EXPECT_NEAR(joined, scene.joined_length, 0.03 * scene.joined_length);
  EXPECT_FALSE(report.moved.empty());
  const double most = 2 * scene.options.tolerance.value;
  for (const MovedEntry& m : report.moved) {
    EXPECT_EQ(m.input, 1u);
    EXPECT_LE(m.distance, most);
  }

  scenes::expect_sound(apply(scene.base, scene.parts, *merged));
}

INSTANTIATE_TEST_SUITE_P(Scenes, Gaps, testing::Range(std::size_t{0}, all_scenes().size()),
                         [](const auto& scene) { return all_scenes()[scene.param].name; });

}  // namespace
}  // namespace meshgraft
