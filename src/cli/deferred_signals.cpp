#include "cli/deferred_signals.hpp"

namespace meshgraft::cli {
namespace {

volatile std::sig_atomic_t waiting = 0;  // the last signal that came, 0 = none

extern "C" void remember(int signal) { waiting = signal; }

}  // namespace

// A signal mask would not do: the threads of the pool do not have it.
DeferredSignals::DeferredSignals() {
  waiting = 0;
  for (std::size_t k = 0; k < std::size(kSignals); ++k) {
    struct sigaction later {};
    later.sa_handler = remember;
    later.sa_flags = SA_RESTART;
    sigemptyset(&later.sa_mask);
    sigaction(kSignals[k], nullptr, &old_[k]);
    if (old_[k].sa_handler != SIG_IGN) sigaction(kSignals[k], &later, nullptr);
  }
}

DeferredSignals::~DeferredSignals() {
  for (std::size_t k = 0; k < std::size(kSignals); ++k) sigaction(kSignals[k], &old_[k], nullptr);
  if (waiting != 0) std::raise(waiting);
}

}  // namespace meshgraft::cli
