// Pieces of inputs that were not joined although others of the same input were.
#pragma once

#include <vector>

#include "merge/outcome.hpp"
#include "meshgraft/result.hpp"

namespace meshgraft {

/// piece-apart, one for each input: elements that hang together through nodes, at least one of them a line or with a
/// surface, and that met nothing. Of parts; of the base where it is joined with itself. Not where groups to be joined
/// are named: what is not named is meant to be left alone.
///
/// Cost: linear in the inputs looked at; n log n more for the distance where there is something to tell.
[[nodiscard]] std::vector<Warning> loose_piece_warnings(const Outcome& outcome);

}  // namespace meshgraft
