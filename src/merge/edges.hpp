// Edges of a complex with the faces on them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/complex.hpp"

namespace meshgraft {

/// One face on one edge.
struct FaceOnEdge {
  VertexId low, high;  // low < high
  FaceId face;
  friend constexpr auto operator<=>(FaceOnEdge, FaceOnEdge) = default;
};

/// Ascending: uses of one edge stand together. Only edges both of whose ends `wanted` marks (by
/// vertex; empty: all).
[[nodiscard]] std::vector<FaceOnEdge> edge_uses(const Complex& complex, std::span<const std::uint8_t> wanted = {});

/// From an edge to the third corner of a face on it, at right angles to the edge.
[[nodiscard]] Vec3 across(const Complex& complex, const FaceOnEdge& use);

/// Angle between two faces on one edge, radians: 0 if the surface is flat there.
[[nodiscard]] double fold_angle(const Complex& complex, const FaceOnEdge& a, const FaceOnEdge& b);

/// Calls f(std::span<const FaceOnEdge>) once for each edge.
template <class F>
void for_each_edge(std::span<const FaceOnEdge> uses, F&& f) {
  for (std::size_t first = 0; first < uses.size();) {
    std::size_t last = first + 1;
    while (last < uses.size() && uses[last].low == uses[first].low && uses[last].high == uses[first].high) ++last;
    f(uses.subspan(first, last - first));
    first = last;
  }
}

}  // namespace meshgraft
