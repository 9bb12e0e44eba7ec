// Fillings of test scenes, and what every one of them keeps.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "meshgraft/check.hpp"
#include "meshgraft/fill.hpp"

namespace meshgraft {

inline Merged made(const Model& base, const FillOptions& options = {}) {
  Result<Merged> result = fill(base, options);
  if (!result) throw std::runtime_error(to_string(result.error()));
  return std::move(*result);
}

inline std::vector<std::string> broken(const Report& report) {
  std::vector<std::string> all;
  for (const Error& e : report.broken_promises) all.push_back(to_string(e));
  return all;
}

/// What every filling keeps, in words; empty if all holds.
inline std::string broken_laws(const Model& base, const Merged& m) {
  for (const auto& removed : m.graft.removed_elements)
    if (!removed.empty()) return "an element is gone";
  for (const auto& removed : m.graft.removed_nodes)
    if (!removed.empty()) return "a node is gone";
  if (!m.graft.moved_nodes.empty()) return "a node has moved";
  const Model result = apply(base, {}, m);
  for (std::size_t n = 0; n < base.n_nodes(); ++n)
    if (result.node_label[n] != base.node_label[n] || result.position[n] != base.position[n]) return "a node differs";
  for (std::size_t e = 0; e < base.n_elements(); ++e)
    if (result.element_label[e] != base.element_label[e]) return "an element differs";
  const std::int64_t last_node = *std::ranges::max_element(base.node_label);
  for (std::size_t n = base.n_nodes(); n < result.n_nodes(); ++n)
    if (result.node_label[n] != last_node + 1 + static_cast<std::int64_t>(n - base.n_nodes())) return "a label jumps";
  const CheckResult check = meshgraft::check(result);
  if (!check.sound()) return "the result is not sound";
  if (check.flipped_edges > 0) return "a face is turned over";
  if (check.n_orphan_nodes > 0) return "a node is alone";
  return {};
}

}  // namespace meshgraft
