#include "meshgraft/group_sets.hpp"

#include <algorithm>
#include <iterator>

namespace meshgraft {
namespace {

std::uint64_t hash_of(std::span<const GroupId> groups) {
  std::uint64_t h = 0xcbf29ce484222325ull;  // FNV-1a
  for (const GroupId g : groups) h = (h ^ g.value) * 0x100000001b3ull;
  return h;
}

std::uint64_t pair_key(std::uint32_t a, std::uint32_t b) { return (std::uint64_t{a} << 32) | b; }

std::uint64_t unordered_key(GroupSetId a, GroupSetId b) {
  return pair_key(std::min(a.value, b.value), std::max(a.value, b.value));
}

}  // namespace

GroupSets::GroupSets() { intern({}); }

GroupSetId GroupSets::intern(std::vector<GroupId> groups) {
  std::sort(groups.begin(), groups.end());
  groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
  const std::uint64_t h = hash_of(groups);
  const auto [first, last] = by_hash_.equal_range(h);
  for (auto it = first; it != last; ++it)
    if (sets_[it->second.value] == groups) return it->second;
  const GroupSetId id(sets_.size());
  sets_.push_back(std::move(groups));
  by_hash_.emplace(h, id);
  return id;
}

GroupSetId GroupSets::with(GroupSetId set, GroupId group) {
  const std::uint64_t key = pair_key(set.value, group.value);
  if (const auto it = with_.find(key); it != with_.end()) return it->second;
  std::vector<GroupId> groups = sets_[set.value];
  groups.push_back(group);
  return with_[key] = intern(std::move(groups));
}

GroupSetId GroupSets::unite(GroupSetId a, GroupSetId b) {
  if (a == b) return a;
  const std::uint64_t key = unordered_key(a, b);
  if (const auto it = unite_.find(key); it != unite_.end()) return it->second;
  std::vector<GroupId> groups;
  std::ranges::set_union(sets_[a.value], sets_[b.value], std::back_inserter(groups));
  return unite_[key] = intern(std::move(groups));
}

GroupSetId GroupSets::intersect(GroupSetId a, GroupSetId b) {
  if (a == b) return a;
  const std::uint64_t key = unordered_key(a, b);
  if (const auto it = intersect_.find(key); it != intersect_.end()) return it->second;
  std::vector<GroupId> groups;
  std::ranges::set_intersection(sets_[a.value], sets_[b.value], std::back_inserter(groups));
  return intersect_[key] = intern(std::move(groups));
}

GroupSetId GroupSets::subtract(GroupSetId all, GroupSetId own) {
  if (is_subset(all, own)) return kEmpty;
  std::vector<GroupId> beyond;
  std::ranges::set_difference(sets_[all.value], sets_[own.value], std::back_inserter(beyond));
  return intern(std::move(beyond));
}

bool GroupSets::contains(GroupSetId set, GroupId group) const {
  return std::ranges::binary_search(sets_[set.value], group);
}

bool GroupSets::is_subset(GroupSetId part, GroupSetId whole) const {
  return part == whole || std::ranges::includes(sets_[whole.value], sets_[part.value]);
}

}  // namespace meshgraft
