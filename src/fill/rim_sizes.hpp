// Edge lengths wanted in a hole.
#pragma once

#include <optional>
#include <set>
#include <span>

#include "fill/patched.hpp"

namespace meshgraft {

/// Edge lengths of patches, from the sides of the rims and the beams that are followed, which stay as they are.
struct RimSizing {
  Sizing fine;    // those of the faces around the rims, the near ones counting most, or `size`; graded from the sides
  Sizing coarse;  // as coarse as the distance from the sides allows, for a first mesh that only tells the shape
};

/// Cost of a length: O(log n), n sides of all rims.
[[nodiscard]] RimSizing rim_sizing(const Complex& around, std::span<const Hole> holes, const std::set<NodePair>& beams,
                                   std::optional<double> size);

}  // namespace meshgraft
