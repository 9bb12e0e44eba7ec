// Plain facts of a merge for the report: counts, labels, moves.
#pragma once

#include "merge/outcome.hpp"
#include "meshgraft/report.hpp"

namespace meshgraft {

/// Fills zone (but bandwidth and widened), junction, untouched (but bytes), labels, removed_*, moved.
void summarise(const Outcome& outcome, Report& report);

/// Largest memory the process has held so far, in bytes.
[[nodiscard]] std::uint64_t peak_memory_bytes();

}  // namespace meshgraft
