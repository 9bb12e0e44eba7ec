// Writes what a merge leaves: the mesh, its report, or both, or neither.
#pragma once

#include <span>

#include "cli/arguments.hpp"
#include "meshgraft/merge.hpp"

namespace meshgraft::cli {

/// Writes mesh and report. If one of them fails, files that were there before stay as they are, and
/// none is new. Completes merged.report (bytes untouched, fate of datasets).
///
/// Errors: kCannotWrite, kLabelOverflow, kCannotHold.
[[nodiscard]] Result<void> write_outputs(const MergeArguments& arguments, const Model& base,
                                         std::span<const Model> parts, Merged& merged);

/// Writes the report alone, if one is wanted.
[[nodiscard]] Result<void> write_report(const MergeArguments& arguments, const Report& report);

}  // namespace meshgraft::cli
