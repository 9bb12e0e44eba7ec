// Collects what the benchmarks measured and prints the ratios that matter.
#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <string>

namespace meshgraft::bench {

/// Prints like the console reporter and keeps, by name, the fastest run of each benchmark.
class Results : public benchmark::ConsoleReporter {
 public:
  struct Measured {
    double seconds = 0;
    std::map<std::string, double> counters;
  };

  void ReportRuns(const std::vector<Run>& runs) override;
  /// One table per question, for the sizes that were run.
  void print_tables() const;

 private:
  [[nodiscard]] const Measured* find(const std::string& what, long n_faces) const;
  void print_program_table(const std::string& suffix, const std::string& title) const;
  void print_array_table(const std::string& suffix, const std::string& title) const;
  void print_grid_table() const;
  void print_stage_table(const std::string& what, const std::string& title) const;

  std::map<std::pair<std::string, long>, Measured> best_;  // "merge", faces
};

}  // namespace meshgraft::bench
