// Outputs are finished before a signal ends the program.
#pragma once

#include <csignal>
#include <iterator>

namespace meshgraft::cli {

/// While it lives, an interrupt (Ctrl-C), hang-up or request to end waits; it takes effect at the end
/// of the scope. One at a time.
class DeferredSignals {
 public:
  DeferredSignals();
  DeferredSignals(const DeferredSignals&) = delete;
  DeferredSignals& operator=(const DeferredSignals&) = delete;
  ~DeferredSignals();

 private:
  static constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};
  struct sigaction old_[std::size(kSignals)];
};

}  // namespace meshgraft::cli
