// What components share once they are conforming.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "intersect/corefine.hpp"

namespace meshgraft {

/// By vertex: 1 if its faces are not all of the same components.
[[nodiscard]] std::vector<std::uint8_t> shared_vertices(const Complex& complex);

/// Whether two of some components are joined.
[[nodiscard]] bool any_joined(const Joins& joins, std::span<const std::uint32_t> components);

/// Fills junction_edges, junction_points and met from the complex.
void find_shared(Corefined& corefined);

}  // namespace meshgraft
