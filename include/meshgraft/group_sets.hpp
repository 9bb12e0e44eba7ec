// Interned sets of groups: equality of group membership is equality of two integers.
#pragma once

#include <span>
#include <unordered_map>
#include <vector>

#include "meshgraft/id.hpp"

namespace meshgraft {

/// Every distinct set of groups is stored once. Groups overlap, so an entity is in a *set* of
/// groups; with 500 groups a few thousand sets occur. Set 0 is the empty set.
///
/// Cost: hashing of the members for a new combination; `with`, `unite` and `intersect` remember
/// their answers. Not safe for concurrent changes.
class GroupSets {
 public:
  GroupSets();

  static constexpr GroupSetId kEmpty{std::size_t{0}};

  /// The id of a set; `groups` in any order, repeats allowed.
  GroupSetId intern(std::vector<GroupId> groups);
  /// The set plus one group.
  GroupSetId with(GroupSetId set, GroupId group);
  GroupSetId unite(GroupSetId a, GroupSetId b);
  GroupSetId intersect(GroupSetId a, GroupSetId b);
  /// What `all` has beyond `own`.
  GroupSetId subtract(GroupSetId all, GroupSetId own);

  /// Ascending, without repeats.
  [[nodiscard]] std::span<const GroupId> members(GroupSetId set) const { return sets_[set.value]; }
  [[nodiscard]] bool contains(GroupSetId set, GroupId group) const;
  [[nodiscard]] bool is_subset(GroupSetId part, GroupSetId whole) const;
  [[nodiscard]] std::size_t size() const { return sets_.size(); }

 private:
  std::vector<std::vector<GroupId>> sets_;
  std::unordered_multimap<std::uint64_t, GroupSetId> by_hash_;
  std::unordered_map<std::uint64_t, GroupSetId> with_, unite_, intersect_;
};

}  // namespace meshgraft
