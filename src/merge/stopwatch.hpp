// Stages of the pipeline: announced, then timed.
#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace meshgraft {

class Stopwatch {
 public:
  using Progress = std::function<void(std::string_view stage, double done)>;
  explicit Stopwatch(const Progress& progress) : progress_(progress) {}

  /// Ends the stage before and starts this one; `done` is the share of all work done so far.
  void start(const char* stage, double done) {
    stop();
    stage_ = stage, begin_ = Clock::now();
    if (progress_) progress_(stage, done);
  }

  void stop() {
    if (stage_.empty()) return;
    const auto before = std::ranges::find(timings_, stage_, &std::pair<std::string, double>::first);
    double& seconds = before == timings_.end() ? timings_.emplace_back(stage_, 0).second : before->second;
    seconds += std::chrono::duration<double>(Clock::now() - begin_).count();
    stage_.clear();
  }

  /// Seconds by stage, in order of their first start.
  [[nodiscard]] const std::vector<std::pair<std::string, double>>& timings() const { return timings_; }

 private:
  using Clock = std::chrono::steady_clock;
  const Progress& progress_;
  std::string stage_;
  Clock::time_point begin_;
  std::vector<std::pair<std::string, double>> timings_;
};

}  // namespace meshgraft
