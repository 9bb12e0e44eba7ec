#include "io/splice_labels.hpp"

#include <algorithm>

namespace meshgraft::unv {

OutputLabels::OutputLabels(std::span<const Model* const> inputs, const Graft& graft, const Labels& labels)
    : inputs_(inputs),
      graft_(graft),
      labels_(labels),
      changed_(inputs.size()),
      node_index_(inputs.size()),
      element_index_(inputs.size()) {
  const auto mark = [&](NodeRef node) {
    if (changed_[node.input].empty()) changed_[node.input].resize(inputs[node.input]->n_nodes());
    changed_[node.input][node.node.value] = 1;
  };
  for (std::uint32_t k = 0; k < inputs.size(); ++k)
    for (const NodeId node : labels.shifted_nodes[k]) mark({k, node});
  for (const Graft::ReplacedNode& r : graft.replaced_nodes) mark(r.node);
}

std::int64_t OutputLabels::of(NodeRef node) const {
  // Chains of replacements end: each leads to an earlier input or to a new node.
  for (std::size_t step = 0; node.input != kNew && step <= inputs_.size() && changes(node); ++step) {
    const auto at = std::ranges::lower_bound(graft_.replaced_nodes, node, {}, &Graft::ReplacedNode::node);
    if (at == graft_.replaced_nodes.end() || at->node != node)
      return inputs_[node.input]->node_label[node.node.value] + labels_.node_shift[node.input];
    node = at->by;
  }
  if (node.input == kNew) return labels_.first_new_node + static_cast<std::int64_t>(node.node.value);
  return inputs_[node.input]->node_label[node.node.value];
}

std::int64_t OutputLabels::of(ElementRef element) const {
  if (element.input == kNew) return labels_.first_new_element + static_cast<std::int64_t>(element.element.value);
  const std::int64_t label = inputs_[element.input]->element_label[element.element.value];
  return is_shifted(element) ? label + labels_.element_shift[element.input] : label;
}

bool OutputLabels::is_shifted(ElementRef e) const {
  return std::ranges::binary_search(labels_.shifted_elements[e.input], e.element);
}

bool OutputLabels::is_removed(NodeRef n) const {
  return std::ranges::binary_search(graft_.removed_nodes[n.input], n.node);
}

bool OutputLabels::is_removed(ElementRef e) const {
  return std::ranges::binary_search(graft_.removed_elements[e.input], e.element);
}

const LabelIndex& OutputLabels::index(std::vector<std::optional<LabelIndex>>& indices, std::uint32_t input,
                                      bool nodes) {
  if (!indices[input]) indices[input] = LabelIndex(nodes ? inputs_[input]->node_label : inputs_[input]->element_label);
  return *indices[input];
}

template <class Ref>
bool OutputLabels::appears(std::vector<std::optional<LabelIndex>>& indices, std::uint32_t input, std::int64_t label,
                           std::int64_t first_new, std::size_t n_new, const std::vector<std::int64_t>& shift) {
  constexpr bool kNodes = std::is_same_v<Ref, NodeRef>;
  if (label >= first_new && label - first_new < static_cast<std::int64_t>(n_new)) return true;
  for (std::uint32_t k = 0; k < inputs_.size(); ++k) {
    if (k == input) continue;
    for (const std::int64_t own : {label, label - shift[k]}) {
      const std::uint32_t at = index(indices, k, kNodes).find(own);
      if (at == LabelIndex::kNone) continue;
      Ref ref;
      ref.input = k;
      if constexpr (kNodes)
        ref.node = NodeId(std::size_t{at});
      else
        ref.element = ElementId(std::size_t{at});
      if (!is_removed(ref) && of(ref) == label) return true;
    }
  }
  return false;
}

bool OutputLabels::node_appears(std::uint32_t input, std::int64_t label) {
  return index(node_index_, input, true).find(label) == LabelIndex::kNone &&
         appears<NodeRef>(node_index_, input, label, labels_.first_new_node, graft_.new_nodes.size(),
                          labels_.node_shift);
}

bool OutputLabels::element_appears(std::uint32_t input, std::int64_t label) {
  return index(element_index_, input, false).find(label) == LabelIndex::kNone &&
         appears<ElementRef>(element_index_, input, label, labels_.first_new_element, graft_.new_elements.size(),
                             labels_.element_shift);
}

std::int64_t OutputLabels::largest_new() const {
  std::int64_t largest = 0;
  if (!graft_.new_nodes.empty())
    largest = labels_.first_new_node + static_cast<std::int64_t>(graft_.new_nodes.size()) - 1;
  if (!graft_.new_elements.empty())
    largest = std::max(largest, labels_.first_new_element + static_cast<std::int64_t>(graft_.new_elements.size()) - 1);
  for (std::uint32_t k = 0; k < inputs_.size(); ++k) {
    for (const NodeId n : labels_.shifted_nodes[k])
      largest = std::max(largest, inputs_[k]->node_label[n.value] + labels_.node_shift[k]);
    for (const ElementId e : labels_.shifted_elements[k])
      largest = std::max(largest, inputs_[k]->element_label[e.value] + labels_.element_shift[k]);
  }
  return largest;
}

}  // namespace meshgraft::unv
