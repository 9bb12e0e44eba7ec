// Groups of the merged model: which groups of the inputs become one.
#pragma once

#include <vector>

#include "merge/inputs.hpp"
#include "meshgraft/graft.hpp"

namespace meshgraft {

struct GroupTable {
  std::vector<MergedGroup> groups;             // the base's, then what the parts add, in file order
  std::vector<std::vector<GroupId>> of_input;  // [input][group of it]: the merged group
};

/// Unites groups of one name across inputs: the same name usually means the same thing.
///
///  (1) Groups of one input are never united with each other, whatever their names.
///  (2) A group of a part joins the first merged group of its name that holds the same kind of
///      member (nodes or elements); failing that, the first of its name; failing that, it is new.
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
