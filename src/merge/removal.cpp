#include "merge/removal.hpp"

#include <algorithm>

namespace meshgraft {
namespace {

template <class Id>
void unite(std::vector<Id>& set, const std::vector<Id>& more) {
  set.insert(set.end(), more.begin(), more.end());
  std::ranges::sort(set);
  set.erase(std::ranges::unique(set).begin(), set.end());
}

/// By node of input k: 1 if something needs it once the elements marked in `removed` are gone.
std::vector<std::uint8_t> needed_nodes(Inputs inputs, std::uint32_t k, const std::vector<std::uint8_t>& removed,
                                       const Graft& graft) {
  const Model& model = *inputs[k];
  std::vector<std::uint8_t> needed(model.n_nodes()), is_parent(model.n_elements());
  for (std::size_t e = 0; e < model.n_elements(); ++e)
    if (removed[e] == 0)
      for (const NodeId n : model.nodes_of(ElementId(e)))
        if (n.valid()) needed[n.value] = 1;
  for (const NewElement& e : graft.new_elements) {
    if (e.parent.input == k) is_parent[e.parent.element.value] = 1;
    for (const NodeRef n : e.nodes)
      if (n.valid() && n.input == k) needed[n.node.value] = 1;
  }
  for (const OrientationNode& o : model.orientation_nodes)
    if (removed[o.element.value] == 0 || is_parent[o.element.value] != 0) needed[o.node.value] = 1;
  return needed;
}

}  // namespace

void remove_elements(Inputs inputs, std::span<const std::vector<ElementId>> elements, Graft& graft) {
  for (std::uint32_t k = 0; k < elements.size(); ++k) {
    unite(graft.removed_elements[k], elements[k]);
    const Model& model = *inputs[k];
    std::vector<std::uint8_t> removed(model.n_elements());
    for (const ElementId e : graft.removed_elements[k]) removed[e.value] = 1;
    const std::vector<std::uint8_t> needed = needed_nodes(inputs, k, removed, graft);
    std::vector<NodeId> nodes;
    for (const ElementId e : graft.removed_elements[k])
      for (const NodeId n : model.nodes_of(e))
        if (n.valid() && needed[n.value] == 0) nodes.push_back(n);
    unite(graft.removed_nodes[k], nodes);
  }
}

}  // namespace meshgraft
