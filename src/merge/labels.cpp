#include "merge/labels.hpp"

#include <algorithm>
#include <numeric>
#include <span>

namespace meshgraft {
namespace {

/// Finds positions of labels of one input: a table where labels are dense, else a sorted list.
class LabelIndex {
 public:
  explicit LabelIndex(std::span<const std::int64_t> labels) {
    if (labels.empty()) return;
    const auto [low, high] = std::ranges::minmax(labels);
    low_ = low, high_ = high;
    const auto range = static_cast<std::uint64_t>(high) - static_cast<std::uint64_t>(low);
    if (range < kDenseFactor * labels.size()) {
      table_.assign(range + 1, kNone);
      for (std::size_t i = 0; i < labels.size(); ++i)
        table_[static_cast<std::size_t>(labels[i] - low)] = static_cast<std::uint32_t>(i);
      return;
    }
    sorted_.reserve(labels.size());
    for (std::size_t i = 0; i < labels.size(); ++i) sorted_.emplace_back(labels[i], static_cast<std::uint32_t>(i));
    std::sort(sorted_.begin(), sorted_.end());
  }

  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  [[nodiscard]] std::uint32_t find(std::int64_t label) const {
    if (label < low_ || label > high_) return kNone;
    if (!table_.empty()) return table_[static_cast<std::size_t>(label - low_)];
    const auto it = std::ranges::lower_bound(sorted_, label, {}, &std::pair<std::int64_t, std::uint32_t>::first);
    return it != sorted_.end() && it->first == label ? it->second : kNone;
  }

 private:
  static constexpr std::uint64_t kDenseFactor = 8;  // table entries per label: 32 bytes against 16 of the list
  std::int64_t low_ = 1, high_ = 0;
  std::vector<std::uint32_t> table_;
  std::vector<std::pair<std::int64_t, std::uint32_t>> sorted_;
};

std::int64_t power_of_ten_above(std::int64_t n) {
  std::int64_t power = 1;
  while (power <= n) power *= 10;
  return power;
}

/// The labels of one kind of entity, nodes or elements.
template <class Id>
class Numbering {
 public:
  std::vector<std::int64_t> shift;
  std::vector<std::vector<Id>> shifted;
  std::int64_t largest = 0;  // used so far, shifted ones included

  void add_input(std::span<const std::int64_t> labels) {
    const std::vector<Id> clashing = clashes(labels);
    if (!labels.empty()) largest = std::max(largest, std::ranges::max(labels));
    std::int64_t by = 0;
    if (!clashing.empty()) {
      const auto [low, high] = std::ranges::minmax(clashing, {}, [&](Id id) { return labels[id.value]; });
      const std::int64_t least = labels[low.value], most = labels[high.value];
      by = power_of_ten_above(largest - std::min<std::int64_t>(0, std::ranges::min(labels)));
      if (most + by > kLargestLabel) by = power_of_ten_above(largest - least);
      largest = std::max(largest, most + by);
    }
    shift.push_back(by);
    shifted.push_back(clashing);
    inputs_.push_back(labels);
  }

 private:
  std::vector<Id> clashes(std::span<const std::int64_t> labels) const {
    if (inputs_.empty()) return {};
    const LabelIndex index(labels);
    std::vector<Id> found;
    const auto look_for = [&](std::int64_t label) {
      if (const std::uint32_t i = index.find(label); i != LabelIndex::kNone) found.emplace_back(std::size_t{i});
    };
    for (std::size_t k = 0; k < inputs_.size(); ++k) {
      for (const std::int64_t label : inputs_[k]) look_for(label);
      for (const Id id : shifted[k]) look_for(inputs_[k][id.value] + shift[k]);
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

  std::vector<std::span<const std::int64_t>> inputs_;
};

template <class Id>
Result<void> check_room(const Numbering<Id>& numbering, std::size_t n_new, const char* kind) {
  const std::int64_t needed = numbering.largest + static_cast<std::int64_t>(n_new);
  if (needed <= kLargestLabel) return {};
  return failure(ErrorCode::kLabelOverflow,
                 std::string("the merged model would need ") + kind + " labels up to " + std::to_string(needed) +
                     ", more than " + std::to_string(kLargestLabel),
                 std::string("renumber the ") + kind + "s of the input with the largest labels from 1");
}

template <class Id>
std::int64_t shifted_label(const std::vector<std::vector<Id>>& shifted, const std::vector<std::int64_t>& shift,
                           std::uint32_t input, Id id, std::int64_t label) {
  return std::ranges::binary_search(shifted[input], id) ? label + shift[input] : label;
}

}  // namespace

Result<Labels> labels_of(Inputs inputs, const Graft& graft) {
  Numbering<NodeId> nodes;
  Numbering<ElementId> elements;
  for (const Model* model : inputs) {
    nodes.add_input(model->node_label);
    elements.add_input(model->element_label);
  }
  if (const auto ok = check_room(nodes, graft.new_nodes.size(), "node"); !ok) return Failure(ok.error());
  if (const auto ok = check_room(elements, graft.new_elements.size(), "element"); !ok) return Failure(ok.error());
  Labels labels;
  labels.node_shift = nodes.shift, labels.element_shift = elements.shift;
  labels.shifted_nodes = nodes.shifted, labels.shifted_elements = elements.shifted;
  labels.first_new_node = nodes.largest + 1, labels.first_new_element = elements.largest + 1;
  return labels;
}

std::int64_t label_of(Inputs inputs, const Labels& labels, NodeRef node) {
  if (node.input == kNew) return labels.first_new_node + static_cast<std::int64_t>(node.node.value);
  return shifted_label(labels.shifted_nodes, labels.node_shift, node.input, node.node,
                       inputs[node.input]->node_label[node.node.value]);
}

std::int64_t label_of(Inputs inputs, const Labels& labels, ElementRef element) {
  if (element.input == kNew) return labels.first_new_element + static_cast<std::int64_t>(element.element.value);
  return shifted_label(labels.shifted_elements, labels.element_shift, element.input, element.element,
                       inputs[element.input]->element_label[element.element.value]);
}

}  // namespace meshgraft
