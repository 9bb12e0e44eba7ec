// A nozzle in a vessel with a reinforcing pad around it and gussets on the pad, as mid-surfaces leave them: the pad off
// the vessel by up to a third of an edge, the gussets short of what they are welded to, or beyond it. The facets match
// nowhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "meshgraft/merge.hpp"
#include "scenes/expect.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

constexpr double kSize = 1;       // edge length of the vessel
constexpr double kOffPad = 0.3;   // the most by which the pad stands off it
constexpr double kRagged = 0.15;  // the most by which a gusset misses the nozzle or the pad
constexpr double kTolerance = 0.4;
constexpr double kLongest = 2 * kTolerance;  // way of a tip along its slope

std::size_t cells(double length, double size) { return static_cast<std::size_t>(std::lround(length / size)); }

/// A random one.
class Nozzle {
 public:
  explicit Nozzle(std::uint32_t seed) : random_(seed) {
    const double vessel = uniform(12, 18), length = 40, radius = uniform(3, 4.5), height = uniform(8, 10);
    const double outer = radius + uniform(3, 4), round = 2 * std::numbers::pi;
    base =
        scenes::surface({[&](double u, double v) {
                           return Vec3{length * (v - 0.5), vessel * std::sin(round * u), vessel * std::cos(round * u)};
                         },
                         cells(round * vessel, kSize), cells(length, kSize), true, false, 0.2, seed + 1, "VESSEL"});
    const double foot = std::sqrt(vessel * vessel - radius * radius) - uniform(1, 2);
    const double size = kSize / uniform(1, 2);
    parts.push_back(scenes::surface(
        {[&](double u, double v) {
           return Vec3{radius * std::cos(round * u), radius * std::sin(round * u), std::lerp(foot, vessel + height, v)};
         },
         cells(round * radius, size), cells(vessel + height - foot, size), true, false, 0.15, seed + 2, "NOZZLE"}));
    const double on = vessel + uniform(0, kOffPad);
    parts.push_back(scenes::surface({[&](double u, double v) {
                                       const double r = std::lerp(radius, outer, v);
                                       const double a = r * std::sin(round * u) / on;
                                       return Vec3{r * std::cos(round * u), on * std::sin(a), on * std::cos(a)};
                                     },
                                     cells(round * outer, kSize), 4, true, false, 0, 0, "PAD"}));
    for (const double side : {1.0, -1.0}) {
      const double reach = outer - radius + uniform(-1, 1), rise = std::min(uniform(0.9, 2.3) * reach, 0.8 * height);
      const Vec3 corner{side * (radius + ragged()), 0.031, on + ragged()};
      parts.push_back(scenes::triangle_plate(corner, {side * reach, 0, 0}, {0, 0, rise},
                                             cells(reach, kSize / uniform(1, 1.6)), "GUSSET"));
      least_area += 0.5 * (reach - kLongest) * (rise - kLongest);
      most_area += 0.5 * (reach + kLongest) * (rise + kLongest);
    }
  }

  Model base;
  std::vector<Model> parts;
  double least_area = 0, most_area = 0;  // of both gussets, wherever they end

 private:
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(random_()) / static_cast<double>(std::mt19937::max());
  }
  double ragged() { return uniform(-kRagged, kRagged); }

  std::mt19937 random_;
};

class RandomNozzle : public testing::TestWithParam<std::uint32_t> {};

TEST_P(RandomNozzle, IsOneMeshWithoutPoorFaces) {
  const Nozzle nozzle(GetParam());
  MergeOptions options;
  options.tolerance = {kTolerance, false};
  const auto merged = merge(nozzle.base, nozzle.parts, options);
  ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
  EXPECT_TRUE(merged->report.broken_promises.empty()) << scenes::first_problem(merged->report);
  for (const Warning& w : merged->report.warnings) ADD_FAILURE() << to_string(w);
  EXPECT_GE(merged->report.quality.min, 0.5);
  const Model result = apply(nozzle.base, nozzle.parts, *merged);
  scenes::expect_sound(result);
  const double area = scenes::area_by_group(result).at("GUSSET");
  EXPECT_TRUE(area > nozzle.least_area && area < nozzle.most_area) << area;
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomNozzle, testing::Range(0u, 20u));

}  // namespace
}  // namespace meshgraft
