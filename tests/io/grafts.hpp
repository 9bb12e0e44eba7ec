// Grafts made by hand.
#pragma once

#include <algorithm>
#include <span>

#include "meshgraft/merge.hpp"

namespace meshgraft::samples {

/// The graft that changes nothing: groups of equal names united, no label moved.
inline Merged nothing(const Model& base, std::span<const Model> parts = {}) {
  Merged merged;
  const std::size_t n = 1 + parts.size();
  merged.graft.removed_nodes.resize(n), merged.graft.removed_elements.resize(n);
  Labels& labels = merged.labels;
  labels.node_shift.resize(n), labels.element_shift.resize(n);
  labels.shifted_nodes.resize(n), labels.shifted_elements.resize(n);
  for (std::uint32_t k = 0; k < n; ++k) {
    const Model& model = k == 0 ? base : parts[k - 1];
    for (const std::int64_t label : model.node_label)
      labels.first_new_node = std::max(labels.first_new_node, label + 1);
    for (const std::int64_t label : model.element_label)
      labels.first_new_element = std::max(labels.first_new_element, label + 1);
    for (std::size_t g = 0; g < model.groups.size(); ++g) {
      auto& groups = merged.graft.groups;
      auto at = groups.end();
      if (k > 0) at = std::ranges::find(groups, model.groups[g].name, &MergedGroup::name);
      if (at == groups.end())
        groups.push_back({model.groups[g].name, {{k, GroupId(g)}}});
      else
        at->from.push_back({k, GroupId(g)});
    }
  }
  return merged;
}

/// Moves all labels of input `k` by a constant.
inline void shift_all(Merged& merged, std::uint32_t k, const Model& model, std::int64_t by) {
  merged.labels.node_shift[k] = merged.labels.element_shift[k] = by;
  for (std::size_t i = 0; i < model.n_nodes(); ++i) merged.labels.shifted_nodes[k].push_back(NodeId(i));
  for (std::size_t i = 0; i < model.n_elements(); ++i) merged.labels.shifted_elements[k].push_back(ElementId(i));
  for (const std::int64_t label : model.node_label)
    merged.labels.first_new_node = std::max(merged.labels.first_new_node, label + by + 1);
  for (const std::int64_t label : model.element_label)
    merged.labels.first_new_element = std::max(merged.labels.first_new_element, label + by + 1);
}

}  // namespace meshgraft::samples
