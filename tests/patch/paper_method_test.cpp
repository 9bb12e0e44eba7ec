// The paper's method as a whole, by way of merges.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "geometry/quality.hpp"
#include "meshgraft/check.hpp"
#include "meshgraft/merge.hpp"
#include "support/catalogue.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

/// Scenes in which parts cross or touch the base; the paper gives no way for those that lie on each other.
const std::vector<scenes::Merge>& all_scenes() {
  static const std::vector<scenes::Merge> all = scenes::catalogue();
  return all;
}

class PaperMethod : public testing::TestWithParam<std::size_t> {};

/// The poor quality of single faces is the method's own; everything else must hold as for every merge.
std::vector<std::string> promises_beside_quality(const Report& report) {
  std::vector<std::string> broken;
  for (const Error& e : report.broken_promises)
    if (e.what.find("Q below") == std::string::npos) broken.push_back(to_string(e));
  return broken;
}

TEST_P(PaperMethod, GivesASoundMeshWithAllGroups) {
  const scenes::Merge& scene = all_scenes()[GetParam()];
  if (scene.apart) return;
  MergeOptions options = scene.options;
  options.method = Method::kPaper;
  const auto merged = merge(scene.base, scene.parts, options);
  ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
  EXPECT_EQ(promises_beside_quality(merged->report), std::vector<std::string>{});
  const Model result = apply(scene.base, scene.parts, *merged);
  EXPECT_TRUE(check(result).sound());
  EXPECT_EQ(check(result).n_orphan_nodes, 0u);
  EXPECT_EQ(check(result).n_coincident_nodes, 0u);
  const bool missed = merged->report.quality.below > 0;
  EXPECT_EQ(missed, merged->report.quality.min < options.min_quality);

  const auto again = merge(scene.base, scene.parts, options);
  const auto same = [](const NewElement& a, const NewElement& b) { return a.nodes == b.nodes && a.parent == b.parent; };
  EXPECT_TRUE(std::ranges::equal(merged->graft.new_elements, again->graft.new_elements, same));
}

/// All of a sphere but a node is in the zone: no flat way reaches the contour of one node from anywhere.
TEST(PaperMethodAlone, AnAreaThatCannotBeFilledStaysAsItIsAndIsNamed) {
  const Model sphere = scenes::sphere({0, 0, 0}, 1, 2), plate = scenes::plate({-2, -2, -1}, {4, 0, 0}, {0, 4, 0}, 0.8);
  MergeOptions options;
  options.method = Method::kPaper, options.bandwidth = 6;
  const auto merged = merge(plate, std::span(&sphere, 1), options);
  ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
  EXPECT_EQ(std::ranges::count(merged->report.warnings, "contour-not-filled", &Warning::name), 1);
  const Model result = apply(plate, std::span(&sphere, 1), *merged);
  EXPECT_TRUE(check(result).sound());
  EXPECT_NEAR(check(result).area, check(plate).area + check(sphere).area, 1e-9);
}

/// A wall and a stiffener whose edges are a tenth of the distance from the origin, everywhere: the one in z = 0, the
/// other upright along a ray.
struct Graded {
  static constexpr double kShare = 0.1, kRay = 0.6;
  Model wall = scenes::moved(scenes::staggered_plate({0, 0, 0}, {1.5, 0, 0}, {0, 1.2, 0}, kShare), [](Vec3 p) {
    return std::exp(p.x) * Vec3{std::cos(p.y), std::sin(p.y), 0};
  });
  Model stiffener =
      scenes::moved(scenes::staggered_plate({0.2, -0.33, 0}, {1.1, 0, 0}, {0, 0.7, 0}, kShare, "PART"), [](Vec3 p) {
        return std::exp(p.x) * Vec3{std::cos(p.y) * std::cos(kRay), std::cos(p.y) * std::sin(kRay), std::sin(p.y)};
      });
};

TEST(PaperMethodAlone, TheDensityOfTheNewFacesIsThatOfTheSurroundingsFromPlaceToPlace) {
  const Graded g;
  MergeOptions options;
  options.method = Method::kPaper, options.bandwidth = 4;
  const auto merged = merge(g.wall, std::span(&g.stiffener, 1), options);
  ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
  const auto position = [&](NodeRef n) {
    if (n.input == kNew) return merged->graft.new_nodes[n.node.value].position;
    return (n.input == 0 ? g.wall : g.stiffener).position[n.node.value];
  };
  std::array<double, 3> area_sum{}, n_faces{};  // in squares of the distance; from there to 1.6 times as far
  for (const NewElement& e : merged->graft.new_elements) {
    if (e.parent.input != 0) continue;
    const Triangle t{position(e.nodes[0]), position(e.nodes[1]), position(e.nodes[2])};
    const double r = norm(centroid(t));
    const auto k = static_cast<std::size_t>(2 * std::log(r));
    area_sum.at(k) += area(t) / (r * r), ++n_faces.at(k);
  }
  for (std::size_t k = 0; k < n_faces.size(); ++k) {
    ASSERT_GT(n_faces[k], 20);
    const double edge = std::sqrt(4 / std::numbers::sqrt3 * area_sum[k] / n_faces[k]);  // of equilateral faces as large
    EXPECT_NEAR(edge, Graded::kShare, 0.25 * Graded::kShare) << "from " << std::exp(0.5 * static_cast<double>(k));
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, PaperMethod, testing::Range(std::size_t{0}, all_scenes().size()),
                         [](const auto& scene) { return all_scenes()[scene.param].name; });

}  // namespace
}  // namespace meshgraft
