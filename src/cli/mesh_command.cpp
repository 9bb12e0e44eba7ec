#include "cli/mesh_command.hpp"

#include <fmt/format.h>
#include <tbb/task_group.h>

#include <algorithm>

#include "cli/commands.hpp"
#include "cli/formats.hpp"
#include "cli/merge_outputs.hpp"
#include "cli/merge_summary.hpp"
#include "cli/outputs.hpp"
#include "cli/print.hpp"
#include "cli/progress.hpp"
#include "io/digest.hpp"
#include "io/side_file.hpp"
#include "meshgraft/unv.hpp"

namespace meshgraft::cli {
namespace {

// Shares of the progress line.
constexpr double kReadShare = 0.3, kWorkShare = 0.6;

Result<void> check_files(const MeshCommand& command, const MergeArguments& arguments) {
  std::vector<NamedFile> outputs{{"-o", arguments.output}};
  const NamedFile side{"the side file of -o", side_path(arguments.output)};
  outputs.push_back(side);
  if (!arguments.report.empty()) outputs.push_back({"--report", arguments.report});
  if (const auto known = writable_format(arguments.output); !known) return known;
  if (const auto good = check_inputs(command.inputs); !good) return good;
  if (const auto good = check_outputs(command.inputs, outputs); !good) return good;
  if (!is_side_path_taken(arguments.output)) return {};
  return failure(
      ErrorCode::kCannotWrite,
      fmt::format("is there and no file of meshgraft; a merge puts {} there or removes an old one", side.role),
      "move it away, or give another name to -o", {side.path, 0});
}

Result<std::vector<Model>> read(const MeshCommand& command, const Common& common, const Stopwatch::Progress& show) {
  const ReadOptions options{.threads = common.threads};
  std::vector<Model> inputs;
  for (const NamedFile& file : command.inputs) {
    show("reading " + printable(file.path), inputs.empty() ? 0 : kReadShare);
    auto model = read_unv(file.path, options);
    if (!model) return Failure(model.error());
    inputs.push_back(std::move(*model));
  }
  return inputs;
}

/// Does the work of the command, and beside it, if a report is wanted, what the work cannot know of its inputs:
/// their digests cost a pass over all bytes.
Result<Merged> worked(const MeshCommand& command, const MergeArguments& arguments, const std::vector<Model>& inputs,
                      const Stopwatch::Progress& show) {
  std::vector<InputSummary> summaries(inputs.size());
  tbb::task_group beside;
  if (!arguments.report.empty())
    for (std::size_t k = 0; k < inputs.size(); ++k) beside.run([&, k] { summaries[k] = input_summary(inputs[k]); });
  auto merged =
      command.run(inputs, [&](std::string_view stage, double done) { show(stage, kReadShare + kWorkShare * done); });
  beside.wait();
  if (merged && !arguments.report.empty()) merged->report.inputs = std::move(summaries);
  return merged;
}

bool parts_apart(const Report& report) {
  return std::ranges::find(report.warnings, name(ErrorCode::kPartsApart), &Warning::name) != report.warnings.end();
}

/// Writes, or says why not.
///   returns   the last line of the summary
Result<std::string> write(const MergeArguments& arguments, const MeshCommand& command, std::span<const Model> inputs,
                          Merged& merged) {
  const std::vector<Error>& broken = merged.report.broken_promises;
  if (!broken.empty() && !arguments.allow_poor) {
    const auto done = write_report(arguments, merged.report);
    if (!done) return Failure(done.error());
    return fmt::format("nothing: {} not met; --allow-poor writes the mesh all the same",
                       broken.size() == 1 ? "a promise is" : fmt::format("{} promises are", broken.size()));
  }
  const auto done = write_outputs(arguments, inputs.front(), inputs.subspan(1, command.n_parts), merged);
  if (!done) return Failure(done.error());
  return printable(arguments.output);
}

}  // namespace

ExitCode run(const MeshCommand& command, const MergeArguments& arguments) {
  if (const auto good = check_files(command, arguments); !good) return failed(good.error());
  const bool quiet = arguments.common.talk == Talk::kQuiet;
  const bool stdout_is_taken = is_stdout(arguments.output) || is_stdout(arguments.report);
  Progress progress(!quiet);
  const Stopwatch::Progress show = [&](std::string_view stage, double done) { progress.show(stage, done); };
  Stopwatch watch(show);
  watch.start("read", 0);
  const auto inputs = read(command, arguments.common, show);
  watch.stop();
  progress.clear();
  if (!inputs) return failed(inputs.error());

  auto merged = worked(command, arguments, *inputs, show);
  progress.clear();
  if (!merged) {
    for (const Model& model : *inputs) print_warnings(model.warnings, arguments.common.talk);
    return failed(merged.error());
  }
  Report& report = merged->report;
  print_warnings(report.warnings, arguments.common.talk);
  for (const Error& promise : report.broken_promises) print_error(promise);
  const std::size_t told = report.warnings.size();

  show("writing " + printable(arguments.output), kReadShare + kWorkShare);
  report.timings.insert(report.timings.begin(), watch.timings().begin(), watch.timings().end());
  const auto written = write(arguments, command, *inputs, *merged);
  progress.clear();
  if (!written) return failed(written.error());
  print_warnings(std::span(report.warnings).subspan(told), arguments.common.talk);
  if (!quiet && !stdout_is_taken) print_summary(report, arguments, *written);
  if (!report.broken_promises.empty()) return kPromiseNotMet;
  return parts_apart(report) ? kPartsDoNotMeet : kDone;
}

}  // namespace meshgraft::cli
