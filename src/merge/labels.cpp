#include "merge/labels.hpp"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <limits>
#include <span>

namespace meshgraft {
namespace {

constexpr std::int64_t kLargestInColumns = 99'999'999;                                // of eight digits, as of Nastran
constexpr std::int64_t kLargestElsewhere = std::numeric_limits<std::int32_t>::max();  // most programs have 32 bits

/// The labels of one input, as runs of consecutive ones.
class LabelRuns {
 public:
  explicit LabelRuns(std::span<const std::int64_t> labels) {
    if (add(labels)) return;
    std::vector<std::int64_t> sorted(labels.begin(), labels.end());
    std::ranges::sort(sorted);
    runs_.clear();
    add(sorted);
  }

  [[nodiscard]] bool contains(std::int64_t label) const {
    if (runs_.empty() || label < runs_.front().first || label > runs_.back().last) return false;
    const auto after = std::ranges::upper_bound(runs_, label, {}, &Run::first);
    return label <= (after - 1)->last;
  }
  [[nodiscard]] std::int64_t largest() const { return runs_.empty() ? 0 : runs_.back().last; }

 private:
  struct Run {
    std::int64_t first, last;
  };

  /// False if the labels do not ascend.
  bool add(std::span<const std::int64_t> labels) {
    for (const std::int64_t label : labels) {
      if (!runs_.empty() && label < runs_.back().last) return false;
      if (runs_.empty() || label > runs_.back().last + 1) runs_.push_back({label, label});
      runs_.back().last = label;
    }
    return true;
  }

  std::vector<Run> runs_;  // ascending
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
    const LabelRuns& own = own_.emplace_back(labels);
    largest = std::max(largest, own.largest()), largest_own_ = std::max(largest_own_, own.largest());
    std::vector<std::int64_t> moved;
    std::int64_t by = 0;
    if (!clashing.empty() && largest <= kLargestLabel) {
      for (const Id id : clashing) moved.push_back(labels[id.value]);
      const auto [least, most] = std::ranges::minmax(moved);
      by = shift_of(least, most);
      for (std::int64_t& label : moved) label += by;
      largest = std::max(largest, most + by);
    }
    moved_.emplace_back(moved);
    shift.push_back(by);
    shifted.push_back(clashing);
  }

 private:
  /// Moves labels from `least` to `most` above all that are used; see labels_of.
  [[nodiscard]] std::int64_t shift_of(std::int64_t least, std::int64_t most) const {
    const auto multiple_of = [&](std::int64_t step) { return ((largest - least) / step + 1) * step; };
    const std::array by{multiple_of(power_of_ten_above(largest_own_)), multiple_of(power_of_ten_above(most - least))};
    for (const std::int64_t limit : {kLargestInColumns, kLargestElsewhere, kLargestLabel})
      for (const std::int64_t b : by)
        if (most + b <= limit) return b;
    return multiple_of(1);
  }

  [[nodiscard]] std::vector<Id> clashes(std::span<const std::int64_t> labels) const {
    std::vector<Id> found;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const auto has = [label = labels[i]](const LabelRuns& runs) { return runs.contains(label); };
      if (std::ranges::any_of(own_, has) || std::ranges::any_of(moved_, has)) found.emplace_back(i);
    }
    return found;
  }

  std::vector<LabelRuns> own_, moved_;  // by input: labels as they were, those that were shifted as they are now
  std::int64_t largest_own_ = 0;        // of own_
};

Result<void> check_room(std::int64_t first_new, std::size_t n_new, const char* kind) {
  const std::int64_t needed = first_new - 1 + static_cast<std::int64_t>(n_new);
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

Labels labels_of(Inputs inputs) {
  Numbering<NodeId> nodes;
  Numbering<ElementId> elements;
  tbb::parallel_invoke(
      [&] {
        for (const Model* model : inputs) nodes.add_input(model->node_label);
      },
      [&] {
        for (const Model* model : inputs) elements.add_input(model->element_label);
      });
  Labels labels;
  labels.node_shift = nodes.shift, labels.element_shift = elements.shift;
  labels.shifted_nodes = nodes.shifted, labels.shifted_elements = elements.shifted;
  labels.first_new_node = nodes.largest + 1, labels.first_new_element = elements.largest + 1;
  return labels;
}

Result<void> check_room(const Labels& labels, const Graft& graft) {
  const auto nodes = check_room(labels.first_new_node, graft.new_nodes.size(), "node");
  return nodes ? check_room(labels.first_new_element, graft.new_elements.size(), "element") : nodes;
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
