// Several parts in one call, where one of them ends on another or lies on it, in every order.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "meshgraft/merge.hpp"
#include "scenes/expect.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

constexpr double kRadius = 30;

Model wall() { return scenes::staggered_plate({-120, -120, 0}, {240, 0, 0}, {0, 240, 0}, 10, "WALL", 0.15); }

/// From z = `low` up.
Model pipe(double low) { return scenes::cylinder({0, 0, low}, {0, 0, 60}, kRadius, 8, "PIPE"); }

/// Round, with a hole of `facets` sides as wide as the pipe.
Model pad(std::size_t facets, double height) {
  const auto at = [=](double u, double v) {
    const double a = 2 * std::numbers::pi * u + 0.13, r = std::lerp(kRadius, 66, v);
    return Vec3{r * std::cos(a), r * std::sin(a), height};
  };
  return scenes::surface({at, facets, 6, true, false, 0, 1, "PAD"});
}

struct Assembly {
  const char* name;
  Model wall, pipe, pad;
  Tolerance tolerance;
};

std::array<Assembly, 5> assemblies() {
  const Tolerance share{0.2, true}, half_a_plate{6, false};
  return {{{"through", wall(), pipe(-60), pad(28, 0), share},
           {"as many facets", wall(), pipe(-60), pad(24, 0), share},
           {"more facets", wall(), pipe(-60), pad(40, 0), share},
           {"ending", wall(), pipe(0), pad(28, 0), share},
           {"half a plate off", wall(), pipe(-60), pad(28, 5), half_a_plate}}};
}

void expect_joined(const Model& base, std::span<const Model> parts, const MergeOptions& options) {
  const auto merged = merge(base, parts, options);
  ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
  EXPECT_TRUE(merged->report.broken_promises.empty()) << scenes::first_problem(merged->report);
  EXPECT_GE(merged->report.quality.min, 0.5);
  for (const PolylineSummary& p : merged->report.junction) EXPECT_TRUE(p.closed) << p.length;
  EXPECT_EQ(merged->report.junction.size(), 2u);  // around the pipe, and around the pad
  if (options.overlap == Overlap::kFuse) scenes::expect_sound(apply(base, parts, *merged));
}

/// The rim of the hole, of facets of its own, is drawn onto the pipe, so that pad, wall and pipe meet in one line.
TEST(Assembly, APadEndsOnThePipeThroughItAndTheWall) {
  for (const Assembly& a : assemblies())
    for (const Overlap overlap : {Overlap::kFuse, Overlap::kProject, Overlap::kKeepPart}) {
      SCOPED_TRACE(testing::Message() << a.name << ", overlap " << static_cast<int>(overlap));
      MergeOptions options;
      options.tolerance = a.tolerance, options.overlap = overlap;
      expect_joined(a.wall, std::array{a.pipe, a.pad}, options);
      expect_joined(a.wall, std::array{a.pad, a.pipe}, options);
      expect_joined(a.pipe, std::array{a.wall, a.pad}, options);
    }
}

/// The rim of a base stays, and the facets of the pipe are drawn out to its corners. The wall that lies on the base
/// goes through them beside those corners once more as they were.
TEST(Assembly, APipeEndsOnTheRimOfAPadThatIsTheBase) {
  for (const std::size_t facets : {24u, 28u, 36u, 40u, 44u}) {
    SCOPED_TRACE(facets);
    MergeOptions options;
    options.tolerance = {0.2, true};
    expect_joined(pad(facets, 0), std::array{pipe(-60), wall()}, options);
    expect_joined(pad(facets, 0), std::array{wall(), pipe(-60)}, options);
  }
}

/// A vessel, a nozzle through it, and a saddle pad around that, half of both plates off.
TEST(Assembly, ASaddlePadEndsOnTheNozzleThroughIt) {
  const Model vessel = scenes::cylinder({-200, 0, 0}, {200, 0, 0}, 100, 10, "VESSEL");
  const Model nozzle = scenes::cylinder({0, 0, 60}, {0, 0, 180}, kRadius, 9, "NOZZLE");
  const auto on_saddle = [](double u, double v) {
    const double a = 2 * std::numbers::pi * u + 0.1, r = std::lerp(kRadius, 57, v), y = r * std::sin(a);
    return Vec3{r * std::cos(a), y, std::sqrt(106.0 * 106.0 - y * y)};
  };
  const Model saddle = scenes::surface({on_saddle, 24, 3, true, false, 0, 1, "PAD"});
  MergeOptions options;
  options.tolerance = {6.5, false};
  expect_joined(vessel, std::array{nozzle, saddle}, options);
  expect_joined(vessel, std::array{saddle, nozzle}, options);
  expect_joined(nozzle, std::array{vessel, saddle}, options);
}

/// Each node of the rim moves along the pad, and on to a node of the pipe that is within a tenth of the edge length.
TEST(Assembly, TheRimMovesAlongThePadAndNoFartherThanATenthOfTheEdgeLength) {
  const std::array parts{pipe(-60), pad(28, 0)};
  MergeOptions options;
  options.tolerance = {0.2, true};
  const auto merged = merge(wall(), parts, options);
  ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
  ASSERT_FALSE(merged->report.moved.empty());
  for (const MovedEntry& m : merged->report.moved) {
    EXPECT_EQ(m.input, 2u);
    EXPECT_NEAR(m.from.z, m.to.z, 1e-9);
    EXPECT_LT(m.distance, 0.8);
  }
}

/// Where halves of a mesh match node for node, a face at the seam may stay as it is though the zone of another junction
/// begins beside it: its free edge runs from a node that changed to one that the other half has.
TEST(Assembly, HalvesThatMatchAreRejoinedInEitherOrder) {
  constexpr double kSize = 0.1;
  const Model second = scenes::plate({0, 0, 0}, {1.5, 0, 0}, {0, 1, 0}, kSize, "SECOND");
  for (const double x : {0.43, 0.45, 0.47}) {
    SCOPED_TRACE(x);
    const Model first =
        scenes::together(std::array{scenes::plate({-1, 0, 0}, {1, 0, 0}, {0, 1, 0}, kSize, "FIRST"),
                                    scenes::plate({x, -0.2, -0.3}, {0, 1.4, 0}, {0, 0, 0.6}, kSize, "CROSSING")});
    for (const auto& [base, part] : {std::pair(&first, &second), std::pair(&second, &first)}) {
      const auto merged = merge(*base, std::span(part, 1), {});
      ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
      EXPECT_TRUE(merged->report.broken_promises.empty()) << scenes::first_problem(merged->report);
      scenes::expect_sound(apply(*base, std::span(part, 1), *merged));
    }
  }
}

}  // namespace
}  // namespace meshgraft
