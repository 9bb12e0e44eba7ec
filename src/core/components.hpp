// Which faces of the inputs are intersected with which.
#pragma once

#include <cstdint>
#include <vector>

#include "core/complex.hpp"
#include "meshgraft/id.hpp"

namespace meshgraft {

/// A component is not intersected with itself: a whole input, or a connected mesh of one, or what a
/// group has of that. Components are joined in ascending order, the later ones giving way.
struct Components {
  std::vector<std::uint32_t> input;                    // by component
  std::vector<std::uint32_t> of_input;                 // by input: its component, where it is one as a whole
  std::vector<std::vector<std::uint32_t>> of_element;  // by input and surface element; empty: see of_input
  std::vector<std::uint32_t> input_order;              // all inputs in the order of their first components
  Joins joins;
  /// By kind of Joins, for each pair of groups to be joined: bit 0 if the kind is in its first group,
  /// bit 1 if in the second. Empty if no groups are named.
  std::vector<std::vector<std::uint8_t>> in_groups;

  /// Whether an input is more than one component.
  [[nodiscard]] bool are_parted() const { return !joins.mesh.empty(); }
  [[nodiscard]] std::size_t size() const { return input.size(); }
  /// Whether the `pair`-th pair of groups joins two components.
  [[nodiscard]] bool joined_by(std::uint32_t a, std::uint32_t b, std::uint32_t pair) const {
    const std::uint8_t x = in_groups[joins.kind[a]][pair], y = in_groups[joins.kind[b]][pair];
    return a != b && (((x & 1) != 0 && (y & 2) != 0) || ((x & 2) != 0 && (y & 1) != 0));
  }
  [[nodiscard]] std::uint32_t of(ElementRef e) const {
    return of_element[e.input].empty() ? of_input[e.input] : of_element[e.input][e.element.value];
  }
};

/// One for each of `n` inputs, in their order.
[[nodiscard]] inline Components one_for_each_input(std::size_t n) {
  Components all;
  for (std::uint32_t k = 0; k < n; ++k) all.input.push_back(k);
  all.of_input = all.input_order = all.input;
  all.of_element.resize(n);
  return all;
}

}  // namespace meshgraft
