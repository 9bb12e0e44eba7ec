// Parts that end a share of an edge length short of the base, or as far beyond it, are joined along their own surface.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/closest.hpp"
#include "meshgraft/merge.hpp"
#include "scenes/expect.hpp"
#include "support/catalogue.hpp"
#include "support/scenes.hpp"

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
  EXPECT_LE(report.fidelity->max_distance_relative, scene.max_off);

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

constexpr double kSize = 0.1;  // edge length of what parts end on

double uniform(double low, double high) {
  constexpr int kSteps = 1 << 20;
  return low + (high - low) * *rc::gen::inRange(0, kSteps + 1) / kSteps;
}

double distance_to(const Model& m, Vec3 p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t e = 0; e < m.n_elements(); ++e)
    least = std::min(least, distance(p, closest_on_triangle(p, m.corners(ElementId(e))).point));
  return least;
}

/// A stiffener whose foot comes nearer to a wall, or to a pipe, in some places than in others.
struct HalfReaching {
  Model base, part;
  std::vector<Vec3> foot;  // its nodes, in order
};

HalfReaching half_reaching(bool pipe) {
  const double lean = uniform(0.9, std::numbers::pi / 2), turn = uniform(0, 2 * std::numbers::pi);
  const double gap = uniform(0.2, 0.6) * kSize, rise = uniform(0, 0.2) * kSize, bow = uniform(-0.3, 0.3) * kSize;
  const double size = *rc::gen::element(0.8, 1.0, 1.3, 2.0) * kSize;
  const double askew = pipe ? uniform(-0.3, 0.3) : 0, length = pipe ? 0.8 : 1.2, radius = 0.7;
  const Vec3 out = pipe ? Vec3{std::cos(turn), std::sin(turn), 0} : Vec3{0, 0, 1};
  const Vec3 around = pipe ? Vec3{-out.y, out.x, 0} : Vec3{std::cos(turn), std::sin(turn), 0};
  const Vec3 along = pipe ? std::sin(askew) * around + Vec3{0, 0, std::cos(askew)} : around;
  const Vec3 up = std::sin(lean) * out + std::cos(lean) * cross(out, along);
  const Vec3 middle = pipe ? radius * out + Vec3{0, 0, 1} : Vec3{1, 1, 0};
  const auto foot_at = [&](double x) {
    const double t = x / length - 0.5;
    return middle + (x - 0.5 * length) * along + ((gap + rise * t + bow * t * t) / std::sin(lean)) * up;
  };
  HalfReaching s;
  s.base = pipe ? scenes::cylinder({0, 0, 0}, {0, 0, 2}, radius, kSize, "PIPE")
                : scenes::staggered_plate({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, kSize, "WALL", 0.15);
  const Model flat = scenes::staggered_plate({0, 0, 0}, {length, 0, 0}, {0, 0.4, 0}, size, "STIFFENER", 0.1);
  s.part = scenes::moved(flat, [&](Vec3 p) { return foot_at(p.x) + p.y * up; });
  std::vector<double> x;
  for (const Vec3 p : flat.position)
    if (p.y == 0) x.push_back(p.x);
  std::ranges::sort(x);
  for (const double along_foot : x) s.foot.push_back(foot_at(along_foot));
  return s;
}

void joins_what_is_in_reach(bool pipe) {
  const bool held = rc::check([=] {
    const HalfReaching s = half_reaching(pipe);
    std::vector<double> gap;
    for (const Vec3 p : s.foot) gap.push_back(distance_to(s.base, p));
    const auto [low, high] = std::ranges::minmax(gap);
    MergeOptions options;
    options.tolerance = {uniform(low, high), false};
    double length = 0;
    for (std::size_t k = 1; k < gap.size(); ++k)
      if (std::max(gap[k - 1], gap[k]) <= options.tolerance.value) length += distance(s.foot[k - 1], s.foot[k]);
    options.allow_apart = true;
    const auto merged = merge(s.base, std::span(&s.part, 1), options);
    if (!merged) RC_FAIL(to_string(merged.error()));
    const Report& report = merged->report;
    for (const Error& e : report.broken_promises) RC_LOG() << to_string(e) << '\n';
    RC_ASSERT(report.broken_promises.empty());
    double joined = 0;
    for (const PolylineSummary& p : report.junction) joined += p.length;
    RC_LOG() << "length " << length << " joined " << joined << " tolerance " << options.tolerance.value << '\n';
    RC_ASSERT(std::abs(joined - length) <= 0.03 * length + 0.1 * kSize);
    const auto says_so = [](const Warning& w) { return w.name == "partly-in-reach" || w.name == "parts-apart"; };
    RC_ASSERT(std::ranges::any_of(report.warnings, says_so));
    const Model result = apply(s.base, std::span(&s.part, 1), *merged);
    const CheckResult found = check(result);
    RC_ASSERT(found.sound());
    // The part goes on in its own plane, also where the extended piece ends; nodes of a pipe pull it a little.
    const double off_plane = (pipe ? 0.02 : 1e-3) * kSize;
    const Vec3 n = normalized(cross(s.foot.back() - s.foot.front(), s.part.position.back() - s.foot.front()));
    for (std::size_t e = 0; e < result.n_elements(); ++e)
      for (const GroupId g : result.group_sets.members(result.element_groups[e]))
        if (result.groups[g.value].name == "STIFFENER")
          for (const Vec3 p : result.corners(ElementId(e)))
            RC_ASSERT(std::abs(dot(n, p - s.foot.front())) <= off_plane);
  });
  EXPECT_TRUE(held);
}

TEST(GapsInPart, AFootIsJoinedToAWallAsFarAsItIsInReach) { joins_what_is_in_reach(false); }
TEST(GapsInPart, AFootIsJoinedToAPipeAsFarAsItIsInReach) { joins_what_is_in_reach(true); }

/// The slope leaves the wall at an acute tip: it is not to be joined with it, although its last edge is in reach.
TEST(GapsInPart, AGussetWithAnAcuteTipEndsOnTheWallWithItsUprightEdgeOnly) {
  const Model wall = scenes::staggered_plate({0, -1, -0.5}, {0, 2, 0}, {0, 0, 2}, kSize, "WALL");
  constexpr double kHeight = 1.0;
  for (const double beside : {-0.04, -0.02, 0.02, 0.04}) {  // of the wall
    SCOPED_TRACE(beside);
    const Model part = scenes::triangle_plate({beside, 0.013, 0}, {0.5 * kHeight, 0, 0}, {0, 0, kHeight}, 8);
    MergeOptions options;
    options.tolerance = {0.06, false};
    const auto merged = merge(wall, std::span(&part, 1), options);
    ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
    EXPECT_TRUE(merged->report.broken_promises.empty()) << scenes::first_problem(merged->report);
    for (const Warning& w : merged->report.warnings) ADD_FAILURE() << to_string(w);
    EXPECT_GE(merged->report.quality.min, 0.5);
    ASSERT_EQ(merged->report.junction.size(), 1u);
    EXPECT_NEAR(merged->report.junction[0].length, kHeight + 2 * beside, 1e-6);  // the slope goes on straight
    const Model result = apply(wall, std::span(&part, 1), *merged);
    scenes::expect_sound(result);
    const double bent = 0.02 * kHeight * kHeight;
    EXPECT_NEAR(scenes::area_by_group(result).at("GUSSET"), (0.5 * kHeight + beside) * (0.5 * kHeight + beside), bent);
  }
}

Model tube(std::size_t around, std::size_t along, const std::string& group,
           const std::function<Vec3(double, double)>& at) {
  return scenes::surface(
      {[&](double u, double v) { return at(2 * std::numbers::pi * u, v); }, around, along, true, false, 0, 1, group});
}

TEST(GapsInPart, ANozzleWhoseRimIsFinerThanItsFacesIsJoinedWithAsCoarseACurve) {
  const double r = 50, nozzle = r / 2;
  const Model base = tube(40, 30, "SHELL", [&](double a, double t) {
    return Vec3{r * std::cos(a), r * std::sin(a), 400 * t - 200};
  });
  const Model part = tube(32, 12, "NOZZLE", [&](double a, double t) {
    const Vec3 rim{0, nozzle * std::cos(a), nozzle * std::sin(a)};
    return rim + Vec3{std::lerp(std::sqrt(r * r - rim.y * rim.y), 4 * r, t), 0, 0};
  });
  MergeOptions options;
  options.tolerance = {0.05, true};
  const auto merged = merge(base, std::span(&part, 1), options);
  ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
  EXPECT_TRUE(merged->report.broken_promises.empty()) << scenes::first_problem(merged->report);
  ASSERT_EQ(merged->report.junction.size(), 1u);
  EXPECT_TRUE(merged->report.junction[0].closed);
  scenes::expect_sound(apply(base, std::span(&part, 1), *merged));
}

}  // namespace
}  // namespace meshgraft
