// Reads the values of options. Decimal points only, whatever the locale.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "meshgraft/options.hpp"
#include "meshgraft/result.hpp"

namespace meshgraft::cli {

/// A value as typed and the option it was given to; messages name both.
struct Typed {
  std::string option;  // "--angle"
  std::string text;
};

/// Usage error: "--angle: '95' is out of range", with what is allowed as the hint.
[[nodiscard]] Failure wrong_value(const Typed& typed, std::string_view why, std::string_view allowed);

struct Range {
  double low, high;
  bool low_included = true, high_included = true;
  std::string_view allowed;  // in words, with the unit
};

/// Errors (kUsage): not a finite number, outside the range.
[[nodiscard]] Result<double> number_in(const Typed& typed, const Range& range);
/// Errors (kUsage): not a whole number, outside [low, high].
[[nodiscard]] Result<int> integer_in(const Typed& typed, int low, int high, std::string_view allowed);

/// `n` numbers with commas between them.
[[nodiscard]] Result<std::vector<double>> numbers(const Typed& typed, std::size_t n, std::string_view allowed);

/// `LEN` in file units, or `N%` of the local edge length; not negative.
[[nodiscard]] Result<Tolerance> tolerance(const Typed& typed);
/// `LEN` > 0 in file units; nothing for `auto`.
[[nodiscard]] Result<std::optional<double>> size(const Typed& typed);
/// `beyond=LEN` with LEN > 0 in file units; nothing for `none`.
[[nodiscard]] Result<std::optional<double>> trim(const Typed& typed);
/// `N` >= 1; nothing for `auto`.
[[nodiscard]] Result<std::optional<int>> bandwidth(const Typed& typed);

/// `A:B`, two names of groups. Errors (kUsage): no colon or several, an empty name.
[[nodiscard]] Result<JoinedGroups> joined_groups(const Typed& typed);

/// One of a few names.
///   returns   position in `names`
[[nodiscard]] Result<std::size_t> choice(const Typed& typed, std::span<const std::string> names);

}  // namespace meshgraft::cli
