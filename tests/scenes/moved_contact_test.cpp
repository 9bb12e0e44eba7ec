// What lies on each other does so wherever it is, and whatever rounding has done to it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "meshgraft/merge.hpp"
#include "scenes/expect.hpp"
#include "support/catalogue.hpp"
#include "support/random_scenes.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

constexpr double kNoise = 1e-9;  // scenes are of size 1

using Motion = std::function<Vec3(Vec3)>;

/// The same rigid motion for all models of a scene, and each coordinate of each node off by up to the noise.
Motion motion_and_noise(std::uint32_t seed) {
  const scenes::Draw draw = scenes::draw_from(seed);
  const double a = draw(-3, 3), b = draw(-1.5, 1.5);
  const Vec3 shift{draw(-2, 2), draw(-2, 2), draw(-2, 2)};
  return [=](Vec3 p) {
    const Vec3 q{std::cos(a) * p.x - std::sin(a) * p.y, std::sin(a) * p.x + std::cos(a) * p.y, p.z};
    const Vec3 off{draw(-kNoise, kNoise), draw(-kNoise, kNoise), draw(-kNoise, kNoise)};
    return Vec3{q.x, std::cos(b) * q.y - std::sin(b) * q.z, std::sin(b) * q.y + std::cos(b) * q.z} + shift + off;
  };
}

struct Verdict {
  double area = 0, common_area = 0;
};

void judge(const scenes::Merge& scene, Overlap overlap, const Motion& motion, Verdict& verdict) {
  const Model base = scenes::moved(scene.base, motion);
  std::vector<Model> parts;
  for (const Model& part : scene.parts) parts.push_back(scenes::moved(part, motion));
  MergeOptions options = scene.options;
  options.overlap = overlap;
  const auto merged = merge(base, parts, options);
  ASSERT_TRUE(merged.has_value()) << to_string(merged.error());
  EXPECT_TRUE(merged->report.broken_promises.empty()) << scenes::first_problem(merged->report);
  for (const OverlapEntry& entry : merged->report.overlaps) verdict.common_area += entry.area;
  const Model result = apply(base, parts, *merged);
  if (overlap != Overlap::kProject) scenes::expect_sound(result);
  for (std::size_t e = 0; e < result.n_elements(); ++e)
    if (result.is_face(ElementId(e))) verdict.area += scenes::area_of(result, ElementId(e));
}

class MovedContact : public testing::TestWithParam<const char*> {};

TEST_P(MovedContact, GivesTheSameUpToTheMotionWhateverTheRounding) {
  const std::vector<scenes::Merge> all = scenes::contact_catalogue();
  const scenes::Merge& scene = *std::ranges::find(all, GetParam(), &scenes::Merge::name);
  // The second doubler lies where the border of the first has bent the base.
  const double same_area = scene.name == "leaning_doublers" ? 1e-3 : 1e-6;
  for (const Overlap overlap : {Overlap::kFuse, Overlap::kProject, Overlap::kKeepPart}) {
    Verdict still;
    ASSERT_NO_FATAL_FAILURE(judge(
        scene, overlap, [](Vec3 p) { return p; }, still));
    for (const std::uint32_t seed : {1u, 2u}) {
      SCOPED_TRACE(testing::Message() << "variant " << static_cast<int>(overlap) << ", seed " << seed);
      Verdict moved;
      ASSERT_NO_FATAL_FAILURE(judge(scene, overlap, motion_and_noise(seed), moved));
      // Where new nodes come to stand may depend on rounding: on the ways down beside borders, and along rims.
      EXPECT_NEAR(moved.area, still.area, 2e-3 * still.area);
      EXPECT_NEAR(moved.common_area, still.common_area, same_area * still.common_area);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, MovedContact,
                         testing::Values("doubler_turned", "doubler_above", "doubler_fine_1_3", "doubler_at_free_edge",
                                         "partial_overlap_across", "partial_overlap_corners", "leaning_doublers",
                                         "doubler_on_doubler_apart", "doubler_beyond_doubler_apart"),
                         [](const auto& scene) { return std::string(scene.param); });

}  // namespace
}  // namespace meshgraft
