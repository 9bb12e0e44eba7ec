// Groups of the merged model: which groups of the inputs become one.
#pragma once

#include <vector>

#include "merge/inputs.hpp"
#include "meshgraft/graft.hpp"

namespace meshgraft {

struct GroupTable {
  std::vector<MergedGroup> groups;             // the base's, then what the parts add, in file order
  std::vector<std::vector<GroupId>> of_input;  // [input][group of it]: the merged group
  std::vector<Warning> warnings;               // group-kinds: groups of one name but not of one kind
};

/// Unites groups of one name and kind across inputs: these usually mean the same thing. Kinds of members are nodes,
/// elements, and what a format has besides; a group may be of several, and an empty one is of any.
///
///  (1) Groups of one input are never united with each other, whatever their names.
///  (2) A group of a part joins the first merged group of its name that is of the same kinds; failing that, the first
///      that has a kind in common, with a warning; failing that, the first that is empty, or any if it is empty itself.
///  (3) Else it is new, with a warning if another input has the name: nodes never get into a group of elements.
[[nodiscard]] GroupTable group_table(Inputs inputs);

/// Group sets of the inputs as sets of merged groups; each is translated once, on demand. Where
/// `merged` is still empty, sets of the base keep their ids, so that its arrays can be copied.
class SetTranslation {
 public:
  SetTranslation(Inputs inputs, const GroupTable& table, GroupSets& merged);

  GroupSetId operator()(std::uint32_t input, GroupSetId set);
  GroupSetId unite(GroupSetId a, GroupSetId b) { return merged_->unite(a, b); }
  /// Groups of an element, or of a node, of an input.
  GroupSetId of(ElementRef e) { return (*this)(e.input, inputs_[e.input]->element_groups[e.element.value]); }
  GroupSetId of(NodeRef n) { return (*this)(n.input, inputs_[n.input]->node_groups[n.node.value]); }

 private:
  Inputs inputs_;
  const GroupTable* table_;
  GroupSets* merged_;
  std::vector<std::vector<GroupSetId>> known_;  // [input][set]
};

}  // namespace meshgraft
