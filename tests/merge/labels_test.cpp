#include "merge/labels.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <set>

namespace meshgraft {
namespace {

Model with_labels(std::vector<std::int64_t> labels) {
  Model m;
  m.position.resize(labels.size());
  m.node_label = labels;
  m.element_label = std::move(labels);
  return m;
}

Labels labels(const std::vector<Model>& models) {
  std::vector<const Model*> inputs;
  for (const Model& m : models) inputs.push_back(&m);
  return labels_of(inputs);
}

TEST(Labels, OnlyClashingLabelsMoveAndTheyMoveByThePowerOfTenAboveAll) {
  const Labels l = labels({with_labels({10, 20, 30}), with_labels({20, 40, 10, 7})});
  EXPECT_EQ(l.node_shift, (std::vector<std::int64_t>{0, 100}));
  EXPECT_EQ(l.shifted_nodes[1], (std::vector<NodeId>{NodeId(std::size_t{0}), NodeId(std::size_t{2})}));
  EXPECT_EQ(l.first_new_node, 121);
}

TEST(Labels, WithoutClashNothingMoves) {
  const Labels l = labels({with_labels({1, 2}), with_labels({1'000'000'000, 4})});
  EXPECT_EQ(l.node_shift, (std::vector<std::int64_t>{0, 0}));
  EXPECT_TRUE(l.shifted_nodes[1].empty());
  EXPECT_EQ(l.first_new_node, 1'000'000'001);
}

TEST(Labels, WhereThePowerOfTenAboveAllDoesNotFitTheOneAboveTheirRangeIsTaken) {
  const std::vector<std::int64_t> huge{9'990'000'001, 9'990'000'516};
  const Labels l = labels({with_labels(huge), with_labels(huge)});
  EXPECT_EQ(l.node_shift[1], 1000);
  EXPECT_EQ(l.first_new_node, 9'990'001'517);
}

TEST(Labels, APowerOfTenInUseIsNotTheShift) {
  const Labels l = labels({with_labels({1, 100}), with_labels({1})});
  EXPECT_EQ(l.node_shift[1], 1000);
}

TEST(Labels, AnInputAlsoGivesWayToShiftedLabelsOfTheOneBefore) {
  const Labels l = labels({with_labels({1}), with_labels({1, 2}), with_labels({11})});
  EXPECT_EQ(l.node_shift[1], 10);            // 1 becomes 11
  EXPECT_EQ(l.shifted_nodes[2].size(), 1u);  // 11 clashes with it
  EXPECT_EQ(l.node_shift[2], 100);
}

TEST(Labels, ManyInputsWithTheSameLabelsMoveByMultiplesOfOnePowerAsLongAsTheyHaveEightDigits) {
  std::vector<Model> models{with_labels({1, 5'000'000})};
  for (int k = 0; k < 40; ++k) models.push_back(with_labels({1, 57, 999}));
  const Labels l = labels(models);
  for (std::size_t k = 1; k < 10; ++k) EXPECT_EQ(l.node_shift[k], std::int64_t(k) * 10'000'000) << k;
  for (std::size_t k = 10; k < models.size(); ++k)
    EXPECT_EQ(l.node_shift[k], 90'001'000 + 1000 * std::int64_t(k - 10)) << k;
  EXPECT_EQ(l.first_new_node, 90'032'000);
}

/// One part after the other, each call with the result of the one before: the power above all that is there grows
/// tenfold with each.
TEST(Labels, OfCallAfterCallStayBelowEightDigits) {
  std::vector<std::int64_t> base{1, 1000};
  for (int call = 0; call < 12; ++call) {
    const Labels l = labels({with_labels(base), with_labels({1, 57, 999})});
    base.insert(base.end(), {l.node_shift[1] + 1, l.node_shift[1] + 999});
  }
  EXPECT_LE(base.back(), 99'999'999);
}

TEST(Labels, WhereMultiplesLeadBeyond32BitsTheyFollowEachOtherClosely) {
  std::vector<Model> models{with_labels({1, 2, 3, 1'500'000'000})};
  for (int k = 0; k < 3; ++k) models.push_back(with_labels({1, 2, 3}));
  const Labels l = labels(models);
  EXPECT_EQ(l.node_shift, (std::vector<std::int64_t>{0, 1'500'000'000, 1'500'000'010, 1'500'000'020}));
}

TEST(Labels, NoRoomForNewLabelsIsAnError) {
  const Model base = with_labels({kLargestLabel - 1}), part = with_labels({5});
  Graft graft;
  graft.new_nodes.resize(2);
  const std::array<const Model*, 2> inputs{&base, &part};
  const auto result = check_room(labels_of(inputs), graft);
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().code, ErrorCode::kLabelOverflow);
  graft.new_nodes.resize(1);
  EXPECT_TRUE(check_room(labels_of(inputs), graft).has_value());
}

std::vector<std::int64_t> some_labels() {
  const bool dense = *rc::gen::arbitrary<bool>();
  const auto label = dense ? rc::gen::inRange<std::int64_t>(1, 60) : rc::gen::inRange<std::int64_t>(1, 2'000'000);
  std::vector<std::int64_t> all = *rc::gen::unique<std::vector<std::int64_t>>(label);
  return all;
}

TEST(Labels, AreUniqueAndThoseOfTheBaseStay) {
  EXPECT_TRUE(rc::check([] {
    std::vector<Model> models;
    const auto n = *rc::gen::inRange<std::size_t>(1, 5);
    for (std::size_t k = 0; k < n; ++k) models.push_back(with_labels(some_labels()));
    std::vector<const Model*> inputs;
    for (const Model& m : models) inputs.push_back(&m);
    const Labels l = labels_of(inputs);
    std::set<std::int64_t> used;
    std::int64_t largest = 0;
    std::set<std::int64_t> before;
    for (std::uint32_t k = 0; k < n; ++k)
      for (std::size_t i = 0; i < models[k].n_nodes(); ++i) {
        const std::int64_t own = models[k].node_label[i];
        const std::int64_t label = label_of(inputs, l, NodeRef{k, NodeId(i)});
        RC_ASSERT(label_of(inputs, l, ElementRef{k, ElementId(i)}) == label);  // nodes and elements alike
        RC_ASSERT(used.insert(label).second);
        RC_ASSERT(k > 0 || label == own);
        RC_ASSERT(label == own || before.contains(own) || used.contains(own));
        largest = std::max(largest, label);
      }
    RC_ASSERT(l.first_new_node > largest);
  }));
}

}  // namespace
}  // namespace meshgraft
