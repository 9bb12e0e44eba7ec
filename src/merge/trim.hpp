// Loose ends of parts that stick out beyond what they are joined to (`--trim beyond`).
#pragma once

#include <vector>

#include "merge/dropped.hpp"
#include "merge/outcome.hpp"
#include "meshgraft/options.hpp"
#include "meshgraft/result.hpp"

namespace meshgraft {

/// Drops the loose ends of parts, and tells which they were. `original`: the workpiece before it was cut.
///
/// A loose end is a piece of a part that
///  (1) the junction cuts off the rest of its part, along one connected line;
///  (2) has a free edge, and all nodes nearer than `length` to that line;
///  (3) nothing else holds: no 1D element beside its own edges, no other element, no other part.
/// Of two pieces on either side of one line, neither is dropped if both are such.
std::vector<DroppedEntry> trim(const Complex& original, Corefined& corefined, double length, const Graft& graft,
                               Dropped& dropped);

/// Warnings sticks-out, one for each part with loose ends no deeper than the tolerance beyond what it is joined to, and
/// no longer than kLongestWay times that from the line that cuts them off: how many, the longest of them, where. They
/// are penetrations that were to be closed, and could not be drawn back.
[[nodiscard]] std::vector<Warning> loose_end_warnings(const Outcome& outcome, const Tolerance& tolerance);

}  // namespace meshgraft
