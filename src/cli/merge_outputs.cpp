#include "cli/merge_outputs.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "cli/deferred_signals.hpp"
#include "cli/outputs.hpp"
#include "io/atomic_output.hpp"
#include "io/side_file.hpp"
#include "merge/stopwatch.hpp"
#include "meshgraft/unv.hpp"

namespace meshgraft::cli {
namespace {

namespace fs = std::filesystem;

/// A mesh and its side file under a name of their own, until they are renamed or dropped.
class StagedMesh {
 public:
  explicit StagedMesh(std::string target)
      : target_(std::move(target)), staged_(fmt::format("{}.{}.staged", target_, ::getpid())) {}
  StagedMesh(const StagedMesh&) = delete;
  StagedMesh& operator=(const StagedMesh&) = delete;
  ~StagedMesh() {
    std::error_code ignored;
    fs::remove(staged_, ignored);
    fs::remove(side_path(staged_), ignored);
  }

  [[nodiscard]] const std::string& path() const { return staged_; }

  Result<void> publish() {
    std::error_code error, ignored;
    const bool has_side_file = fs::exists(side_path(staged_), ignored);
    const bool taken = is_side_path_taken(target_);
    if (has_side_file && taken) error = std::make_error_code(std::errc::file_exists);
    if (!error && has_side_file) fs::rename(side_path(staged_), side_path(target_), error);
    if (!error) fs::rename(staged_, target_, error);
    if (!error && !has_side_file && !taken) fs::remove(side_path(target_), ignored);  // as write_unv does
    if (!error) return {};
    return failure(ErrorCode::kCannotWrite, fmt::format("the finished file cannot be put there: {}", error.message()),
                   "choose another name or directory", {target_, 0});
  }

 private:
  std::string target_, staged_;
};

/// write_unv, with its time among the others.
Result<void> write_mesh(const Model& base, std::span<const Model> parts, Merged& merged, const std::string& path) {
  const Stopwatch::Progress silent;
  Stopwatch watch(silent);
  watch.start("write", 1);
  Result<void> done = write_unv(base, parts, merged, path, merged.report);
  watch.stop();
  merged.report.timings.push_back(watch.timings().back());
  return done;
}

}  // namespace

Result<void> write_report(const MergeArguments& arguments, const Report& report) {
  if (arguments.report.empty()) return {};
  auto output = AtomicOutput::create(arguments.report);
  if (!output) return Failure(output.error());
  Result<void> done = output->write(to_json(report));
  return done ? output->commit() : done;
}

Result<void> write_outputs(const MergeArguments& arguments, const Model& base, std::span<const Model> parts,
                           Merged& merged) {
  const DeferredSignals whole_or_not_at_all;
  if (arguments.report.empty() || !is_replaced(arguments.output)) {
    const auto written = write_mesh(base, parts, merged, arguments.output);
    return written ? write_report(arguments, merged.report) : written;
  }
  // The report needs figures of the writer, and either file may fail: the mesh waits for the report.
  StagedMesh mesh(without_links(arguments.output));
  Result<void> done = write_mesh(base, parts, merged, mesh.path());
  if (!done && done.error().place.file == mesh.path()) done.error().place.file = arguments.output;
  if (done) done = write_report(arguments, merged.report);
  return done ? mesh.publish() : done;
}

}  // namespace meshgraft::cli
