#pragma once

#include <cstdint>

namespace ps {

/// What the processor has to know of the program's own statements, which it does not see: whether
/// one runs at all, and for how long none has called the HAL. Written on every HAL call.
struct ProgramWatch {
  /// The program's code runs; false: the simulator's does, in a HAL call or elsewhere.
  static volatile bool runs;
  /// Basic blocks of the program until somebody looks at it: a loop without HAL call is suspected.
  static volatile std::uint64_t blocks_left;
  static volatile std::uint64_t blocks_limit;

  /// Why the program is to end at its next basic block.
  enum class Stop : std::uint8_t { none, host_time, interrupted };
  static volatile Stop stop;

  static void enter_hal() { runs = false; }
  static void leave_hal() {
    blocks_left = blocks_limit;
    suspicions_ = 0;
    runs = true;
  }
  /// The program's code is about to run; `blocks` without HAL call are a suspicion.
  static void start(std::uint64_t blocks) {
    stop = Stop::none;
    blocks_limit = blocks;
    leave_hal();
  }
  /// No program runs any more.
  static void end() { runs = false; }

  /// Ends the program at its next basic block. May be called in a signal handler.
  static void stop_program(Stop why) {
    stop = why;
    blocks_limit = 1;
    if (runs) blocks_left = 1;
  }

  /// Suspicions since the last HAL call.
  static unsigned suspicions() { return suspicions_ & ~marked; }
  static void suspect_again(unsigned before) { suspicions_ = before + 1; }
  /// True if it was called before in the HAL call that runs. For a signal handler.
  static bool mark_call() {
    const bool again = (suspicions_ & marked) != 0;
    suspicions_ = suspicions_ | marked;
    return again;
  }

  /// The program's code runs in this scope, inside a HAL call: a handler, or a look at its memory.
  class ProgramCode {
   public:
    ProgramCode() { runs = true; }
    ~ProgramCode() { runs = false; }
    ProgramCode(const ProgramCode&) = delete;
    ProgramCode& operator=(const ProgramCode&) = delete;
  };

 private:
  static constexpr unsigned marked = 1u << 31;
  static volatile unsigned suspicions_;
};

}  // namespace ps
