#include "meshgraft/group_sets.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <iterator>
#include <set>

namespace meshgraft {
namespace {

using Members = std::set<std::uint32_t>;

GroupId group(std::size_t i) { return GroupId(i); }

Members any_members() {
  Members result;
  for (int i = *rc::gen::element(0, 1, 3, 8); i > 0; --i) result.insert(*rc::gen::inRange<std::uint32_t>(0, 12));
  return result;
}

GroupSetId intern(GroupSets& sets, const Members& members) {
  std::vector<GroupId> groups;
  for (const std::uint32_t m : members) groups.emplace_back(std::size_t{m});
  std::ranges::reverse(groups);
  return sets.intern(groups);
}

Members members(const GroupSets& sets, GroupSetId id) {
  Members result;
  for (const GroupId g : sets.members(id)) result.insert(g.value);
  return result;
}

TEST(GroupSets, SetZeroIsEmpty) {
  GroupSets sets;
  EXPECT_EQ(sets.intern({}), GroupSets::kEmpty);
  EXPECT_TRUE(sets.members(GroupSets::kEmpty).empty());
  EXPECT_EQ(sets.size(), 1u);
}

TEST(GroupSets, OrderAndRepeatsDoNotMatter) {
  GroupSets sets;
  EXPECT_EQ(sets.intern({group(3), group(1), group(3)}), sets.intern({group(1), group(3)}));
  EXPECT_EQ(sets.size(), 2u);
}

RC_GTEST_PROP(GroupSets, EqualIdsAreEqualSets, ()) {
  GroupSets sets;
  const Members a = any_members(), b = any_members();
  const GroupSetId ia = intern(sets, a), ib = intern(sets, b);
  RC_ASSERT((ia == ib) == (a == b));
  RC_ASSERT(members(sets, ia) == a);
  RC_ASSERT(members(sets, ib) == b);
}

RC_GTEST_PROP(GroupSets, UniteAndIntersectAreThoseOfSets, ()) {
  GroupSets sets;
  // Several at once, so that remembered answers are used too.
  for (int round = 0; round < 4; ++round) {
    const Members a = any_members(), b = any_members();
    const GroupSetId ia = intern(sets, a), ib = intern(sets, b);
    Members both, common;
    std::ranges::set_union(a, b, std::inserter(both, both.end()));
    std::ranges::set_intersection(a, b, std::inserter(common, common.end()));
    for (int again = 0; again < 2; ++again) {
      RC_ASSERT(members(sets, sets.unite(ia, ib)) == both);
      RC_ASSERT(members(sets, sets.intersect(ia, ib)) == common);
      RC_ASSERT(sets.unite(ia, ib) == sets.unite(ib, ia));
      RC_ASSERT(sets.intersect(ia, ib) == sets.intersect(ib, ia));
    }
    RC_ASSERT(sets.is_subset(ia, ib) == std::ranges::includes(b, a));
    const std::uint32_t g = *rc::gen::inRange<std::uint32_t>(0, 12);
    RC_ASSERT(sets.contains(ia, group(g)) == a.contains(g));
    Members more = a;
    more.insert(g);
    RC_ASSERT(members(sets, sets.with(ia, group(g))) == more);
  }
}

}  // namespace
}  // namespace meshgraft
