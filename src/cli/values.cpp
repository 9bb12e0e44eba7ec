#include "cli/values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "cli/nearest.hpp"

namespace meshgraft::cli {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kMostNeighbourhoods = 100;  // no mesh asks for more; catches lengths given by mistake
constexpr std::string_view kAuto = "auto";

template <class Number>
std::optional<Number> parsed(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

Failure not_a_number(const Typed& typed, std::string_view kind, std::string_view allowed) {
  const bool comma = typed.text.find(',') != std::string::npos;
  return wrong_value(typed, fmt::format("is not {}{}", kind, comma ? "; decimals are written with a point" : ""),
                     allowed);
}

}  // namespace

Failure wrong_value(const Typed& typed, std::string_view why, std::string_view allowed) {
  return failure(ErrorCode::kUsage, fmt::format("{}: '{}' {}", typed.option, typed.text, why),
                 fmt::format("{} takes {}", typed.option, allowed));
}

Result<double> number_in(const Typed& typed, const Range& range) {
  const auto value = parsed<double>(typed.text);
  if (!value || !std::isfinite(*value)) return not_a_number(typed, "a number", range.allowed);
  const bool low_enough = range.high_included ? *value <= range.high : *value < range.high;
  const bool high_enough = range.low_included ? *value >= range.low : *value > range.low;
  if (!low_enough || !high_enough) return wrong_value(typed, "is out of range", range.allowed);
  return *value;
}

Result<int> integer_in(const Typed& typed, int low, int high, std::string_view allowed) {
  const auto value = parsed<int>(typed.text);
  if (!value) return not_a_number(typed, "a whole number", allowed);
  if (*value < low || *value > high) return wrong_value(typed, "is out of range", allowed);
  return *value;
}

Result<std::vector<double>> numbers(const Typed& typed, std::size_t n, std::string_view allowed) {
  std::vector<double> values;
  std::string_view rest = typed.text;
  for (bool more = true; more;) {
    const std::size_t comma = rest.find(',');
    more = comma != std::string_view::npos;
    const auto value = parsed<double>(rest.substr(0, comma));
    if (!value || !std::isfinite(*value)) return wrong_value(typed, "is not a list of numbers", allowed);
    values.push_back(*value);
    if (more) rest.remove_prefix(comma + 1);
  }
  if (values.size() != n) return wrong_value(typed, fmt::format("has {} numbers", values.size()), allowed);
  return values;
}

Result<Tolerance> tolerance(const Typed& typed) {
  constexpr std::string_view kAllowed =
      "a length in the unit of the file, as in 0.5, or a share of the local edge length, as in 1%; 0 or more";
  constexpr Range kRange{.low = 0, .high = kInfinity, .allowed = kAllowed};
  constexpr double kPercent = 100;
  Typed number = typed;
  const bool relative = number.text.ends_with('%');
  if (relative) number.text.pop_back();
  const auto value = number_in(number, kRange);
  if (!value) return wrong_value(typed, "is neither a length nor a share", kAllowed);
  return Tolerance{relative ? *value / kPercent : *value, relative};
}

Result<std::optional<double>> size(const Typed& typed) {
  constexpr Range kRange{.low = 0,
                         .high = kInfinity,
                         .low_included = false,
                         .allowed = "a length greater than 0 in the unit of the file, or auto"};
  if (typed.text == kAuto) return std::nullopt;
  return number_in(typed, kRange).map([](double length) { return std::optional(length); });
}

Result<std::optional<double>> trim(const Typed& typed) {
  constexpr std::string_view kBeyond = "beyond=";
  constexpr Range kRange{.low = 0,
                         .high = kInfinity,
                         .low_included = false,
                         .allowed = "none, or beyond=LEN with a length greater than 0 in the unit of the file"};
  if (typed.text == "none") return std::nullopt;
  if (!typed.text.starts_with(kBeyond)) return wrong_value(typed, "is not known", kRange.allowed);
  return number_in({typed.option, typed.text.substr(kBeyond.size())}, kRange).map([](double length) {
    return std::optional(length);
  });
}

Result<std::optional<int>> bandwidth(const Typed& typed) {
  if (typed.text == kAuto) return std::nullopt;
  return integer_in(typed, 1, kMostNeighbourhoods, "a number of neighbourhoods from 1 to 100, or auto").map([](int n) {
    return std::optional(n);
  });
}

Result<JoinedGroups> joined_groups(const Typed& typed) {
  const std::size_t colon = typed.text.find(':');
  const bool two_names = colon != std::string::npos && colon > 0 && colon + 1 < typed.text.size();
  if (!two_names || typed.text.find(':', colon + 1) != std::string::npos)
    return wrong_value(typed, "is not two names", "two names of element groups with one colon between them");
  return JoinedGroups{typed.text.substr(0, colon), typed.text.substr(colon + 1)};
}

Result<std::size_t> choice(const Typed& typed, std::span<const std::string> names) {
  const auto found = std::ranges::find(names, typed.text);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  const std::string allowed = fmt::format("{}", fmt::join(names, " or "));
  const auto near = nearest(typed.text, names);
  return wrong_value(typed, near ? fmt::format("is not known; did you mean '{}'?", *near) : "is not known", allowed);
}

}  // namespace meshgraft::cli
