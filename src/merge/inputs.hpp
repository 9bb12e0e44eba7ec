// The inputs of one merge, and how places in them are named in messages.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "core/text.hpp"
#include "meshgraft/model.hpp"

namespace meshgraft {

/// 0 the base, then the parts. Never empty.
using Inputs = std::span<const Model* const>;

/// Of elements of a surface that was made from numbers: nobody knows them.
inline constexpr std::int64_t kNoLabel = 0;

/// "element 57 of plate.unv"; of an element without a label only the name of the surface.
[[nodiscard]] std::string text_of(Inputs inputs, ElementRef element);

/// "a.unv", "a.unv and b.unv", "a.unv, b.unv and c.unv".
[[nodiscard]] std::string joined(std::span<const std::string> names);

/// Corner nodes of an element with a surface in order (3 or 4), the two ends of a line; else none.
/// The nodes between corners of parabolic elements are left out.
struct Corners {
  std::array<NodeId, 4> node;
  std::size_t n = 0;
  [[nodiscard]] bool is_surface() const { return n >= 3; }
};
[[nodiscard]] Corners corners_of(Shape shape, std::span<const NodeId> nodes);

}  // namespace meshgraft
