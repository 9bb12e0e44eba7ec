// Scenes and laws of the tests of whole merges.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "meshgraft/check.hpp"
#include "meshgraft/merge.hpp"
#include "support/scenes.hpp"

namespace meshgraft::merge_laws {

inline constexpr double kSize = 0.1;

inline Model wall(double jitter = 0.15) {
  return scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, kSize, "WALL", jitter);
}

inline Model stiffener(double x0, double x1, double y, double below, double above, double size = kSize,
                       const std::string& group = "STIFFENER") {
  return scenes::plate({x0, y, -below}, {x1 - x0, 0, 0}, {0, 0, below + above}, size, group, 0.15);
}

inline Merged merged(const Model& base, const std::vector<Model>& parts, const MergeOptions& options = {}) {
  Result<Merged> result = merge(base, parts, options);
  if (!result) throw std::runtime_error(to_string(result.error()));
  return std::move(*result);
}

inline std::map<std::int64_t, ElementId> elements_by_label(const Model& m) {
  std::map<std::int64_t, ElementId> all;
  for (std::size_t e = 0; e < m.n_elements(); ++e) all[m.element_label[e]] = ElementId(e);
  return all;
}

inline std::map<std::int64_t, NodeId> nodes_by_label(const Model& m) {
  std::map<std::int64_t, NodeId> all;
  for (std::size_t n = 0; n < m.n_nodes(); ++n) all[m.node_label[n]] = NodeId(n);
  return all;
}

inline std::set<std::string> names(const Model& m, GroupSetId set) {
  std::set<std::string> all;
  for (const GroupId g : m.group_sets.members(set)) all.insert(m.groups[g.value].name);
  return all;
}

/// (1), (3) of merge(): what is kept is the same, what is new is like its parent.
inline void expect_laws(const Model& base, const std::vector<Model>& parts, const Merged& m) {
  for (const Error& e : m.report.broken_promises) ADD_FAILURE() << to_string(e);
  const Model result = apply(base, parts, m);
  EXPECT_TRUE(check(result).sound());
  EXPECT_EQ(check(result).n_orphan_nodes, 0u);
  const auto nodes = nodes_by_label(result);
  const auto elements = elements_by_label(result);
  EXPECT_EQ(nodes.size(), result.n_nodes());  // labels are unique
  EXPECT_EQ(elements.size(), result.n_elements());

  const std::set<NodeId> removed_nodes(m.graft.removed_nodes[0].begin(), m.graft.removed_nodes[0].end());
  for (std::size_t n = 0; n < base.n_nodes(); ++n) {
    const auto it = nodes.find(base.node_label[n]);
    ASSERT_EQ(it == nodes.end(), removed_nodes.contains(NodeId(n)));
    if (it != nodes.end()) {
      EXPECT_EQ(result.position[it->second.value], base.position[n]);
    }
  }
  const std::set<ElementId> removed(m.graft.removed_elements[0].begin(), m.graft.removed_elements[0].end());
  for (std::size_t e = 0; e < base.n_elements(); ++e) {
    const auto it = elements.find(base.element_label[e]);
    ASSERT_EQ(it == elements.end(), removed.contains(ElementId(e)));
    if (it == elements.end()) continue;
    EXPECT_EQ(names(result, result.element_groups[it->second.value]), names(base, base.element_groups[e]));
    EXPECT_EQ(result.attributes_of(it->second), base.attributes_of(ElementId(e)));
    const auto before = base.nodes_of(ElementId(e)), after = result.nodes_of(it->second);
    for (std::size_t k = 0; k < before.size(); ++k)
      EXPECT_EQ(result.node_label[after[k].value], base.node_label[before[k].value]);
  }
  for (std::size_t i = 0; i < m.graft.new_elements.size(); ++i) {
    const NewElement& e = m.graft.new_elements[i];
    const Model& from = e.parent.input == 0 ? base : parts[e.parent.input - 1];
    const ElementId id = elements.at(m.labels.first_new_element + static_cast<std::int64_t>(i));
    EXPECT_EQ(names(result, result.element_groups[id.value]), names(from, from.element_groups[e.parent.element.value]));
    EXPECT_EQ(result.attributes_of(id), from.attributes_of(e.parent.element));
  }
}

}  // namespace meshgraft::merge_laws
