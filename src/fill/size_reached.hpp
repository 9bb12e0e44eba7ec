// Whether a filling has triangles of the size that was asked for.
#pragma once

#include <cstddef>
#include <optional>

#include "core/complex.hpp"
#include "meshgraft/report.hpp"

namespace meshgraft {

/// A warning if in some filling (faces of `complex` from `first` on that hang together) no edge between two faces
/// comes near to the length `size`: sizes are graded from the sides of the rim, which stay, and a hole may be too small
/// to get there. It names the filling that is farthest off.
[[nodiscard]] std::optional<Warning> size_not_reached(const Complex& complex, std::size_t first, double size,
                                                      Place place);

}  // namespace meshgraft
