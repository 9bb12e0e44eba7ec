// Every scene of the catalogue merges, and keeps the promises.
#include "support/catalogue.hpp"

#include <gtest/gtest.h>

#include <map>

#include "meshgraft/merge.hpp"
#include "scenes/expect.hpp"

namespace meshgraft {
namespace {

const std::vector<scenes::Merge>& all_scenes() {
  static const std::vector<scenes::Merge> all = scenes::catalogue();
  return all;
}

class Catalogue : public testing::TestWithParam<std::size_t> {};

TEST_P(Catalogue, MergesAndKeepsThePromises) {
  const scenes::Merge& scene = all_scenes()[GetParam()];
  const auto merged = merge(scene.base, scene.parts);
  if (scene.apart) {
    ASSERT_FALSE(merged.has_value());
    EXPECT_EQ(merged.error().code, ErrorCode::kPartsApart);
    return;
  }
  ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
  const Report& report = merged->report;
  EXPECT_TRUE(report.broken_promises.empty()) << scenes::first_problem(report);
  EXPECT_FALSE(report.junction.empty());
  EXPECT_GE(report.quality.min, scene.min_q);
  EXPECT_GE(report.quality.mean, scene.mean_q);

  const Model result = apply(scene.base, scene.parts, *merged);
  scenes::expect_sound(result);

  // No group appears or vanishes, and what it covers stays as large.
  std::map<std::string, double> before;
  const auto add = [&](const Model& model) {
    for (const Group& g : model.groups) before.try_emplace(g.name, 0.0);
    for (const auto& [name, area] : scenes::area_by_group(model)) before[name] += area;
  };
  add(scene.base);
  for (const Model& part : scene.parts) add(part);
  EXPECT_EQ(result.groups.size(), before.size());
  auto after = scenes::area_by_group(result);
  for (const auto& [name, area] : before) EXPECT_NEAR(after[name], area, 0.01 * area) << name;
}

INSTANTIATE_TEST_SUITE_P(Scenes, Catalogue, testing::Range(std::size_t{0}, all_scenes().size()),
                         [](const auto& scene) { return all_scenes()[scene.param].name; });

}  // namespace
}  // namespace meshgraft
