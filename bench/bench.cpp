// meshgraft_bench PROGRAM DIRECTORY: speed and memory on scenes that grow; DIRECTORY receives files.
#include <benchmark/benchmark.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <optional>

#include "bench_scenes.hpp"
#include "geometry/quality.hpp"
#include "meshgraft/merge.hpp"
#include "meshgraft/unv.hpp"
#include "peer_cgal.hpp"
#include "results.hpp"

namespace meshgraft::bench {
namespace {

namespace fs = std::filesystem;
using benchmark::State;

constexpr int kGrid = 10;                 // stiffeners in each direction
constexpr double kMeanEdgeOfCell = 1.14;  // of a square cell cut in two: (1 + 1 + sqrt 2) / 3

fs::path program, directory;

/// The last scene asked for; only one is held, because the largest take gigabytes.
template <class Make>
const Scene& cached(Make make, std::size_t n_faces) {
  static std::optional<Scene> scene;
  static std::pair<Make, std::size_t> key;
  if (!scene || key != std::pair(make, n_faces)) {
    scene.reset();
    scene = make(n_faces);
    key = {make, n_faces};
  }
  return *scene;
}

using Make = Scene (*)(std::size_t n_faces);

const Scene& scene_of(const State& state, Make make = &growing_zone) {
  return cached(make, static_cast<std::size_t>(state.range(0)));
}

struct Files {
  fs::path base, part, output;
  [[nodiscard]] std::uintmax_t input_bytes() const { return fs::file_size(base) + fs::file_size(part); }
};

/// A scene as files, written on first use.
Files files_of(const State& state, Make make = &growing_zone) {
  const std::string kind = make == &growing_zone ? "growing" : "constant", n = std::to_string(state.range(0));
  Files files{directory / (kind + "_base" + n + ".unv"), directory / (kind + "_part" + n + ".unv"),
              directory / "output.unv"};
  if (!fs::exists(files.part)) {
    const Scene& scene = scene_of(state, make);
    if (!write_unv(scene.base, files.base.string()) || !write_unv(scene.parts[0], files.part.string())) {
      std::cerr << "cannot write to " << directory << '\n';
      std::exit(5);
    }
  }
  return files;
}

double seconds_of(const rusage& usage) {
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Processor time of this process so far, of all threads, in user code and in the system.
double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return seconds_of(usage);
}

void report_quality(State& state, std::vector<double> q) {
  const auto below = std::count_if(q.begin(), q.end(), [](double value) { return value < 0.5; });
  double sum = 0;
  for (const double value : q) sum += value;
  const auto n = static_cast<double>(q.size());
  state.counters["new_faces"] = n;
  state.counters["min_q"] = *std::min_element(q.begin(), q.end());
  state.counters["mean_q"] = sum / n;
  state.counters["below_percent"] = 100 * static_cast<double>(below) / n;
}

void merge_arrays(State& state, const Scene& scene) {
  for (auto _ : state) {
    const double start = cpu_seconds();
    const Result<Merged> merged = merge(scene.base, scene.parts);
    if (!merged) return state.SkipWithError(to_string(merged.error()).c_str());
    Model result = apply(scene.base, scene.parts, *merged);
    benchmark::DoNotOptimize(result);

    state.PauseTiming();
    state.counters["cpu"] = cpu_seconds() - start;
    const Report& report = merged->report;
    for (const auto& [stage, seconds] : report.timings) state.counters["s:" + stage] = seconds;
    std::vector<double> q;
    for (std::size_t e = result.n_elements() - merged->graft.new_elements.size(); e < result.n_elements(); ++e)
      if (result.is_face(ElementId(e))) q.push_back(aspect_ratio(result.corners(ElementId(e))));
    report_quality(state, q);
    result = {};
    state.ResumeTiming();
  }
}

const Scene& grid_of(const State& state) {
  return cached(
      +[](std::size_t n_faces) { return grid(n_faces, kGrid); }, static_cast<std::size_t>(state.range(0)));
}

/// Each stiffener of the grid joined to the plate without the others.
void merge_singly(State& state) {
  const Scene& scene = grid_of(state);
  for (auto _ : state) {
    const double start = cpu_seconds();
    for (const Model& part : scene.parts) {
      const Result<Merged> merged = merge(scene.base, std::span(&part, 1));
      if (!merged) return state.SkipWithError(to_string(merged.error()).c_str());
      Model result = apply(scene.base, std::span(&part, 1), *merged);
      benchmark::DoNotOptimize(result);
    }
    state.counters["cpu"] = cpu_seconds() - start;
  }
}

Triangles triangles_of(const Model& model) {
  Triangles t{model.position, {}};
  for (std::size_t e = 0; e < model.n_elements(); ++e) {
    const auto n = model.nodes_of(ElementId(e));
    t.faces.push_back({n[0].value, n[1].value, n[2].value});
  }
  return t;
}

void merge_with_peer(State& state, const Scene& scene, bool conforming) {
  const Triangles base = triangles_of(scene.base), part = triangles_of(scene.parts[0]);
  PeerOptions options;
  options.conforming = conforming;
  options.target_size = kMeanEdgeOfCell * scene.size;
  for (auto _ : state) {
    const PeerResult result = merge_with_cgal(base, part, options);

    state.PauseTiming();
    state.counters["s:build"] = result.build_seconds;
    state.counters["s:corefine"] = result.corefine_seconds;
    state.counters["s:remesh"] = result.remesh_seconds;
    state.counters["s:collect"] = result.collect_seconds;
    std::vector<double> q;
    for (std::size_t f = result.first_new; f < result.merged.faces.size(); ++f) {
      const auto& n = result.merged.faces[f];
      q.push_back(
          aspect_ratio({result.merged.position[n[0]], result.merged.position[n[1]], result.merged.position[n[2]]}));
    }
    report_quality(state, q);
    state.ResumeTiming();
  }
}

struct Ran {
  int exit_status = -1;
  double cpu_seconds = 0;  // of all threads, in user code and in the system
};

/// Runs a program to its end.
Ran run(const std::vector<std::string>& arguments) {
  std::vector<char*> argv;
  for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
  argv.push_back(nullptr);
  pid_t child = 0;
  if (posix_spawnp(&child, argv[0], nullptr, nullptr, argv.data(), environ) != 0) return {};
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, seconds_of(usage)};
}

/// An output that replaces a file is flushed to the disk, which is not what is to be measured.
void remove_output(State& state, const Files& files) {
  state.PauseTiming();
  fs::remove(files.output);
  state.ResumeTiming();
}

/// Bytes, from a report; the system counts the memory of this process among that of those it starts.
double peak_memory(const fs::path& report) {
  const std::string key = "\"peak_memory_bytes\":";
  std::ifstream file(report);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  const std::size_t at = text.find(key);
  return at == std::string::npos ? 0 : std::strtod(text.c_str() + at + key.size(), nullptr);
}

void run_program(State& state, Make make) {
  const Files files = files_of(state, make);
  const std::vector<std::string> command{
      program.string(), "merge", files.base.string(), files.part.string(), "-q", "-o", files.output.string()};
  for (auto _ : state) {
    remove_output(state, files);
    const Ran ran = run(command);
    if (ran.exit_status != 0) return state.SkipWithError(("exit status " + std::to_string(ran.exit_status)).c_str());
    state.counters["cpu"] = ran.cpu_seconds;
  }
  const fs::path report = directory / "report.json";
  std::vector<std::string> with_report = command;
  with_report.insert(with_report.end(), {"--report", report.string()});
  if (run(with_report).exit_status != 0) return state.SkipWithError("no report");
  const auto bytes = static_cast<double>(files.input_bytes());
  state.counters["bytes"] = bytes;
  state.counters["bytes_per_face"] = (peak_memory(report) - bytes) / static_cast<double>(state.range(0));
}

void run_cp(State& state, Make make) {
  const Files files = files_of(state, make);
  const std::string copy_of_part = files.output.string() + ".part";
  for (auto _ : state) {
    remove_output(state, files);
    double cpu = 0;
    for (const auto& [from, to] :
         {std::pair{files.base.string(), files.output.string()}, std::pair{files.part.string(), copy_of_part}}) {
      const Ran ran = run({"cp", from, to});
      if (ran.exit_status != 0) return state.SkipWithError("cp failed");
      cpu += ran.cpu_seconds;
    }
    state.counters["cpu"] = cpu;
  }
  state.counters["bytes"] = static_cast<double>(files.input_bytes());
}

void read_file(State& state) {
  const Files files = files_of(state);
  for (auto _ : state) {
    const double start = cpu_seconds();
    const Result<Model> model = read_unv(files.base.string());
    if (!model) return state.SkipWithError(to_string(model.error()).c_str());
    benchmark::DoNotOptimize(model->position.data());
    state.counters["cpu"] = cpu_seconds() - start;
  }
  state.counters["bytes"] = static_cast<double>(fs::file_size(files.base));
}

void write_merged(State& state) {
  const Files files = files_of(state);
  const Result<Model> base = read_unv(files.base.string());
  const Result<Model> part = read_unv(files.part.string());
  if (!base || !part) return state.SkipWithError("cannot read");
  Result<Merged> merged = merge(*base, std::span(&*part, 1));
  if (!merged) return state.SkipWithError(to_string(merged.error()).c_str());
  for (auto _ : state) {
    remove_output(state, files);
    const double start = cpu_seconds();
    if (!write_unv(*base, std::span(&*part, 1), *merged, files.output.string(), merged->report))
      return state.SkipWithError("cannot write");
    state.counters["cpu"] = cpu_seconds() - start;
  }
  state.counters["bytes"] = static_cast<double>(fs::file_size(files.output));
}

void register_all() {
  // Below, the zones of neighbours run into each other; above, it takes minutes.
  constexpr std::int64_t kLeastForGrid = 100'000, kMostForGrid = 1'000'000;
  constexpr std::int64_t kLeastForLong = 1'000'000;  // the stiffener is to end on the plate
  // One scene after the other, because only one is held in memory.
  for (const std::int64_t n : {10'000, 100'000, 1'000'000, 4'000'000}) {
    const auto add = [n](const std::string& name, std::function<void(State&)> body) {
      constexpr int kRuns = 3;                      // the fastest counts
      constexpr std::int64_t kMostRun = 1'000'000;  // above, the peer takes a minute for each
      benchmark::RegisterBenchmark(name.c_str(), std::move(body))
          ->Arg(n)
          ->Iterations(1)
          ->Repetitions(n > kMostRun ? 1 : kRuns)
          ->UseRealTime()
          ->Unit(benchmark::kMillisecond);
    };
    add("cp_zone", [](State& state) { run_cp(state, &constant_zone); });
    add("program_zone", [](State& state) { run_program(state, &constant_zone); });
    add("cp", [](State& state) { run_cp(state, &growing_zone); });
    add("read", read_file);
    add("write", write_merged);
    add("program", [](State& state) { run_program(state, &growing_zone); });
    add("merge", [](State& state) { merge_arrays(state, scene_of(state)); });
    add("peer", [](State& state) { merge_with_peer(state, scene_of(state), true); });
    add("peer_apart", [](State& state) { merge_with_peer(state, scene_of(state), false); });
    add("merge_zone", [](State& state) { merge_arrays(state, scene_of(state, &constant_zone)); });
    add("peer_zone", [](State& state) { merge_with_peer(state, scene_of(state, &constant_zone), true); });
    add("peer_apart_zone", [](State& state) { merge_with_peer(state, scene_of(state, &constant_zone), false); });
    if (n >= kLeastForLong) {
      add("merge_long", [](State& state) { merge_arrays(state, scene_of(state, &long_zone)); });
      add("peer_long", [](State& state) { merge_with_peer(state, scene_of(state, &long_zone), true); });
      add("peer_apart_long", [](State& state) { merge_with_peer(state, scene_of(state, &long_zone), false); });
    }
    if (n < kLeastForGrid || n > kMostForGrid) continue;
    add("grid", [](State& state) { merge_arrays(state, grid_of(state)); });
    add("grid_singly", merge_singly);
  }
}

}  // namespace
}  // namespace meshgraft::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (argc != 3) {
    std::cerr << "usage: meshgraft_bench [--benchmark_filter=NAME/SIZE] PROGRAM DIRECTORY\n";
    return 2;
  }
  meshgraft::bench::program = std::filesystem::absolute(argv[1]);
  meshgraft::bench::directory = argv[2];
  std::filesystem::create_directories(argv[2]);
  meshgraft::bench::register_all();
  meshgraft::bench::Results results;
  benchmark::RunSpecifiedBenchmarks(&results);
  results.print_tables();
  return 0;
}
