#pragma once

#include <vp/host_ticks.h>
#include <cstdint>

namespace ps {

/// How much of the host's time code of a program may take while nothing progresses.
struct HostLimit {
  std::uint64_t ns = 0;  ///< processor time of the process, or time in which the program waits
  /// What changes with each progress; null: nothing ever does.
  std::uint64_t (*progress)(const void* context) = nullptr;
  const void* context = nullptr;
};

/// Looks now and then, by the host's time, at the code of a program that runs.
///
/// It ends one that takes host time without progress, whatever it calls: first by
/// ProgramWatch::stop_program(), which the next instrumented basic block obeys; code that has none
/// (the C library) is left where a later tick finds it. Time inside one HAL call is the
/// simulator's, and does not count.
///
/// And it lets time pass in loops without a statement, `while (true);`. The compiler puts no call
/// of __sanitizer_cov_trace_pc() into them: they have no basic block but the jump to itself. From
/// there the program goes on in a loop that makes the call. Since the jump leads nowhere else, no
/// result depends on when that is. Only on x86-64.
class HostWatch : private vp::HostTicks::Listener {
 public:
  /// Ends the code that stands at a signal's `context` (a ucontext_t).
  using Leave = void (*)(const void* context);

  void arm(const HostLimit& limit, Leave leave);
  void disarm();

 private:
  void on_host_tick(std::uint64_t spent_ns, void* context) override;
  void count(std::uint64_t spent_ns);

  HostLimit limit_;
  Leave leave_ = nullptr;
  std::uint64_t spent_ns_ = 0;  ///< since the last progress
  std::uint64_t progress_ = 0;
  bool told_ = false;  ///< the program was to stop at the last tick
};

}  // namespace ps
