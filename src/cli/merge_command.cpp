#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "cli/commands.hpp"
#include "cli/formats.hpp"
#include "cli/merge_outputs.hpp"
#include "cli/merge_summary.hpp"
#include "cli/outputs.hpp"
#include "cli/print.hpp"
#include "cli/progress.hpp"
#include "io/digest.hpp"
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

class Stopwatch {
 public:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

Result<void> check_files(const MergeArguments& arguments) {
  std::vector<NamedFile> inputs{{"BASE", arguments.base}}, outputs{{"-o", arguments.output}};
  for (const std::string& part : arguments.parts) inputs.push_back({"PART", part});
  if (!arguments.report.empty()) outputs.push_back({"--report", arguments.report});
  if (const auto known = writable_format(arguments.output); !known) return known;
  return check_outputs(inputs, outputs);
}

Result<Inputs> read(const MergeArguments& arguments, Progress& progress) {
  const ReadOptions options{.threads = arguments.common.threads};
  progress.show("reading " + printable(arguments.base), 0);
  auto base = read_unv(arguments.base, options);
  if (!base) return Failure(base.error());
  Inputs inputs{std::move(*base), {}};
  for (const std::string& path : arguments.parts) {
    progress.show("reading " + printable(path), kReadShare);
    auto part = read_unv(path, options);
    if (!part) return Failure(part.error());
    inputs.parts.push_back(std::move(*part));
  }
  return inputs;
}

/// What the merge cannot know: the program, the files, what was found while reading.
void complete(Report& report, const Inputs& inputs, const MergeArguments& arguments, double reading) {
  report.version = MESHGRAFT_VERSION;
  report.timings.insert(report.timings.begin(), {"read", reading});
  if (!arguments.report.empty()) {  // the digests cost a pass over all bytes
    report.inputs = {input_summary(inputs.base)};
    for (const Model& part : inputs.parts) report.inputs.push_back(input_summary(part));
  }
}

bool parts_apart(const Report& report) {
  return std::ranges::find(report.warnings, name(ErrorCode::kPartsApart), &Warning::name) != report.warnings.end();
}

/// Writes, or says why not.
///   returns   the last line of the summary
Result<std::string> write(const MergeArguments& arguments, const Inputs& inputs, Merged& merged) {
  const std::vector<Error>& broken = merged.report.broken_promises;
  for (const Error& promise : broken) print_error(promise);
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
  const Stopwatch reading;
  const auto inputs = read(arguments, progress);
  progress.clear();
  if (!inputs) return failed(inputs.error());
  const double read_seconds = reading.seconds();

  MergeOptions options = arguments.options;
  options.progress = [&](std::string_view stage, double done) {
    progress.show(stage, kReadShare + kMergeShare * done);
  };
  auto merged = merge(inputs->base, inputs->parts, options);
  progress.clear();
  if (!merged) return failed(merged.error());
  Report& report = merged->report;
  complete(report, *inputs, arguments, read_seconds);
  print_warnings(report.warnings, arguments.common.talk);

  progress.show("writing " + printable(arguments.output), kReadShare + kMergeShare);
  const auto written = write(arguments, *inputs, *merged);
  progress.clear();
  if (!written) return failed(written.error());
  if (!quiet) print_summary(report, arguments, *written);
  if (!report.broken_promises.empty()) return kPromiseNotMet;
  return parts_apart(report) ? kPartsDoNotMeet : kDone;
}

}  // namespace meshgraft::cli
