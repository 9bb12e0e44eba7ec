// Groups (unv.md 3.6; 6, rules 10 to 13; 9, traps 28 to 36).
#include "io/unv_samples.hpp"

namespace meshgraft {
namespace {

using namespace samples;
using Labels = std::vector<std::int64_t>;

Model with_groups(const std::string& records, const std::string& number = "2467") {
  return read(mesh(dataset(number, records)));
}

/// Groups LEFT {e1, e2, n1} and ENDS {} in the layout of a dataset number.
std::string same_groups(std::size_t header_fields, bool pairs) {
  std::string text;
  const auto header = [&](std::int64_t number, std::int64_t count, const std::string& name) {
    std::string fields = line({number});
    fields.pop_back();
    for (std::size_t k = 2; k < header_fields; ++k) fields += "         0";
    text += fields + line({count}) + name + "\n";
  };
  header(1, 5, "LEFT");
  text += pairs ? line({8, 1, 8, 2, 7, 1, 7, 2}) + line({7, 3})
                : line({8, 1, 0, 0, 8, 2, 0, 0}) + line({7, 1, 0, 0, 7, 2, 0, 0}) + line({7, 3, 0, 0});
  header(2, 0, "ENDS");
  return text;
}

void expect_same_groups(const Model& m) {
  ASSERT_EQ(m.groups.size(), 2u);
  EXPECT_EQ(m.groups[0].name, "LEFT");
  EXPECT_EQ(elements_in(m, 0), (Labels{1, 2}));
  EXPECT_EQ(nodes_in(m, 0), (Labels{1, 2, 3}));
  EXPECT_EQ(m.groups[1].name, "ENDS");
  EXPECT_EQ(m.groups[1].n_elements, 0u);
}

TEST(UnvGroups, NineDatasetsInFourLayouts) {
  expect_same_groups(with_groups(same_groups(6, true), "752"));
  expect_same_groups(with_groups(same_groups(7, true), "2417"));
  for (const char* number : {"2429", "2430", "2432"}) expect_same_groups(with_groups(same_groups(8, true), number));
  for (const char* number : {"2435", "2452", "2467", "2477"})
    expect_same_groups(with_groups(same_groups(8, false), number));
}

TEST(UnvGroups, LayoutOfAnotherDatasetIsFoundByItsFit) {
  for (const auto& [records, number] :
       {std::pair{same_groups(8, true), "2467"}, {same_groups(8, false), "2430"}, {same_groups(8, true), "2417"}}) {
    const Model m = with_groups(records, number);
    expect_same_groups(m);
    EXPECT_TRUE(warns(m, "group-layout")) << number;
  }
}

TEST(UnvGroups, EmptyGroupsFirstMiddleAndLast) {
  const std::string empty = line({1, 0, 0, 0, 0, 0, 0, 0}) + "EMPTY\n";
  const std::string full = line({2, 0, 0, 0, 0, 0, 0, 1}) + "FULL\n" + line({7, 1, 0, 0});
  for (const std::string& form : {empty, empty + "\n"}) {
    const Model m = with_groups(form + full + form + full + form);
    ASSERT_EQ(m.groups.size(), 5u);
    for (const std::size_t g : {0u, 2u, 4u}) EXPECT_EQ(m.groups[g].name, "EMPTY");
    for (const std::size_t g : {1u, 3u}) EXPECT_EQ(nodes_in(m, g), (Labels{1}));
  }
}

TEST(UnvGroups, HalfLineInTheMiddle) {
  const Model m = with_groups(line({1, 0, 0, 0, 0, 0, 0, 3}) + "MIXED\n" + line({7, 1, 0, 0}) +
                              line({8, 1, 0, 0, 8, 2, 0, 0}) + kGroups);
  ASSERT_EQ(m.groups.size(), 3u);
  EXPECT_EQ(nodes_in(m, 0), (Labels{1}));
  EXPECT_EQ(elements_in(m, 0), (Labels{1, 2}));
}

TEST(UnvGroups, DanglingMembersAndForeignCodesAreCountedAndKept) {
  const Model m = with_groups(line({1, 0, 0, 0, 0, 0, 0, 4}) + "ALL\n" + line({7, 99, 0, 0, 8, 1, 0, 0}) +
                              line({12, 1, 0, 0, 8, 77, 0, 0}));
  EXPECT_EQ(m.groups[0].n_nodes, 0u);
  EXPECT_EQ(m.groups[0].n_elements, 1u);
  EXPECT_EQ(m.groups[0].n_other, 1u);
  EXPECT_EQ(m.groups[0].n_dangling, 2u);
  EXPECT_TRUE(warns(m, "dangling-members"));
}

TEST(UnvGroups, LeafAndComponentOfForeignEntitiesAreLegal) {
  const Model m = with_groups(line({1, 0, 0, 0, 0, 0, 0, 2}) + "REF\n" + line({67, 1, 5, 6, 8, 1, 0, 0}));
  EXPECT_EQ(m.groups[0].n_other, 1u);
  EXPECT_EQ(elements_in(m, 0), (Labels{1}));
}

TEST(UnvGroups, EqualNumbersAndEqualNames) {
  const std::string group = line({0, 0, 0, 0, 0, 0, 0, 1}) + "SAME\n";
  const Model m = with_groups(group + line({7, 1, 0, 0}) + group + line({8, 1, 0, 0}));
  ASSERT_EQ(m.groups.size(), 2u);
  EXPECT_EQ(nodes_in(m, 0), (Labels{1}));
  EXPECT_EQ(elements_in(m, 1), (Labels{1}));
}

TEST(UnvGroups, NamesByPlaceWhateverTheyLookLike) {
  const std::string header = line({3, 0, 0, 0, 0, 0, 0, 1}), member = line({8, 1, 0, 0});
  for (const std::string& name : {std::string(200, 'x'), std::string(), std::string("        1         2"),
                                  std::string("17"), std::string("POST VIEWPORT 1"), std::string("\xC3\xA9t\xC3\xA9"),
                                  std::string("    -1"), std::string("         8         1         0         0")}) {
    const Model m = with_groups(header + name + "\n" + member + kGroups);
    ASSERT_EQ(m.groups.size(), 3u) << name;
    EXPECT_EQ(m.groups[0].name, name);
    EXPECT_EQ(elements_in(m, 0), (Labels{1})) << name;
  }
}

TEST(UnvGroups, TrailingBlanksOfNamesAreNotPartOfThem) {
  EXPECT_EQ(with_groups(line({3, 0, 0, 0, 0, 0, 0, 0}) + "AIR \n").groups[0].name, "AIR");
}

TEST(UnvGroups, WrongCountsAreRepairedWithAWarning) {
  const std::string entities = line({8, 1, 0, 0, 8, 2, 0, 0}) + line({8, 3, 0, 0});
  for (const int declared : {0, 2, 4, 5}) {
    const Model m = with_groups(line({1, 0, 0, 0, 0, 0, 0, declared}) + "WRONG\n" + entities + kGroups);
    ASSERT_EQ(m.groups.size(), 3u) << declared;
    EXPECT_EQ(elements_in(m, 0), (Labels{1, 2, 3})) << declared;
    EXPECT_EQ(elements_in(m, 1), (Labels{1, 2})) << declared;
    EXPECT_TRUE(warns(m, "group-count"));
  }
}

TEST(UnvGroups, EntitiesOfAGroupThatDeclaresNoneAreNoGroupsOfTheirOwn) {
  std::string entities;
  for (int k = 0; k < 4; ++k) entities += line({8, 1, 0, 0, 7, 2, 0, 0});
  for (const std::string& before : {kGroups, std::string()})
    for (const std::string& last : {std::string(), line({8, 5, 0, 0})}) {
      const Model m = with_groups(before + line({3, 0, 0, 0, 0, 0, 0, 0}) + "NONE\n" + entities + last);
      ASSERT_EQ(m.groups.size(), before.empty() ? 1u : 3u);
      EXPECT_EQ(m.groups.back().n_elements, last.empty() ? 4u : 5u);
      EXPECT_EQ(m.groups.back().n_nodes, 4u);
      EXPECT_TRUE(warns(m, "group-count"));
    }
}

TEST(UnvGroups, EmptyGroupsBeforeHeadersThatLookLikeEntities) {
  const std::string empty = line({3, 0, 0, 0, 0, 0, 0, 0}) + "NONE\n";
  for (const std::string name : {"FIXED", "17", "8 1"}) {
    const Model m = with_groups(empty + line({2, 0, 0, 0, 3, 0, 0, 1}) + name + "\n" + line({8, 1, 0, 0}) + kGroups);
    ASSERT_EQ(m.groups.size(), 4u) << name;
    EXPECT_EQ(m.groups[0].n_elements, 0u);
    EXPECT_EQ(m.groups[1].name, name);
    EXPECT_FALSE(warns(m, "group-count"));
  }
}

TEST(UnvGroups, FiveHundredOverlappingGroups) {
  std::string records;
  for (int g = 1; g <= 500; ++g) {
    records += line({g, 0, 0, 0, 0, 0, 0, 1 + g % 2}) + "GROUP_" + std::to_string(g) + "\n";
    records += g % 2 == 0 ? line({8, 1 + g % 5, 0, 0}) : line({8, 1 + g % 5, 0, 0, 7, 1 + g % 6, 0, 0});
  }
  const Model m = with_groups(records);
  ASSERT_EQ(m.groups.size(), 500u);
  for (std::size_t g = 1; g <= 500; ++g) {
    EXPECT_EQ(elements_in(m, g - 1), (Labels{static_cast<std::int64_t>(1 + g % 5)}));
    EXPECT_EQ(m.groups[g - 1].n_nodes, g % 2);
  }
}

TEST(UnvGroups, EqualEntriesCountAsTheyStand) {
  const Model m = with_groups(line({1, 0, 0, 0, 0, 0, 0, 2}) + "TWICE\n" + line({8, 1, 0, 0, 8, 1, 0, 0}));
  EXPECT_EQ(elements_in(m, 0), (Labels{1}));
}

}  // namespace
}  // namespace meshgraft
