#include "results.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <set>

namespace meshgraft::bench {
namespace {

constexpr double kMillion = 1e6;
const std::string kStage = "s:";  // prefix of the counters that are stages
const std::string kCpu = "cpu";   // seconds of all threads; the least of all runs is kept

double counter(const Results::Measured* m, const std::string& name) {
  const auto it = m->counters.find(name);
  return it == m->counters.end() ? 0 : it->second;
}

}  // namespace

void Results::ReportRuns(const std::vector<Run>& runs) {
  ConsoleReporter::ReportRuns(runs);
  for (const Run& run : runs) {
    if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
    Measured measured{run.real_accumulated_time / static_cast<double>(run.iterations), {}};
    for (const auto& [name, value] : run.counters) measured.counters[name] = value.value;
    const auto key = std::pair(run.run_name.function_name, std::stol(run.run_name.args));
    const auto [it, fresh] = best_.try_emplace(key, measured);
    if (fresh) continue;
    const double cpu = std::min(counter(&measured, kCpu), counter(&it->second, kCpu));
    if (measured.seconds < it->second.seconds) it->second = measured;
    it->second.counters[kCpu] = cpu;
  }
}

const Results::Measured* Results::find(const std::string& what, long n_faces) const {
  const auto it = best_.find({what, n_faces});
  return it == best_.end() ? nullptr : &it->second;
}

void Results::print_program_table(const std::string& suffix, const std::string& title) const {
  fmt::print("\nFrom files to file: the program, beside cp of the bytes it reads; {}\n", title);
  fmt::print("{:>9} {:>8} | {:>8} {:>9} {:>6} | {:>8} {:>9} {:>6} | {:>11} {:>9} {:>10}\n", "faces", "MB", "cp clock",
             "merge", "ratio", "cp cpu", "merge", "ratio", "B/face peak", "read MB/s", "write MB/s");
  for (const auto& [key, program] : best_) {
    if (key.first != "program" + suffix) continue;
    const Measured *cp = find("cp" + suffix, key.second), *read = find("read", key.second),
                   *write = find("write", key.second);
    if (!cp) continue;
    const double cpu = counter(&program, kCpu), cp_cpu = counter(cp, kCpu);
    fmt::print("{:>9} {:>8.1f} | {:>8.1f} {:>9.1f} {:>6.2f} | {:>8.1f} {:>9.1f} {:>6.2f} | {:>11.0f}", key.second,
               counter(&program, "bytes") / kMillion, cp->seconds * 1e3, program.seconds * 1e3,
               program.seconds / cp->seconds, cp_cpu * 1e3, cpu * 1e3, cpu / cp_cpu,
               counter(&program, "bytes_per_face"));
    for (const Measured* m : {read, write})
      fmt::print(" {:>9.0f}", m ? counter(m, "bytes") / kMillion / counter(m, kCpu) : 0);
    fmt::print("\n");
  }
}

void Results::print_array_table(const std::string& suffix, const std::string& title) const {
  fmt::print("\nFrom arrays to arrays: merge and apply, beside CGAL (corefine, isotropic_remeshing of the band); {}\n",
             title);
  fmt::print("{:>9} {:>9} {:>9} {:>7} {:>9} | {:>8} {:>7} {:>8} | {:>8} {:>7} {:>8} | {:>8} {:>7} {:>8}\n", "faces",
             "merge ms", "CGAL ms", "ratio", "apart ms", "min Q", "mean", "<0.5 %", "CGAL min", "mean", "<0.5 %",
             "apart", "mean", "<0.5 %");
  for (const auto& [key, merge] : best_) {
    if (key.first != "merge" + suffix) continue;
    const Measured *peer = find("peer" + suffix, key.second), *apart = find("peer_apart" + suffix, key.second);
    if (!peer || !apart) continue;
    fmt::print("{:>9} {:>9.1f} {:>9.1f} {:>7.1f} {:>9.1f}", key.second, merge.seconds * 1e3, peer->seconds * 1e3,
               peer->seconds / merge.seconds, apart->seconds * 1e3);
    for (const Measured* m : {&merge, peer, apart})
      fmt::print(" | {:>8.3f} {:>7.3f} {:>8.2f}", counter(m, "min_q"), counter(m, "mean_q"),
                 counter(m, "below_percent"));
    fmt::print("\n");
  }
  fmt::print(
      "CGAL joins the meshes only if each edge of the junction stays as it was cut; \"apart\": each mesh\n"
      "resamples the junction for itself, so that the result is not one mesh.\n");
}

void Results::print_grid_table() const {
  fmt::print("\nGrid of crossing stiffeners, arrays to arrays: all in one call, beside each alone; processor time\n");
  fmt::print("{:>9} {:>10} {:>9} {:>9} {:>7} {:>8} {:>7}\n", "faces", "new faces", "grid ms", "singly ms", "ratio",
             "min Q", "mean");
  for (const auto& [key, grid] : best_) {
    if (key.first != "grid") continue;
    const Measured* singly = find("grid_singly", key.second);
    if (!singly) continue;
    const double cpu = counter(&grid, kCpu), singly_cpu = counter(singly, kCpu);
    fmt::print("{:>9} {:>10.0f} {:>9.1f} {:>9.1f} {:>7.2f} {:>8.3f} {:>7.3f}\n", key.second,
               counter(&grid, "new_faces"), cpu * 1e3, singly_cpu * 1e3, cpu / singly_cpu, counter(&grid, "min_q"),
               counter(&grid, "mean_q"));
  }
}

void Results::print_stage_table(const std::string& what, const std::string& title) const {
  std::set<std::string> stages;
  for (const auto& [key, measured] : best_)
    if (key.first == what)
      for (const auto& [name, value] : measured.counters)
        if (name.starts_with(kStage)) stages.insert(name);
  if (stages.empty()) return;
  fmt::print("\n{}\n{:>9}", title, "faces");
  for (const std::string& stage : stages) fmt::print(" {:>12}", stage.substr(kStage.size()));
  fmt::print(" {:>12}\n", "total");
  for (const auto& [key, measured] : best_) {
    if (key.first != what) continue;
    fmt::print("{:>9}", key.second);
    for (const std::string& stage : stages) fmt::print(" {:>12.2f}", counter(&measured, stage) * 1e3);
    fmt::print(" {:>12.2f}\n", measured.seconds * 1e3);
  }
}

void Results::print_tables() const {
  print_program_table("_zone", "stiffener of 42 edges");
  print_program_table("", "zone growing with the model");
  print_array_table("_zone", "stiffener of 42 edges");
  print_array_table("_long", "stiffener of 250 edges");
  print_array_table("", "zone growing with the model");
  print_grid_table();
  print_stage_table("merge", "Stages of merge in ms, zone growing with the model");
  print_stage_table("merge_long", "Stages of merge in ms, a long zone");
  print_stage_table("merge_zone", "Stages of merge in ms, the same zone in a growing model");
}

}  // namespace meshgraft::bench
