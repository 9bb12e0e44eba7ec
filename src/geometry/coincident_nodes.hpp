// Nodes at one place.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "meshgraft/vec3.hpp"

namespace meshgraft {

/// For each node that lies within `tolerance` (a length) of one with a smaller position in the array: the smallest
/// such one and itself; ascending by the second. So k nodes at one place give k - 1 pairs. Cost O(n log n).
[[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> coincident_nodes(std::span<const Vec3> position,
                                                                                    double tolerance);

}  // namespace meshgraft
