#include "merge/group_table.hpp"

#include <map>
#include <optional>
#include <string>

namespace meshgraft {
namespace {

bool same_kind(const Group& a, const Group& b) {
  const bool a_empty = a.n_nodes + a.n_elements == 0, b_empty = b.n_nodes + b.n_elements == 0;
  return a_empty || b_empty || ((a.n_nodes > 0) == (b.n_nodes > 0) && (a.n_elements > 0) == (b.n_elements > 0));
}

class Builder {
 public:
  explicit Builder(Inputs inputs) : inputs_(inputs) { table_.of_input.resize(inputs.size()); }

  GroupTable build() {
    for (std::uint32_t k = 0; k < inputs_.size(); ++k) add_input(k);
    return std::move(table_);
  }

 private:
  void add_input(std::uint32_t k) {
    const std::vector<Group>& groups = inputs_[k]->groups;
    table_.of_input[k].resize(groups.size());
    std::vector<bool> placed(groups.size(), k == 0);
    // Groups of the right kind choose first, so that a mixed pair of names keeps its order.
    for (const bool strict : {true, false})
      for (std::size_t g = 0; g < groups.size() && k > 0; ++g)
        if (!placed[g]) placed[g] = unite(k, GroupId(g), strict);
    for (std::size_t g = 0; g < groups.size(); ++g)
      if (k == 0 || !placed[g]) append(k, GroupId(g));
  }

  bool unite(std::uint32_t k, GroupId g, bool strict) {
    const Group& group = inputs_[k]->groups[g.value];
    const auto found = by_name_.find(group.name);
    if (found == by_name_.end()) return false;
    for (const GroupId candidate : found->second) {
      MergedGroup& merged = table_.groups[candidate.value];
      const MergedGroup::From first = merged.from.front();
      if (merged.from.back().input == k) continue;
      if (strict && !same_kind(group, inputs_[first.input]->groups[first.group.value])) continue;
      merged.from.push_back({k, g});
      table_.of_input[k][g.value] = candidate;
      return true;
    }
    return false;
  }

  void append(std::uint32_t k, GroupId g) {
    const std::string& name = inputs_[k]->groups[g.value].name;
    const GroupId id(table_.groups.size());
    table_.groups.push_back({name, {{k, g}}});
    table_.of_input[k][g.value] = id;
    by_name_[name].push_back(id);
  }

  Inputs inputs_;
  GroupTable table_;
  std::map<std::string, std::vector<GroupId>> by_name_;
};

}  // namespace

GroupTable group_table(Inputs inputs) { return Builder(inputs).build(); }

SetTranslation::SetTranslation(Inputs inputs, const GroupTable& table, GroupSets& merged)
    : inputs_(inputs), table_(&table), merged_(&merged) {
  for (const Model* model : inputs) known_.emplace_back(model->group_sets.size());
  for (std::size_t s = 0; s < known_.front().size(); ++s) (*this)(0, GroupSetId(s));
}

GroupSetId SetTranslation::operator()(std::uint32_t input, GroupSetId set) {
  GroupSetId& known = known_[input][set.value];
  if (!known.valid()) {
    std::vector<GroupId> groups;
    for (const GroupId g : inputs_[input]->group_sets.members(set)) groups.push_back(table_->of_input[input][g.value]);
    known = merged_->intern(std::move(groups));
  }
  return known;
}

}  // namespace meshgraft
