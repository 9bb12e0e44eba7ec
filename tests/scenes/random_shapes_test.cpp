// Laws of a merge over random plates, tubes, cones, spheres and saddles.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cstdint>

#include "meshgraft/check.hpp"
#include "meshgraft/merge.hpp"
#include "support/random_scenes.hpp"

namespace meshgraft {
namespace {

/// Whether each poor face comes from an angle or a detail of the input, as the warning says.
bool poor_faces_have_a_cause(const Report& report) {
  if (report.quality.min >= 0.5) return true;
  return std::ranges::any_of(report.warnings, [](const Warning& w) { return w.name == "poor-face"; });
}

TEST(RandomShapes, MergeIntoOneMeshFitForAnalysisOrSayWhyNot) {
  const bool held = rc::check([] {
    // Nothing to shrink: `write_scenes DIR SEED SEED+1` writes the scene.
    const auto seed = *rc::gen::noShrink(rc::gen::inRange(0, 1 << 30));
    const scenes::Merge scene = scenes::random_shapes(scenes::draw_from(static_cast<std::uint32_t>(seed)));
    RC_LOG() << "seed " << seed << ": " << scene.name << '\n';
    const auto merged = merge(scene.base, scene.parts);
    if (!merged) {
      // They may miss each other, or lie on each other in a way that cannot be decided.
      RC_LOG() << to_string(merged.error()) << '\n';
      RC_ASSERT(merged.error().code == ErrorCode::kPartsApart || merged.error().code == ErrorCode::kOverlap);
      return;
    }
    const Report& report = merged->report;
    for (const Error& e : report.broken_promises) RC_LOG() << to_string(e) << '\n';
    RC_ASSERT(report.broken_promises.empty());
    RC_ASSERT(poor_faces_have_a_cause(report));
    RC_LOG() << "mean Q " << report.quality.mean << '\n';
    RC_ASSERT(report.quality.mean >= 0.84);
    const Model result = apply(scene.base, scene.parts, *merged);
    const CheckResult found = check(result);
    RC_ASSERT(found.sound());
    RC_ASSERT(found.n_orphan_nodes == 0u);
  });
  EXPECT_TRUE(held);
}

}  // namespace
}  // namespace meshgraft
