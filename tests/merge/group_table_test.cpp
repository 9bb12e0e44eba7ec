#include "merge/group_table.hpp"

#include <gtest/gtest.h>

namespace meshgraft {
namespace {

Group group(const std::string& name, std::uint64_t n_nodes, std::uint64_t n_elements) {
  Group g;
  g.name = name, g.n_nodes = n_nodes, g.n_elements = n_elements;
  return g;
}

Model with_groups(std::vector<Group> groups) {
  Model m;
  m.groups = std::move(groups);
  return m;
}

std::vector<std::string> names(const GroupTable& table) {
  std::vector<std::string> all;
  for (const MergedGroup& g : table.groups) all.push_back(g.name);
  return all;
}

TEST(GroupTable, GroupsOfOneNameUniteAcrossInputsAndKeepTheOrderOfTheBase) {
  const Model base = with_groups({group("B", 0, 2), group("A", 0, 2)});
  const Model part = with_groups({group("NEW", 0, 1), group("A", 0, 1)});
  const GroupTable table = group_table(std::array{&base, &part});
  EXPECT_EQ(names(table), (std::vector<std::string>{"B", "A", "NEW"}));
  EXPECT_EQ(table.of_input[1][1], GroupId(std::size_t{1}));
  ASSERT_EQ(table.groups[1].from.size(), 2u);
  EXPECT_EQ(table.groups[1].from[0].input, 0u);
  EXPECT_EQ(table.groups[1].from[1].input, 1u);
}

TEST(GroupTable, NodeAndElementGroupsOfOneNameInOneInputStayTwo) {
  const Model base = with_groups({group("A", 3, 0), group("A", 0, 2)});
  const Model part = with_groups({group("A", 0, 1), group("A", 1, 0)});
  const GroupTable table = group_table(std::array{&base, &part});
  EXPECT_EQ(table.groups.size(), 2u);
  EXPECT_EQ(table.of_input[1][0], GroupId(std::size_t{1}));  // elements to elements
  EXPECT_EQ(table.of_input[1][1], GroupId(std::size_t{0}));  // nodes to nodes
}

TEST(GroupTable, NodesAndElementsOfOneNameInTwoInputsStayTwoGroupsWithAWarning) {
  for (const bool nodes_first : {true, false}) {
    const Model base = with_groups({nodes_first ? group("A", 3, 0) : group("A", 0, 3)});
    const Model part = with_groups({nodes_first ? group("A", 0, 1) : group("A", 1, 0)});
    const GroupTable table = group_table(std::array{&base, &part});
    EXPECT_EQ(table.groups.size(), 2u);
    ASSERT_EQ(table.warnings.size(), 1u);
    EXPECT_EQ(table.warnings[0].name, "group-kinds");
  }
}

TEST(GroupTable, MixedGroupJoinsWhatHasAKindInCommonWithAWarning) {
  const Model base = with_groups({group("A", 3, 0), group("B", 2, 2)});
  const Model part = with_groups({group("A", 1, 1), group("B", 0, 1)});
  const GroupTable table = group_table(std::array{&base, &part});
  EXPECT_EQ(table.groups.size(), 2u);
  EXPECT_EQ(table.warnings.size(), 2u);
}

TEST(GroupTable, GroupThatWasJoinedByAnotherKindIsOfBoth) {
  const Model base = with_groups({group("A", 0, 0)});
  const Model nodes = with_groups({group("A", 2, 0)}), elements = with_groups({group("A", 0, 2)});
  const GroupTable table = group_table(std::array{&base, &nodes, &elements});
  ASSERT_EQ(table.groups.size(), 2u);
  EXPECT_EQ(table.groups[0].from.size(), 2u) << "an empty group is of any kind, but only once";
  EXPECT_EQ(table.warnings.size(), 1u);
}

TEST(GroupTable, GroupsOfOneKindNeedNoWarning) {
  const Model base = with_groups({group("A", 3, 0), group("A", 0, 2), group("B", 1, 1), group("C", 0, 0)});
  const Model part = with_groups({group("A", 0, 1), group("B", 2, 2), group("C", 1, 0), group("A", 1, 0)});
  const GroupTable table = group_table(std::array{&base, &part});
  EXPECT_EQ(table.groups.size(), 4u);
  EXPECT_TRUE(table.warnings.empty());
}

TEST(GroupTable, EqualNamesWithinTheBaseStayApart) {
  const Model base = with_groups({group("A", 0, 1), group("A", 0, 2)});
  EXPECT_EQ(group_table(std::array{&base}).groups.size(), 2u);
}

TEST(GroupTable, ThreeInputsUniteInOneGroup) {
  const Model base = with_groups({}), first = with_groups({group("A", 0, 1)}), second = with_groups({group("A", 0, 2)});
  const GroupTable table = group_table(std::array{&base, &first, &second});
  ASSERT_EQ(table.groups.size(), 1u);
  EXPECT_EQ(table.groups[0].from.size(), 2u);
}

TEST(SetTranslation, SetsOfDifferentInputsCompareAfterTranslation) {
  Model base = with_groups({group("A", 0, 1), group("B", 0, 1)}),
        part = with_groups({group("B", 0, 1), group("A", 0, 1)});
  const GroupSetId in_base = base.group_sets.intern({GroupId(std::size_t{0})});
  const GroupSetId in_part = part.group_sets.intern({GroupId(std::size_t{1})});
  const std::array<const Model*, 2> inputs{&base, &part};
  const GroupTable table = group_table(inputs);
  GroupSets sets;
  SetTranslation translated(inputs, table, sets);
  EXPECT_EQ(translated(0, in_base), translated(1, in_part));
  EXPECT_EQ(translated(0, GroupSets::kEmpty), GroupSets::kEmpty);
}

}  // namespace
}  // namespace meshgraft
