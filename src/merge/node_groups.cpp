#include "merge/node_groups.hpp"

#include <algorithm>
#include <map>

namespace meshgraft {
namespace {

/// Which node groups cover which element groups, in one input.
class Covering {
 public:
  /// Looks only at element groups in `wanted` (merged groups).
  Covering(Inputs inputs, std::uint32_t input, GroupSetId wanted, SetTranslation& translated, GroupSets& sets)
      : model_(*inputs[input]), input_(input), translated_(translated), sets_(sets) {
    if (has_node_groups() && wanted != GroupSets::kEmpty) look(wanted);
  }

  /// Node groups that an element in the groups `set` (merged) requires of its nodes.
  GroupSetId required(GroupSetId set) {
    if (nodes_of_set_.empty()) return GroupSets::kEmpty;
    const auto [it, fresh] = required_.try_emplace(set, GroupSets::kEmpty);
    if (fresh)
      for (const GroupId g : sets_.members(set)) it->second = sets_.unite(it->second, covering(g));
    return it->second;
  }

 private:
  bool has_node_groups() const {
    return std::ranges::any_of(model_.groups, [](const Group& g) { return g.n_nodes > 0; });
  }

  /// Fills nodes_of_set_: by set of element groups, the node groups that all nodes of its elements
  /// are in. One pass over the elements, ended as soon as nothing can be covered any more.
  void look(GroupSetId wanted) {
    nodes_of_set_.resize(model_.group_sets.size());
    std::vector<std::uint8_t> open(nodes_of_set_.size());
    for (std::size_t s = 0; s < open.size(); ++s)
      open[s] = sets_.intersect(translated_(input_, GroupSetId(s)), wanted) != GroupSets::kEmpty;
    auto n_open = std::ranges::count(open, 1);
    for (std::size_t e = 0; e < model_.n_elements() && n_open > 0; ++e) {
      const GroupSetId s = model_.element_groups[e];
      if (open[s.value] == 0) continue;
      GroupSetId& common = nodes_of_set_[s.value];
      for (const NodeId n : model_.nodes_of(ElementId(e))) {
        if (!n.valid()) continue;
        const GroupSetId groups = translated_.of(NodeRef{input_, n});
        common = common.valid() ? sets_.intersect(common, groups) : groups;
      }
      if (common != GroupSets::kEmpty) continue;
      open[s.value] = 0;
      --n_open;
    }
  }

  GroupSetId covering(GroupId g) {
    GroupSetId common;
    for (std::size_t s = 0; s < nodes_of_set_.size(); ++s) {
      const GroupSetId nodes = nodes_of_set_[s];
      if (!nodes.valid() || !sets_.contains(translated_(input_, GroupSetId(s)), g)) continue;
      common = common.valid() ? sets_.intersect(common, nodes) : nodes;
    }
    return common.valid() ? common : GroupSets::kEmpty;
  }

  const Model& model_;
  std::uint32_t input_;
  SetTranslation& translated_;
  GroupSets& sets_;
  std::vector<GroupSetId> nodes_of_set_;       // by set of the input; invalid: no element seen
  std::map<GroupSetId, GroupSetId> required_;  // by merged set
};

/// A node and groups it shall be in.
using Wish = std::pair<NodeRef, GroupSetId>;

void require_covering(Inputs inputs, SetTranslation& translated, Graft& graft, std::vector<Wish>& wishes) {
  GroupSets& sets = graft.group_sets;
  std::vector<GroupSetId> touched(inputs.size(), GroupSets::kEmpty);  // groups with new members, by input
  for (const NewElement& e : graft.new_elements)
    touched[e.parent.input] = sets.unite(touched[e.parent.input], e.groups);
  std::vector<Covering> coverings;
  for (std::uint32_t k = 0; k < inputs.size(); ++k) coverings.emplace_back(inputs, k, touched[k], translated, sets);
  for (const NewElement& e : graft.new_elements) {
    const GroupSetId required = coverings[e.parent.input].required(e.groups);
    if (required == GroupSets::kEmpty) continue;
    for (const NodeRef n : e.nodes)
      if (n.valid()) wishes.emplace_back(n, required);
  }
}

}  // namespace

void assign_node_groups(Inputs inputs, SetTranslation& translated, const Complex& final_complex,
                        const Stitched& stitched, Graft& graft) {
  GroupSets& sets = graft.group_sets;
  std::vector<Wish> wishes;
  for (std::size_t v = 0; v < stitched.node.size(); ++v)
    if (stitched.node[v].valid()) wishes.emplace_back(stitched.node[v], final_complex.vertex_groups[v]);
  for (const Graft::ReplacedNode& r : graft.replaced_nodes) wishes.emplace_back(r.by, translated.of(r.node));
  require_covering(inputs, translated, graft, wishes);

  std::sort(wishes.begin(), wishes.end());
  for (std::size_t k = 0; k < wishes.size();) {
    const NodeRef node = wishes[k].first;
    GroupSetId all = GroupSets::kEmpty;
    for (; k < wishes.size() && wishes[k].first == node; ++k) all = sets.unite(all, wishes[k].second);
    if (node.input == kNew) {
      graft.new_nodes[node.node.value].groups = all;
      continue;
    }
    const GroupSetId beyond = sets.subtract(all, translated.of(node));
    if (beyond == GroupSets::kEmpty || std::ranges::binary_search(graft.removed_nodes[node.input], node.node)) continue;
    graft.joined_nodes.push_back({node, beyond});
  }
}

}  // namespace meshgraft
