#pragma once

#include <csignal>

namespace platform::cli {

/// While it lives, the first Ctrl-C (SIGINT) or SIGTERM is only noted, so that a run ends after the
/// current frame and keeps its results. The second ends the program at once.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  static bool interrupted();

 private:
  struct sigaction old_interrupt_;
  struct sigaction old_terminate_;
};

}  // namespace platform::cli
