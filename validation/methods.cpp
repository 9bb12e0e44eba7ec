// meshgraft_methods: the methods of filling beside each other on scenes of the catalogue, as a table in Markdown.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <ctime>
#include <filesystem>
#include <iostream>

#include "meshgraft/merge.hpp"
#include "meshgraft/unv.hpp"
#include "support/catalogue.hpp"

namespace meshgraft::validation {
namespace {

/// One scene for each kind of place that decides between the methods.
constexpr std::array kScenes{
    "crossing_90",        "crossing_10",           "ending_90",         "fine_part_1_3",
    "fine_part_1_10",     "coarse_part_3_1",       "across_whole_wall", "on_grid_line",
    "beside_free_edge",   "across_t_line",         "beside_t_line",     "sphere_and_plate",
    "cylinder_and_rib",   "cylinder_and_flange",   "two_pipes",         "coarse_pipe_fine_branch",
    "two_parts_crossing", "three_through_a_point", "grid_3_by_3",       "doubler",
    "doubler_fine_1_8",   "partial_overlap_1_1",   "saddle_pad"};

struct NamedMethod {
  const char* name;
  Method method;
};
constexpr std::array kMethods{NamedMethod{"adaptive", Method::kAdaptive}, NamedMethod{"paper", Method::kPaper}};

/// Processor time of all threads, in seconds.
double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Measured {
  Merged merged;
  double seconds = 0;
};

/// The fastest of several runs, which all give the same.
Result<Measured> measured(const scenes::Merge& scene, const MergeOptions& options, int runs) {
  Measured best;
  for (int run = 0; run < runs; ++run) {
    const double start = processor_time();
    auto merged = merge(scene.base, scene.parts, options);
    const double seconds = processor_time() - start;
    if (!merged) return Failure(merged.error());
    if (run == 0 || seconds < best.seconds) best = {std::move(*merged), seconds};
  }
  return best;
}

/// What keeps a result from being written, by name, each once.
std::string broken(const Report& report) {
  std::vector<std::string> names;
  for (const Error& e : report.broken_promises)
    if (std::ranges::find(names, name(e.code)) == names.end()) names.emplace_back(name(e.code));
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string row(const scenes::Merge& scene, const NamedMethod& method, const Result<Measured>& result) {
  const std::string head = fmt::format("| {} | {} ", scene.name, method.name);
  if (!result) return head + fmt::format("| | | | | | | | {} |\n", name(result.error().code));
  const Report& r = result->merged.report;
  return head + fmt::format("| {:.3f} | {:.3f} | {} | {:.2f} % | {} | {} | {:.0f} ms | {} |\n", r.quality.min,
                            r.quality.mean, r.quality.below, 100 * r.fidelity->max_distance_relative,
                            r.zone.faces_removed, r.zone.faces_created, 1000 * result->seconds, broken(r));
}

/// Inputs and result as files, for pictures.
Result<void> write_files(const scenes::Merge& scene, const NamedMethod& method, const Merged& merged,
                         const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  auto done = write_unv(scene.base, (folder / (scene.name + "_base.unv")).string());
  for (std::size_t k = 0; done && k < scene.parts.size(); ++k)
    done = write_unv(scene.parts[k], (folder / fmt::format("{}_part_{}.unv", scene.name, k + 1)).string());
  return done ? write_unv(apply(scene.base, scene.parts, merged),
                          (folder / fmt::format("{}_{}.unv", scene.name, method.name)).string())
              : done;
}

int run(const std::string& folder, const std::vector<std::string>& drawn, int runs) {
  std::vector<scenes::Merge> all = scenes::catalogue();
  for (scenes::Merge& scene : scenes::contact_catalogue()) all.push_back(std::move(scene));
  std::cout
      << "| scene | method | worst Q | mean Q | below 0.5 | off the surface | faces removed | made | time | refused |\n"
         "|---|---|---|---|---|---|---|---|---|---|\n";
  for (const char* wanted : kScenes) {
    const auto scene = std::ranges::find(all, wanted, &scenes::Merge::name);
    if (scene == all.end()) return std::cerr << "no scene " << wanted << '\n', 1;
    for (const NamedMethod& method : kMethods) {
      MergeOptions options = scene->options;
      options.method = method.method;
      const auto result = measured(*scene, options, runs);
      std::cout << row(*scene, method, result) << std::flush;
      if (!result || std::ranges::find(drawn, wanted) == drawn.end()) continue;
      if (const auto written = write_files(*scene, method, result->merged, folder); !written)
        return std::cerr << to_string(written.error()) << '\n', 1;
    }
  }
  return 0;
}

}  // namespace
}  // namespace meshgraft::validation

int main(int argc, char** argv) {
  std::string folder;
  std::vector<std::string> drawn;
  int runs = 3;
  CLI::App app{"Merges scenes of the catalogue by each method and prints a table."};
  app.add_option("--draw", drawn, "scenes to be written as files");
  app.add_option("-o,--output", folder, "where to")->needs("--draw");
  app.add_option("--runs", runs, "of each merge; the fastest counts")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  return meshgraft::validation::run(folder, drawn, runs);
}
