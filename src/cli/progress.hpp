// One line on the terminal that says how far the work is.
#pragma once

#include <cstddef>
#include <string_view>

namespace meshgraft::cli {

/// Rewrites its line on stderr at each call; writes nothing at all unless stderr is a terminal. Clear
/// before anything else is printed.
class Progress {
 public:
  explicit Progress(bool wanted);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() { clear(); }

  /// `done`: share of the work, 0 to 1.
  void show(std::string_view stage, double done);
  void clear();

 private:
  bool shown_;
  std::size_t width_ = 0;  // letters on the line now
};

}  // namespace meshgraft::cli
