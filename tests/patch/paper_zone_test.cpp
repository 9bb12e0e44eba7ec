// How many neighbourhoods the paper deletes (5.4, figure 8).
#include "patch/paper_zone.hpp"

#include <gtest/gtest.h>

#include "remesh/cut.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

/// Two plates that cross at a right angle; y0 is where the line starts on the base.
Corefined crossing(double size, double part_size, double y0, double turn) {
  cut::Scene scene = cut::crossing(size, part_size, 90, y0, turn, 0);
  Corefined c;
  c.complex = std::move(scene.complex);
  c.junction_edges = std::move(scene.junction_edges);
  c.touched = std::move(scene.touched);
  c.met = {{0, 1}};
  return c;
}

TEST(PaperZone, TwoMeshesOfLikeDensityGiveTwoEachWhereTheLineRunsNearTheBoundary) {
  const Corefined c = crossing(0.1, 0.1, 0.96, 0);
  const PaperBandwidth b = paper_bandwidth(c, 0, 1);
  EXPECT_NEAR(b.l1a / b.l2a, 1, 0.2);
  EXPECT_GT(0.25 * (b.l1a + b.l2a), 1.5 * b.l_min);
  EXPECT_EQ(b.n1, 2);
  EXPECT_EQ(b.n2, 2);
  EXPECT_EQ(paper_zone(c).bandwidth, (std::vector<int>{2, 2}));
}

TEST(PaperZone, TwoMeshesOfLikeDensityGiveOneEachWhereTheLineRunsFarFromTheBoundary) {
  cut::Scene scene;
  cut::add(scene, scenes::plate({0, -0.05, 0}, {2, 0, 0}, {0, 1, 0}, 0.1), 0);
  cut::add(scene, scenes::plate({0, 0.5, -0.35}, {2, 0, 0}, {0, 0, 0.8}, 0.1), 1);
  const auto c = corefine(scene.complex, scene.groups, CorefineOptions{});
  ASSERT_TRUE(c.has_value());
  const PaperBandwidth b = paper_bandwidth(*c, 0, 1);
  EXPECT_NEAR(b.l_min, 0.05, 1e-9);  // midway between rows of edges, and l_a / 2 is 0.057
  EXPECT_EQ(b.n1, 1);
  EXPECT_EQ(b.n2, 1);
  const Zone zone = paper_zone(*c);
  EXPECT_EQ(zone.bandwidth, (std::vector<int>{1, 1}));
  EXPECT_EQ(zone.in_zone, c->touched);
}

TEST(PaperZone, TheFinerMeshIsDeletedAsManyTimesAsItIsFiner) {
  for (const auto& [size, part_size] : {std::pair{0.2, 0.05}, std::pair{0.05, 0.2}}) {
    const Corefined c = crossing(size, part_size, 0.96, 0);
    const PaperBandwidth b = paper_bandwidth(c, 0, 1);
    EXPECT_EQ(size > part_size ? b.n1 : b.n2, 1);
    EXPECT_EQ(size > part_size ? b.n2 : b.n1, 4);
  }
}

TEST(PaperZone, FacesBeyondTheNeighbourhoodsStay) {
  const Corefined c = crossing(0.1, 0.1, 0.96, 0.1);
  const Zone zone = paper_zone(c);
  for (std::size_t f = 0; f < zone.in_zone.size(); ++f) {
    if (c.touched[f] != 0) {
      EXPECT_TRUE(zone.in_zone[f]);
    }
    double nearest = 10;
    for (const Vec3 p : c.complex.corners(FaceId(f)))
      nearest = std::min(nearest, std::max(std::abs(p.y - 1), std::abs(p.z)));
    if (nearest > 0.5) {
      EXPECT_FALSE(zone.in_zone[f]);
    }
  }
}

}  // namespace
}  // namespace meshgraft
