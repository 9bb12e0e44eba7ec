// Whether what was filled lies back on itself.
#pragma once

#include <vector>

#include "core/complex.hpp"

namespace meshgraft {

/// Middles of the edges between two faces from `first` on that make more than 90 degrees with each other.
[[nodiscard]] std::vector<Vec3> folds(const Complex& complex, std::size_t first);

}  // namespace meshgraft
