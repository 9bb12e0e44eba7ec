#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "cli/commands.hpp"
#include "cli/formats.hpp"
#include "cli/merge_outputs.hpp"
#include "cli/merge_summary.hpp"
#include "cli/outputs.hpp"
#include "cli/print.hpp"
#include "cli/progress.hpp"
#include "io/digest.hpp"
#include "merge/stopwatch.hpp"
#include "meshgraft/merge.hpp"
#include "meshgraft/unv.hpp"

namespace meshgraft::cli {
namespace {

// Shares of the progress line.
constexpr double kReadShare = 0.3, kMergeShare = 0.6;

struct Inputs {
  Model base;
  std::vector<Model> parts;
};

Result<void> check_files(const MergeArguments& arguments) {
  std::vector<NamedFile> inputs{{"BASE", arguments.base}}, outputs{{"-o", arguments.output}};
  for (const std::string& part : arguments.parts) inputs.push_back({"PART", part});
  outputs.push_back({"the side file of -o", arguments.output + ".carry"});
  if (!arguments.report.empty()) outputs.push_back({"--report", arguments.report});
  if (const auto known = writable_format(arguments.output); !known) return known;
  return check_outputs(inputs, outputs);
}

Result<Inputs> read(const MergeArguments& arguments, const Stopwatch::Progress& show) {
  const ReadOptions options{.threads = arguments.common.threads};
  show("reading " + printable(arguments.base), 0);
  auto base = read_unv(arguments.base, options);
  if (!base) return Failure(base.error());
  Inputs inputs{std::move(*base), {}};
  for (const std::string& path : arguments.parts) {
    show("reading " + printable(path), kReadShare);
    auto part = read_unv(path, options);
    if (!part) return Failure(part.error());
    inputs.parts.push_back(std::move(*part));
  }
  return inputs;
}

/// What the merge cannot know: the digests, and the time before it. Digests cost a pass over all bytes.
void complete(Report& report, const Inputs& inputs, const MergeArguments& arguments, const Stopwatch& watch) {
  report.timings.insert(report.timings.begin(), watch.timings().begin(), watch.timings().end());
  if (arguments.report.empty()) return;
  report.inputs = {input_summary(inputs.base)};
  for (const Model& part : inputs.parts) report.inputs.push_back(input_summary(part));
}

/// What was found while reading, if no report comes to tell it.
void print_reading_warnings(const Inputs& inputs, Talk talk) {
  print_warnings(inputs.base.warnings, talk);
  for (const Model& part : inputs.parts) print_warnings(part.warnings, talk);
}

bool parts_apart(const Report& report) {
  return std::ranges::find(report.warnings, name(ErrorCode::kPartsApart), &Warning::name) != report.warnings.end();
}

/// Writes, or says why not.
///   returns   the last line of the summary
Result<std::string> write(const MergeArguments& arguments, const Inputs& inputs, Merged& merged) {
  const std::vector<Error>& broken = merged.report.broken_promises;
  if (!broken.empty() && !arguments.allow_poor) {
    const auto done = write_report(arguments, merged.report);
    if (!done) return Failure(done.error());
    return fmt::format("nothing: {} not met; --allow-poor writes the mesh all the same",
                       broken.size() == 1 ? "a promise is" : fmt::format("{} promises are", broken.size()));
  }
  const auto done = write_outputs(arguments, inputs.base, inputs.parts, merged);
  if (!done) return Failure(done.error());
  return printable(arguments.output);
}

}  // namespace

ExitCode run(const MergeArguments& arguments) {
  if (const auto good = check_files(arguments); !good) return failed(good.error());
  const bool quiet = arguments.common.talk == Talk::kQuiet;
  Progress progress(!quiet);
  const Stopwatch::Progress show = [&](std::string_view stage, double done) { progress.show(stage, done); };
  Stopwatch watch(show);
  watch.start("read", 0);
  const auto inputs = read(arguments, show);
  watch.stop();
  progress.clear();
  if (!inputs) return failed(inputs.error());

  MergeOptions options = arguments.options;
  options.progress = [&](std::string_view stage, double done) { show(stage, kReadShare + kMergeShare * done); };
  auto merged = merge(inputs->base, inputs->parts, options);
  progress.clear();
  if (!merged) {
    print_reading_warnings(*inputs, arguments.common.talk);
    return failed(merged.error());
  }
  Report& report = merged->report;
  print_warnings(report.warnings, arguments.common.talk);
  for (const Error& promise : report.broken_promises) print_error(promise);
  const std::size_t told = report.warnings.size();

  show("writing " + printable(arguments.output), kReadShare + kMergeShare);
  complete(report, *inputs, arguments, watch);
  const auto written = write(arguments, *inputs, *merged);
  progress.clear();
  if (!written) return failed(written.error());
  print_warnings(std::span(report.warnings).subspan(told), arguments.common.talk);
  if (!quiet) print_summary(report, arguments, *written);
  if (!report.broken_promises.empty()) return kPromiseNotMet;
  return parts_apart(report) ? kPartsDoNotMeet : kDone;
}

}  // namespace meshgraft::cli
