#include "cli/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "cli/print.hpp"

namespace meshgraft::cli {

Progress::Progress(bool wanted) : shown_(wanted && ::isatty(STDERR_FILENO) == 1) {}

void Progress::show(std::string_view stage, double done) {
  if (!shown_) return;
  std::string line = fmt::format("{:3.0f} %  {}", 100 * std::clamp(done, 0.0, 1.0), stage);
  const std::size_t width = line.size();
  if (width < width_) line.append(width_ - width, ' ');  // over the rest of a longer line
  say(stderr, "\r{}", line);
  std::fflush(stderr);
  width_ = width;
}

void Progress::clear() {
  if (width_ == 0) return;
  say(stderr, "\r{:{}}\r", "", width_);
  std::fflush(stderr);
  width_ = 0;
}

}  // namespace meshgraft::cli
