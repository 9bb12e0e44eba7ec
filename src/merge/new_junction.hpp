// The junction without what was one before.
#pragma once

#include "merge/junction_summary.hpp"
#include "merge/outcome.hpp"

namespace meshgraft {

/// junction_of(outcome.final_complex) without the edges and points that the same components share in their input:
/// groups of one mesh that are joined elsewhere. Edges are those of before if their ends and middle are within
/// `max_distance` times their length of them.
[[nodiscard]] Junction new_junction(const Outcome& outcome, double max_distance);

}  // namespace meshgraft
