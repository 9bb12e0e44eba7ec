// Results go to stdout, all else to stderr.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "cli/arguments.hpp"
#include "meshgraft/result.hpp"

namespace meshgraft::cli {

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
