// Results go to stdout, all else to stderr.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "cli/arguments.hpp"
#include "meshgraft/result.hpp"

namespace meshgraft::cli {

/// Unlike fmt::print, does not throw if `to` takes nothing; see results_arrived.
template <class... Values>
void say(std::FILE* to, fmt::format_string<Values...> form, Values&&... values) {
  const std::string text = fmt::format(form, std::forward<Values>(values)...);
  std::fwrite(text.data(), 1, text.size(), to);
}

/// A result: the label in a column of its own; later lines of `text` are aligned below the first.
void print_line(std::string_view label, std::string_view text);

void print_error(const Error& error);
/// The first few of each name, unless verbose, and how many more there are.
void print_warnings(std::span<const Warning> warnings, Talk talk);

/// `1 face`, `2 faces`.
[[nodiscard]] std::string counted(std::uint64_t n, std::string_view one, std::string_view many);
/// A measured figure, to the digits that mean something.
[[nodiscard]] std::string figure(double value);
/// `1.2 MB`.
[[nodiscard]] std::string bytes(std::uint64_t n);
/// The text of a file without what would upset a terminal: control characters become `?`.
[[nodiscard]] std::string printable(std::string_view text);

/// Error kCannotWrite if something printed to stdout did not arrive (disk full, closed).
[[nodiscard]] Result<void> results_arrived();

}  // namespace meshgraft::cli
