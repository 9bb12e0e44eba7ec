#include "merge/group_table.hpp"

#include <map>
#include <string>

#include "core/source.hpp"

namespace meshgraft {
namespace {

constexpr unsigned kNodes = 1, kElements = 2, kOther = 4;

/// What a group has members of, as bits; 0 if it has none.
unsigned kinds_of(const Group& group) {
  return (group.n_nodes > 0 ? kNodes : 0) | (group.n_elements > 0 ? kElements : 0) | (group.n_other > 0 ? kOther : 0);
}

std::string text_of(unsigned kinds) {
  std::vector<std::string> names;
  if ((kinds & kNodes) != 0) names.emplace_back("nodes");
  if ((kinds & kElements) != 0) names.emplace_back("elements");
  if ((kinds & kOther) != 0) names.emplace_back("other things");
  return joined(names);
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
    // Groups of the same kinds choose first, so that a mixed pair of names keeps its order.
    for (const Match match : {Match::kSame, Match::kCommon, Match::kEmpty})
      for (std::size_t g = 0; g < groups.size() && k > 0; ++g)
        if (!placed[g]) placed[g] = unite(k, GroupId(g), match);
    for (std::size_t g = 0; g < groups.size(); ++g)
      if (k == 0 || !placed[g]) append(k, GroupId(g));
  }

  enum class Match { kSame, kCommon, kEmpty };
  static bool is(Match match, unsigned a, unsigned b) {
    if (match == Match::kSame) return a == b;
    return match == Match::kCommon ? (a & b) != 0 : a == 0 || b == 0;
  }

  bool unite(std::uint32_t k, GroupId g, Match match) {
    const Group& group = inputs_[k]->groups[g.value];
    const auto found = by_name_.find(group.name);
    if (found == by_name_.end()) return false;
    const unsigned kinds = kinds_of(group);
    for (const GroupId candidate : found->second) {
      MergedGroup& merged = table_.groups[candidate.value];
      unsigned& of_merged = kinds_[candidate.value];
      if (merged.from.back().input == k || !is(match, kinds, of_merged)) continue;
      if (match == Match::kCommon && kinds != of_merged)
        warn(k, group, of_merged, merged, "; they are one group of both");
      merged.from.push_back({k, g}), of_merged |= kinds;
      table_.of_input[k][g.value] = candidate;
      return true;
    }
    return false;
  }

  void append(std::uint32_t k, GroupId g) {
    const Group& group = inputs_[k]->groups[g.value];
    const GroupId id(table_.groups.size());
    std::vector<GroupId>& same_name = by_name_[group.name];
    for (const GroupId other : same_name) {
      const MergedGroup& merged = table_.groups[other.value];
      if (merged.from.back().input == k) break;  // this input has two of that name itself
      warn(k, group, kinds_[other.value], merged, "; they stay two groups of one name, which some programs refuse");
    }
    table_.groups.push_back({group.name, {{k, g}}});
    table_.of_input[k][g.value] = id;
    kinds_.push_back(kinds_of(group)), same_name.push_back(id);
  }

  void warn(std::uint32_t k, const Group& group, unsigned of_merged, const MergedGroup& merged, const char* outcome) {
    const Model& model = *inputs_[k];
    table_.warnings.push_back({"group-kinds",
                               "group " + group.name + " is of " + text_of(kinds_of(group)) + " here and of " +
                                   text_of(of_merged) + " in " + inputs_[merged.from.front().input]->path + outcome,
                               {model.path, model.source ? model.source->line_of(group.place) : 0}});
  }

  Inputs inputs_;
  GroupTable table_;
  std::vector<unsigned> kinds_;  // by merged group
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
