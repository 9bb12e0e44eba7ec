// What the commands that make a mesh have in common: read, work, write, tell.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "cli/arguments.hpp"
#include "cli/exit_codes.hpp"
#include "cli/outputs.hpp"
#include "merge/stopwatch.hpp"
#include "meshgraft/merge.hpp"

namespace meshgraft::cli {

struct MeshCommand {
  std::vector<NamedFile> inputs;  // the base first
  std::size_t n_parts = 0;        // those after it whose entities come into the output
  /// The work itself, on the inputs in their order.
  std::function<Result<Merged>(std::span<const Model> inputs, const Stopwatch::Progress& progress)> run;
};

/// Reads the inputs, runs the command, writes the mesh and the report that `arguments` name, and prints
/// warnings, errors and the summary.
[[nodiscard]] ExitCode run(const MeshCommand& command, const MergeArguments& arguments);

}  // namespace meshgraft::cli
