// The existing name that a mistyped one stands for.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace meshgraft::cli {

/// Least number of letters inserted, removed, replaced or swapped with their neighbour that turns
/// `a` into `b` (no stretch of letters edited twice). Cost: product of the lengths.
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// The name nearest to `typed`, if it is near: at most one edit for each three letters, or `typed`
/// is the beginning of it. The first of equally near ones.
[[nodiscard]] std::optional<std::string> nearest(std::string_view typed, std::span<const std::string> names);

}  // namespace meshgraft::cli
