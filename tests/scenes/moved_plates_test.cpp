// The same law for random plates: what lies on each other does so wherever it is. A scene is its seed.
#include "scenes/moved_plates.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace meshgraft {
namespace {

/// `make soak SCENES=5000` takes as many as it is asked for, as does
/// RC_PARAMS="seed=7 max_success=5000" build/release/tests/scenes/scenes_test --gtest_filter='MovedPlates.*'
TEST(MovedPlates, AreMergedAlikeWhereverTheyAre) {
  const bool held = rc::check([] {
    const auto seed = *rc::gen::noShrink(rc::gen::inRange(0, 1 << 30));  // nothing to shrink
    const auto faults = scenes::faults_of_moved_plates(static_cast<std::uint32_t>(seed));
    for (const std::string& fault : faults) RC_LOG() << fault << '\n';
    RC_LOG() << "seed " << seed << '\n';
    RC_ASSERT(faults.empty());
  });
  EXPECT_TRUE(held);
}

/// Scenes that were once wrong.
class MovedPlatesOfSeed : public testing::TestWithParam<std::uint32_t> {};

TEST_P(MovedPlatesOfSeed, AreMergedAlikeWhereverTheyAre) {
  for (const std::string& fault : scenes::faults_of_moved_plates(GetParam())) ADD_FAILURE() << fault;
}

// The coordinates told which of two parts over each other stayed.
INSTANTIATE_TEST_SUITE_P(PartsWithEquallyManyElements, MovedPlatesOfSeed, testing::Values(241u));

// Where the outline of a plate leaves the base, a node of the base was drawn onto that outline although both run from
// one place in different directions. Faces were folded in two there, or not, by rounding.
INSTANTIATE_TEST_SUITE_P(OutlinesThatLeaveTheBase, MovedPlatesOfSeed, testing::Values(138u, 466u, 978u));

// Where an edge of a face that lies on another became whole again, its pieces and its neighbour's were one's or the
// other's by where the middles fell; the ledger took that for area lost.
INSTANTIATE_TEST_SUITE_P(PiecesOfAnothersFace, MovedPlatesOfSeed, testing::Values(2260u, 3189u));

// A node of a mesh that is joined along the outline of a part already was drawn onto that outline over its own face.
INSTANTIATE_TEST_SUITE_P(NodesBeyondTheirOwnFaces, MovedPlatesOfSeed, testing::Values(576u));

// A long edge along which both are joined was not known to be a joint, and what is beside it taken for a gap left open.
INSTANTIATE_TEST_SUITE_P(NodesBesideLongEdges, MovedPlatesOfSeed, testing::Values(6110u, 69143475u));

// The strip that closes a gap was far narrower than the gap is wide, and its new faces upright, or over, by rounding.
INSTANTIATE_TEST_SUITE_P(SteepStrips, MovedPlatesOfSeed, testing::Values(2869u, 4053u, 5396u));

}  // namespace
}  // namespace meshgraft
