// Every scene of the catalogue merges, and keeps the promises.
#include "support/catalogue.hpp"

#include <gtest/gtest.h>

#include <map>

#include "meshgraft/check.hpp"
#include "meshgraft/merge.hpp"

namespace meshgraft {
namespace {

const std::vector<scenes::Merge>& all_scenes() {
  static const std::vector<scenes::Merge> all = scenes::catalogue();
  return all;
}

class Catalogue : public testing::TestWithParam<std::size_t> {};

std::string first_problem(const Report& report) {
  return report.broken_promises.empty() ? "" : to_string(report.broken_promises.front());
}

double area_of_group(const Model& model, const std::string& name) {
  double sum = 0;
  for (std::size_t e = 0; e < model.n_elements(); ++e) {
    const ElementId id(e);
    if (!model.is_face(id)) continue;
    for (const GroupId g : model.group_sets.members(model.element_groups[e]))
      if (model.groups[g.value].name == name) {
        const auto t = model.corners(id);
        sum += 0.5 * norm(cross(t[1] - t[0], t[2] - t[0]));
      }
  }
  return sum;
}

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
  EXPECT_TRUE(report.broken_promises.empty()) << first_problem(report);
  EXPECT_FALSE(report.junction.empty());
  EXPECT_GE(report.quality.min, scene.min_q);
  EXPECT_GE(report.quality.mean, scene.mean_q);

  const Model result = apply(scene.base, scene.parts, *merged);
  const CheckResult check = meshgraft::check(result);
  EXPECT_TRUE(check.sound()) << check.intersections << " intersections, " << check.degenerate_faces.size()
                             << " degenerate, " << check.duplicate_faces.size() << " duplicate";
  EXPECT_EQ(check.n_orphan_nodes, 0u);
  EXPECT_EQ(check.n_coincident_nodes, 0u);

  // No group appears or vanishes, and what it covers stays as large.
  std::map<std::string, double> before;
  for (const Group& g : scene.base.groups) before[g.name] += area_of_group(scene.base, g.name);
  for (const Model& part : scene.parts)
    for (const Group& g : part.groups) before[g.name] += area_of_group(part, g.name);
  EXPECT_EQ(result.groups.size(), before.size());
  for (const auto& [name, area] : before) EXPECT_NEAR(area_of_group(result, name), area, 0.01 * area) << name;
}

INSTANTIATE_TEST_SUITE_P(Scenes, Catalogue, testing::Range(std::size_t{0}, all_scenes().size()),
                         [](const auto& scene) { return all_scenes()[scene.param].name; });

}  // namespace
}  // namespace meshgraft
