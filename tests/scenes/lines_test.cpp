// Borders between groups and beams stay lines of the mesh: what ends or passes beside one within the tolerance is
// joined along it, as along a fold or a weld line.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <ostream>
#include <span>
#include <tuple>

#include "expect.hpp"
#include "geometry/quality.hpp"
#include "meshgraft/merge.hpp"
#include "support/scenes.hpp"

namespace meshgraft::scenes {
namespace {

constexpr double kSize = 0.1, kBeside = 1e-3 * kSize;
constexpr double kRounding = 1e-9;

enum class Line { kBorder, kBeams };

std::ostream& operator<<(std::ostream& out, Line line) { return out << (line == Line::kBorder ? "border" : "beams"); }

/// A square of side 2, with a line at y = 1.
Model wall(Line line) {
  const bool has_two_groups = line == Line::kBorder;
  const std::array<Model, 2> halves{staggered_plate({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, kSize, "SOUTH"),
                                    staggered_plate({0, 1, 0}, {2, 0, 0}, {0, 1, 0}, kSize, "NORTH")};
  const Model whole = welded(together(halves));
  if (has_two_groups) return whole;
  ModelBuilder builder = faces_of(whole);
  for (std::size_t e = 0; e < whole.n_elements(); ++e) {
    builder.add_to_group("WALL", ElementId(e));
    const auto nodes = whole.nodes_of(ElementId(e));
    for (std::size_t k = 0; k < 3; ++k) {
      const NodeId a = nodes[k], b = nodes[(k + 1) % 3];
      const bool is_on_line = whole.position[a.value].y == 1 && whole.position[b.value].y == 1;
      if (is_on_line && whole.position[a.value].x < whole.position[b.value].x) builder.add_line(a, b);
    }
  }
  return builder.build();
}

/// From `below` the wall.
Model web(double below) {
  return staggered_plate({0.33, 1 + kBeside, -below}, {1.2, 0, 0}, {0, 0, below + 0.4}, 0.09, "WEB", 0.15);
}

class WhatIsBesideALine : public testing::TestWithParam<std::tuple<Line, double>> {};

TEST_P(WhatIsBesideALine, IsJoinedAlongIt) {
  const auto [line, below] = GetParam();
  const Model base = wall(line), part = web(below);
  const auto merged = merge(base, std::span(&part, 1));
  ASSERT_TRUE(merged) << to_string(merged.error());
  EXPECT_EQ(first_problem(merged->report), "");
  EXPECT_GT(merged->report.quality.min, 0.5);
  const Model result = apply(base, std::span(&part, 1), *merged);
  expect_sound(result);
  for (const auto& [group, area] : area_by_group(base))
    EXPECT_NEAR(area_by_group(result).at(group), area, kRounding) << group;
  // The line is there once, with no strip beside it.
  for (const Vec3 p : result.position) EXPECT_TRUE(p.z != 0 || p.y == 1 || std::abs(p.y - 1) > 0.1 * kSize) << p.y;
}
INSTANTIATE_TEST_SUITE_P(Lines, WhatIsBesideALine,
                         testing::Combine(testing::Values(Line::kBorder, Line::kBeams), testing::Values(0, 0.31)));

/// A wall of which a corner is in a group of its own: the border turns at (1, 0.4).
Model wall_with_border() {
  const Model whole = scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, 0.1, "WALL");
  ModelBuilder builder;
  for (const Vec3 p : whole.position) builder.add_node(p);
  for (std::size_t e = 0; e < whole.n_elements(); ++e) {
    const auto v = whole.nodes_of(ElementId(e));
    const ElementId face = builder.add_face(v[0], v[1], v[2]);
    builder.add_to_group("WALL", face);
    const Vec3 c = centroid(whole.corners(ElementId(e)));
    if (c.x > 1 && c.y > 0.4) builder.add_to_group("THICK", face);
  }
  return builder.build();
}

/// The border turns right beside the place where the rim of the doubler crosses it, and runs along the rim from there:
/// a strip of 2 % of an edge, not a corner of one degree.
TEST(Lines, ABorderThatTurnsBesideACrossingLeavesAStripOfGoodFaces) {
  for (const double off : {0.0015, 0.0018, 0.0025}) {
    SCOPED_TRACE(off);
    const Model wall = wall_with_border(),
                doubler = scenes::plate({0.7013, 0.4 + off, 0}, {0.4, 0, 0}, {0, 0.3, 0}, 0.09, "DOUBLER");
    const auto merged = merge(wall, std::span(&doubler, 1));
    ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
    EXPECT_TRUE(merged->report.broken_promises.empty());
    EXPECT_GE(merged->report.quality.min, 0.5);
  }
}

}  // namespace
}  // namespace meshgraft::scenes
