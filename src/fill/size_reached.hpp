// Whether a filling has triangles of the size that was asked for.
#pragma once

#include <cstddef>
#include <optional>

#include "core/complex.hpp"
#include "meshgraft/report.hpp"

namespace meshgraft {

/// A warning if no edge between faces of `complex` from `first` on comes near to the length `size`: sizes are graded
/// from the sides of the rim, which stay, and a hole may be too small to get there.
[[nodiscard]] std::optional<Warning> size_not_reached(const Complex& complex, std::size_t first, double size,
                                                      Place place);

}  // namespace meshgraft
