// Bolts, nuts and holes of four sides, as a coarse mesher leaves them: facets lean to each other by up to the angle
// between two sides, and stand off each other by up to the sagitta of one.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "geometry/angles.hpp"
#include "meshgraft/merge.hpp"
#include "scenes/expect.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

constexpr double kRadius = 5;
const double kSagitta = kRadius * (1 - std::cos(std::numbers::pi / 4));  // of one side: 1.464

/// In eighths of the circle, so that what shall be in one place is, up to the last bit.
Vec3 around(double r, std::size_t eighth, double z, double turned = 0) {
  const double a = std::numbers::pi / 4 * static_cast<double>(eighth % 8) + turned;
  return {r * std::cos(a), r * std::sin(a), z};
}

/// A wall of four sides with a row of four nodes at each height, each turned by half a side against the one before.
Model wall(const std::vector<double>& heights, const std::string& group, double turned = 0) {
  ModelBuilder builder;
  std::vector<std::array<NodeId, 4>> row;
  for (std::size_t j = 0; j < heights.size(); ++j) {
    row.emplace_back();
    for (std::size_t i = 0; i < 4; ++i) row[j][i] = builder.add_node(around(kRadius, 2 * i + j, heights[j], turned));
  }
  for (std::size_t j = 1; j < row.size(); ++j)
    for (std::size_t i = 0; i < 4; ++i) {
      const NodeId a = row[j - 1][i], b = row[j - 1][(i + 1) % 4], c = row[j][i], d = row[j][(i + 1) % 4];
      builder.add_to_group(group, builder.add_face(a, b, c));
      builder.add_to_group(group, builder.add_face(c, b, d));
    }
  return builder.build(group);
}

/// Plane, around the rim of such a wall.
Model cap(double z, double outer, std::size_t across) {
  ModelBuilder builder;
  std::vector<std::array<NodeId, 4>> row;
  for (std::size_t j = 0; j <= across; ++j) {
    row.emplace_back();
    const double r = std::lerp(kRadius, outer, static_cast<double>(j) / static_cast<double>(across));
    for (std::size_t i = 0; i < 4; ++i) row[j][i] = builder.add_node(around(r, 2 * i, z));
  }
  for (std::size_t j = 1; j < row.size(); ++j)
    for (std::size_t i = 0; i < 4; ++i) {
      const NodeId a = row[j - 1][i], b = row[j - 1][(i + 1) % 4], c = row[j][i], d = row[j][(i + 1) % 4];
      builder.add_to_group("CAP", builder.add_face(a, c, d));
      builder.add_to_group("CAP", builder.add_face(a, d, b));
    }
  return builder.build("cap");
}

struct Row {
  double height;
  std::size_t n;    // nodes: 4 or 8
  double skew = 0;  // radians by which those of the corners are off these
};

/// A wall with nodes at its four corners, and between them where a row has eight.
Model straight_wall(const std::vector<Row>& rows, const std::function<std::string(Vec3)>& group) {
  ModelBuilder builder;
  std::vector<std::vector<NodeId>> row;
  std::vector<std::vector<Vec3>> at;
  for (const Row& r : rows) {
    row.emplace_back(), at.emplace_back();
    for (std::size_t i = 0; i < r.n; ++i) {
      const bool is_corner = i % (r.n / 4) == 0;
      at.back().push_back(around(kRadius, i * (8 / r.n), r.height, is_corner ? r.skew : 0));
      row.back().push_back(builder.add_node(at.back().back()));
    }
  }
  for (std::size_t j = 1; j < row.size(); ++j) {
    const auto face = [&](const std::array<std::size_t, 3>& above, const std::array<std::size_t, 3>& i) {
      std::array<NodeId, 3> f;
      Vec3 sum;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t r = j - 1 + above[k], at_k = i[k] % row[r].size();
        f[k] = row[r][at_k], sum += at[r][at_k];
      }
      builder.add_to_group(group(sum), builder.add_face(f[0], f[1], f[2]));
    };
    const std::size_t below = row[j - 1].size() / 4, above = row[j].size() / 4;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t a = i * below, b = (i + 1) * below, c = i * above, d = (i + 1) * above;
      if (below == above) {
        for (std::size_t k = 0; k < below; ++k)
          face({0, 0, 1}, {a + k, a + k + 1, c + k}), face({1, 0, 1}, {c + k, a + k + 1, c + k + 1});
      } else if (above == 2) {
        face({0, 1, 1}, {a, c + 1, c}), face({0, 0, 1}, {a, b, c + 1}), face({0, 1, 1}, {b, d, c + 1});
      } else {
        face({1, 0, 0}, {c, a, a + 1}), face({1, 0, 1}, {c, a + 1, d}), face({1, 0, 0}, {d, a + 1, b});
      }
    }
  }
  return builder.build("straight wall");
}

std::string halves(Vec3 at) { return at.y > 0 ? "LEFT" : "RIGHT"; }

/// With two groups that meet in two of its folds.
Model square_bolt(const std::vector<double>& heights) {
  std::vector<Row> rows;
  for (const double z : heights) rows.push_back({z, 4});
  return straight_wall(rows, halves);
}

/// Of the same groups. In the middle of its wall nodes stand between the corners, and those of the corners beside them.
Model skew_hole(double from, double to, double outer, std::size_t across, double skew) {
  const std::array<Model, 3> all{cap(from, outer, across),
                                 straight_wall({{from, 4}, {0.5 * (from + to), 8, skew}, {to, 4}}, halves),
                                 cap(to, outer, across)};
  return scenes::welded(scenes::together(all));
}

Model flange(double depth, double outer, std::size_t across, const std::string& group) {
  const std::array<Model, 2> both{cap(0, outer, across), wall({0, 0.5 * depth, depth}, group)};
  return scenes::welded(scenes::together(both));
}

/// 12 thick.
Model drilled_plate() {
  const std::array<Model, 3> all{cap(0, 20, 3), wall({0, 6, 12}, "HOLE"), cap(12, 20, 3)};
  return scenes::welded(scenes::together(all));
}

/// Lies on the plate.
Model nut(std::size_t across) {
  const std::array<Model, 3> all{cap(12, 10, across), wall({12, 15, 18}, "NUT"), cap(18, 10, across)};
  return scenes::welded(scenes::together(all));
}

void expect_merged(const Model& base, std::span<const Model> parts) {
  MergeOptions options;
  options.tolerance = {0.99 * kSagitta, false};
  options.contact_angle = radians(50);
  const auto merged = merge(base, parts, options);
  ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
  EXPECT_TRUE(merged->report.broken_promises.empty()) << scenes::first_problem(merged->report);
  EXPECT_FALSE(merged->report.overlaps.empty());
  scenes::expect_sound(apply(base, parts, *merged));
}
void expect_merged(const Model& base, const Model& part) { expect_merged(base, std::span(&part, 1)); }

/// Facets of the wall lean over the plate around the hole, within the tolerance: they abut all the same.
TEST(CoarseContact, WallsOfFourSidesThatAbutAreNoContactWhereTheirPlatesAre) {
  expect_merged(flange(-10, 20, 3, "LOWER"), flange(3, 14, 2, "UPPER"));
  expect_merged(flange(-10, 20, 3, "LOWER"), flange(3.2, 14, 2, "UPPER"));
}

/// Nodes of the one are over the middle of a facet of the other, and edges over edges at any angle.
TEST(CoarseContact, ABoltOfFourSidesIsOneWithTheWallOfItsHole) {
  expect_merged(drilled_plate(), wall({-4, 4.5, 13, 21.5, 30}, "BOLT"));
  expect_merged(drilled_plate(), wall({-4, 4.5, 13, 21.5, 30}, "BOLT", radians(20)));
  expect_merged(drilled_plate(), wall({-6, 2, 10, 18, 26}, "BOLT"));
  expect_merged(drilled_plate(), wall({-6, 2, 10, 18, 26}, "BOLT", radians(45)));
  expect_merged(drilled_plate(), wall({-4, 3, 9, 16, 23, 30}, "BOLT"));
}

TEST(CoarseContact, ABoltIsOneWithPlateAndNutInOneCall) {
  for (const double turned : {0.0, radians(20), radians(45)})
    for (const std::size_t across : {2u, 3u}) {
      SCOPED_TRACE(testing::Message() << turned << ' ' << across);
      const Model bolt = wall({-4, 4.5, 13, 21.5, 30}, "BOLT", turned);
      expect_merged(drilled_plate(), std::array{bolt, nut(across)});
      expect_merged(drilled_plate(), std::array{nut(across), bolt});
    }
}

/// The plate goes on beside the face of the nut that it was fused with: where no good faces fit, it gives way there,
/// too.
TEST(CoarseContact, APlateThatLiesOnANutIsRemeshedBesideIt) {
  for (const double turned : {0.0, radians(20)})
    for (const std::size_t across : {2u, 3u}) {
      SCOPED_TRACE(testing::Message() << turned << ' ' << across);
      expect_merged(nut(across), std::array{drilled_plate(), wall({-4, 4.5, 13, 21.5, 30}, "BOLT", turned)});
    }
  expect_merged(nut(2), std::array{drilled_plate(), wall({-4, 7, 18}, "BOLT")});
}

/// The folds of the hole are flatter than what counts as a fold where meshes lie on each other at that angle; they are
/// lines of its surface all the same, and those of the bolt beside them left strips of no width to them; so did the
/// border of groups in the hole beside folds of the bolt.
TEST(CoarseContact, FoldsOfABoltBesideThoseOfItsHoleAreOneWithThem) {
  for (const double degrees : {-1.0, 0.5, 2.0}) {
    SCOPED_TRACE(degrees);
    const Model hole = skew_hole(0, 10, 20, 3, radians(degrees)), on_it = skew_hole(10, 13, 12, 2, 0);
    expect_merged(hole, square_bolt({-8, 1, 9, 18}));
    expect_merged(hole, std::array{square_bolt({-8, 1, 9, 18}), on_it});
    expect_merged(on_it, std::array{square_bolt({-7, -1.3, 7.2, 15, 23}), hole});
    expect_merged(square_bolt({-7, -1.3, 7.2, 15, 23}), hole);
    expect_merged(square_bolt({-8, 1, 9, 18}), hole);
  }
}

/// The rim of the hole ends on folds of the bolt: the sides beyond these face along it.
TEST(CoarseContact, TheRimOfAHoleIsFollowedFromFoldToFold) {
  for (const double degrees : {-1.0, 0.0, 1.0, 2.0}) {
    SCOPED_TRACE(degrees);
    expect_merged(skew_hole(0, 10, 20, 3, radians(degrees)), square_bolt({-4, 4, 12, 20}));
  }
}

/// The length or angle after an option in a hint.
double advised(const std::string& hint, const std::string& option) {
  return std::stod(hint.substr(hint.find(option) + option.size()));
}

TEST(CoarseContact, TheOptionsThatARefusalNamesMakeOneOfBoth) {
  for (const double turned : {0.0, radians(20)}) {
    const Model base = drilled_plate(), part = wall({-4, 4.5, 13, 21.5, 30}, "BOLT", turned);
    MergeOptions options;
    const auto refused = merge(base, std::span(&part, 1), options);
    ASSERT_FALSE(refused.has_value());
    const std::string hint = refused.error().hint;
    ASSERT_NE(hint.find("--tolerance"), std::string::npos) << hint;
    options.tolerance = {advised(hint, "--tolerance "), false};
    options.contact_angle = radians(advised(hint, "--angle "));
    const auto merged = merge(base, std::span(&part, 1), options);
    ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
    EXPECT_TRUE(merged->report.broken_promises.empty()) << scenes::first_problem(merged->report);
    scenes::expect_sound(apply(base, std::span(&part, 1), *merged));
  }
}

/// A wall as above with a lining inside, turned over at its upper rim: two sides of one mesh, `depth` apart at the
/// corners.
Model lined_wall(const std::vector<double>& heights, double depth) {
  ModelBuilder builder;
  std::vector<std::array<NodeId, 4>> row;
  const std::size_t n = heights.size();
  for (std::size_t j = 0; j < 2 * n; ++j) {
    row.emplace_back();
    const std::size_t at = j < n ? j : 2 * n - 1 - j;
    for (std::size_t i = 0; i < 4; ++i)
      row[j][i] = builder.add_node(around(j < n ? kRadius : kRadius - depth, 2 * i + at, heights[at]));
  }
  for (std::size_t j = 1; j < row.size(); ++j)
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t next = (i + 1) % 4;
      if (j <= n)
        builder.add_face(row[j - 1][i], row[j - 1][next], row[j][i]),
            builder.add_face(row[j][i], row[j - 1][next], row[j][next]);
      else
        builder.add_face(row[j - 1][i], row[j - 1][next], row[j][next]),
            builder.add_face(row[j - 1][i], row[j][next], row[j][i]);
    }
  return builder.build("BOLT");
}

TEST(CoarseContact, ARefusalNamesNoOptionsThatWouldWeldTwoSidesOfOneMesh) {
  const Model base = drilled_plate(), part = lined_wall({-4, 4.5, 13, 21.5, 30}, 0.6);
  const auto refused = merge(base, std::span(&part, 1));
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().hint.find("lay them on each other"), std::string::npos) << to_string(refused.error());
  EXPECT_NE(refused.error().hint.find("weld two sides of one mesh"), std::string::npos) << to_string(refused.error());
}

/// The two sides are near the plate only with the tolerance that would be named.
TEST(CoarseContact, NorTwoSidesThatOnlyTheseOptionsBringNear) {
  const std::array<Model, 3> pieces{wall({-4, 4.5, 13, 21.5, 30}, "BOLT"),
                                    scenes::plate({6, -4, 12.4}, {3, 0, 0}, {0, 8, 0}, 2),
                                    scenes::plate({6, -4, 12.8}, {3, 0, 0}, {0, 8, 0}, 2)};
  const Model base = drilled_plate(), part = scenes::together(pieces);
  const auto refused = merge(base, std::span(&part, 1));
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().hint.find("lay them on each other"), std::string::npos) << to_string(refused.error());
  EXPECT_NE(refused.error().hint.find("weld two sides of one mesh"), std::string::npos) << to_string(refused.error());
}

}  // namespace
}  // namespace meshgraft
