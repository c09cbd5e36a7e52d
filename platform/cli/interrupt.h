#pragma once

#include <vp/host_ticks.h>
#include <csignal>
#include <cstdint>

#include <cli/simulation.h>

namespace platform::cli {

/// While it lives, the first Ctrl-C (SIGINT), SIGTERM or SIGHUP is only noted, so that a run ends
/// after the current frame and keeps its results. The second ends the process at once.
class InterruptGuard : private vp::HostTicks::Listener {
 public:
  InterruptGuard() : InterruptGuard(nullptr) {}
  /// The first one is followed up, too: where the next frame does not come soon the simulation is
  /// interrupted, and what has not ended within a second is ended. A second of the host's
  /// processor, or of waiting: a busy machine loses no results.
  explicit InterruptGuard(Simulation& bounded) : InterruptGuard(&bounded) {}
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  static bool interrupted();

 private:
  explicit InterruptGuard(Simulation* bounded);
  static void on_signal(int signal);
  void on_host_tick(std::uint64_t spent_ns, void* context) override;

  Simulation* bounded_;         ///< null: without bound
  std::uint64_t spent_ns_ = 0;  ///< since the signal
  InterruptGuard* outer_;
  struct sigaction old_interrupt_;
  struct sigaction old_terminate_;
  struct sigaction old_hang_up_;
};

}  // namespace platform::cli
