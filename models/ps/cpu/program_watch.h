#pragma once

#include <cstdint>

namespace ps {

/// What the processor has to know of the program's own statements, which it does not see: whether
/// one runs at all, and for how long none has called the HAL. Written on every HAL call.
struct ProgramWatch {
  /// The program's code runs; false: the simulator's does, in a HAL call or elsewhere.
  static volatile bool runs;
  /// Basic blocks of the program until a loop without HAL call is suspected.
  static volatile std::uint64_t blocks_left;
  static std::uint64_t blocks_limit;
  /// Suspicions since the last HAL call.
  static unsigned suspicions;

  static void enter_hal() { runs = false; }
  static void leave_hal() {
    blocks_left = blocks_limit;
    suspicions = 0;
    runs = true;
  }
  /// No program runs any more.
  static void stop() { runs = false; }

  /// The program's code runs in this scope, inside a HAL call: a handler, or a look at its memory.
  class ProgramCode {
   public:
    ProgramCode() { runs = true; }
    ~ProgramCode() { runs = false; }
    ProgramCode(const ProgramCode&) = delete;
    ProgramCode& operator=(const ProgramCode&) = delete;
  };
};

}  // namespace ps
