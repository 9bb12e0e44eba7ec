// Modes and stresses of different meshes beside each other.
#include "compare.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "support/scenes.hpp"

namespace meshgraft::validation {
namespace {

Structure structure_of(const Model& model) {
  Structure s;
  s.position = model.position;
  for (std::size_t e = 0; e < model.n_elements(); ++e) {
    const auto v = model.nodes_of(ElementId(e));
    s.faces.push_back({v[0].value, v[1].value, v[2].value});
  }
  s.thickness.assign(s.faces.size(), 5);
  return s;
}

Structure plate(double size) {
  return structure_of(scenes::staggered_plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, size, "P", 0.15));
}

/// Half waves of a simply supported plate.
std::vector<Vec3> waves(const Structure& s, int along_x, int along_y) {
  std::vector<Vec3> field;
  for (const Vec3 p : s.position)
    field.push_back({0, 0, std::sin(along_x * std::numbers::pi * p.x) * std::sin(along_y * std::numbers::pi * p.y)});
  return field;
}

TEST(Interpolation, CarriesLinearFieldsExactly) {
  const Structure fine = plate(0.03), coarse = plate(0.11);
  const auto linear = [](Vec3 p) { return Vec3{1 + p.x, 2 * p.y - p.x, 3 * p.y}; };
  std::vector<Vec3> field;
  for (const Vec3 p : fine.position) field.push_back(linear(p));
  const auto carried = Interpolation(fine, coarse)(field);
  for (std::size_t n = 0; n < carried.size(); ++n) EXPECT_LT(distance(carried[n], linear(coarse.position[n])), 1e-12);
}

TEST(Mac, IsOneForTheSameShapeOfAnyScale) {
  const Structure fine = plate(0.03), coarse = plate(0.07);
  auto carried = Interpolation(fine, coarse)(waves(fine, 2, 1));
  for (Vec3& u : carried) u *= -3.5;
  EXPECT_GT(mac(coarse, carried, waves(coarse, 2, 1)), 0.999);
}

TEST(Mac, IsZeroForOtherModesWhateverTheDensityOfNodes) {
  // Nodes crowd at x = 0: unweighted, these shapes would not be orthogonal.
  const Structure s =
      structure_of(scenes::moved(scenes::staggered_plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.03), [](Vec3 p) {
        return Vec3{p.x * p.x, p.y, 0};
      }));
  EXPECT_LT(mac(s, waves(s, 1, 1), waves(s, 2, 1)), 1e-3);
}

TEST(SpannedShare, IsWholeForModesThatMixAndNothingForOneThatIsNotThere) {
  const Structure s = plate(0.07);
  const auto a = waves(s, 1, 1), b = waves(s, 2, 1);
  std::vector<Vec3> sum, difference;
  for (std::size_t n = 0; n < a.size(); ++n) sum.push_back(a[n] + b[n]), difference.push_back(a[n] - b[n]);
  EXPECT_NEAR(mac(s, a, sum), 0.5, 0.01);
  EXPECT_NEAR(spanned_share(s, a, {sum, difference}), 1, 1e-9);
  EXPECT_LT(spanned_share(s, waves(s, 1, 2), {sum, difference}), 0.01);
}

TEST(PairedModes, FollowAChangeOfOrderAndNeverTakeOneTwice) {
  const Structure s = plate(0.07);
  const std::array<std::array<int, 2>, 3> modes{{{1, 1}, {2, 1}, {1, 2}}};
  std::vector<std::vector<Vec3>> reference, other;
  for (const auto& [x, y] : modes) reference.push_back(waves(s, x, y));
  for (const std::size_t k : {2, 0, 1}) other.push_back(reference[k]);
  const auto pairs = paired_modes(s, reference, other);
  EXPECT_EQ(pairs[0].mode, 1U);
  EXPECT_EQ(pairs[1].mode, 2U);
  EXPECT_EQ(pairs[2].mode, 0U);

  other[1] = reference[1];  // (1, 1) is lost: its only neighbour left is unlike it
  EXPECT_LT(paired_modes(s, reference, other)[0].mac, 0.01);
}

std::vector<std::uint32_t> all_faces(const Structure& s) {
  std::vector<std::uint32_t> faces(s.faces.size());
  std::iota(faces.begin(), faces.end(), 0U);
  return faces;
}

TEST(SamplePoints, AreAwayFromFoldsAndHeldEdgesButNotFromFlatEdges) {
  const std::array pieces{scenes::staggered_plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.1, "WALL"),
                          scenes::staggered_plate({0, 0, 0}, {1, 0, 0}, {0, 0, 1}, 0.1, "SIDE")};
  Structure s = structure_of(scenes::welded(scenes::together(pieces)));
  for (std::uint32_t n = 0; n < s.position.size(); ++n)
    if (s.position[n].x == 0) s.clamped.push_back(n);
  constexpr double kMargin = 0.2571;  // of no centroid
  const auto points = sample_points(s, all_faces(s), kMargin);
  std::vector<Vec3> expected, found;
  for (std::size_t f = 0; f < s.faces.size(); ++f)
    if (const Vec3 p = centroid(s.corners(f)); std::max(p.y, p.z) >= kMargin && p.x >= kMargin) expected.push_back(p);
  for (const SamplePoint& p : points) found.push_back(p.at);
  EXPECT_EQ(found, expected);
}

TEST(Sampled, IsTheSameOnOtherMeshesOfTheSamePlate) {
  const Structure fine = plate(0.02), coarse = plate(0.05);
  const auto linear = [](const Structure& s) {
    std::vector<double> field;
    for (std::size_t f = 0; f < s.faces.size(); ++f) field.push_back(3 + centroid(s.corners(f)).x);
    return field;
  };
  const auto points = sample_points(fine, all_faces(fine), 0.1);
  const auto on_fine = sampled(fine, all_faces(fine), linear(fine), points);
  const auto on_coarse = sampled(coarse, all_faces(coarse), linear(coarse), points);
  for (std::size_t k = 0; k < points.size(); ++k) EXPECT_NEAR(on_fine[k], on_coarse[k], 0.02) << k;
}

TEST(Sampled, DoesNotMixPlatesOfDifferentThickness) {
  Structure s = plate(0.1);
  std::vector<double> field;
  for (std::size_t f = 0; f < s.faces.size(); ++f) {
    const bool thick = centroid(s.corners(f)).x > 0.5;
    s.thickness[f] = thick ? 8 : 5;
    field.push_back(thick ? 1 : 2);
  }
  const auto points = sample_points(s, all_faces(s), 0.1);
  const auto values = sampled(s, all_faces(s), field, points);
  for (std::size_t k = 0; k < points.size(); ++k) EXPECT_NEAR(values[k], points[k].thickness > 6 ? 1 : 2, 1e-12);
}

TEST(StressSummary, LeavesOutFivePercentOfTheArea) {
  std::vector<SamplePoint> points(100);
  std::vector<double> stress;
  for (std::size_t k = 0; k < points.size(); ++k) {
    points[k].area = 2;
    stress.push_back(static_cast<double>((37 * k) % 100 + 1));
  }
  EXPECT_EQ(stress_summary(points, stress).p95, 95);
  EXPECT_EQ(stress_summary(points, stress).max, 100);
  // The place of the largest stress stands for as much area as all others together.
  points[std::ranges::find(stress, 100) - stress.begin()].area = 198;
  EXPECT_EQ(stress_summary(points, stress).p95, 100);
}

}  // namespace
}  // namespace meshgraft::validation
