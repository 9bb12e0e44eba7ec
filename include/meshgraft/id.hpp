// Typed positions in arrays.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace meshgraft {

/// Dense 0-based position in the arrays of one object; never a file label. Ids of different
/// things do not convert into each other, and each is 4 bytes.
template <class Tag>
struct Id {
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  std::uint32_t value = kNone;

  constexpr Id() = default;
  constexpr explicit Id(std::size_t position) : value(static_cast<std::uint32_t>(position)) {}
  [[nodiscard]] constexpr bool valid() const { return value != kNone; }
  friend constexpr auto operator<=>(Id, Id) = default;
};

using NodeId = Id<struct NodeTag>;              // in Model
using ElementId = Id<struct ElementTag>;        // in Model
using GroupId = Id<struct GroupTag>;            // in Model::groups, or in a table of merged groups
using GroupSetId = Id<struct GroupSetTag>;      // in GroupSets
using AttributesId = Id<struct AttributesTag>;  // in Model::attributes

/// A node of one of several inputs: `input` 0 is the base, 1 the first part.
struct NodeRef {
  std::uint32_t input = NodeId::kNone;
  NodeId node;
  [[nodiscard]] constexpr bool valid() const { return node.valid(); }
  friend constexpr auto operator<=>(NodeRef, NodeRef) = default;
};

/// An element of one of several inputs.
struct ElementRef {
  std::uint32_t input = ElementId::kNone;
  ElementId element;
  [[nodiscard]] constexpr bool valid() const { return element.valid(); }
  friend constexpr auto operator<=>(ElementRef, ElementRef) = default;
};

}  // namespace meshgraft

template <class Tag>
struct std::hash<meshgraft::Id<Tag>> {
  std::size_t operator()(meshgraft::Id<Tag> id) const noexcept { return id.value; }
};
