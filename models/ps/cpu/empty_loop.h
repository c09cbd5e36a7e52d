#pragma once

#include <csignal>

#include <sys/time.h>

namespace ps {

/// Lets time pass in loops without a statement, `while (true);`. The compiler puts no call of
/// __sanitizer_cov_trace_pc() into them: they have no basic block but the jump to itself.
///
/// While it is armed, a timer of the host looks now and then whether the program stands on such a
/// jump; from there it goes on in a loop that makes the call. Since the jump leads nowhere else, no
/// result depends on when that is. Only on x86-64; elsewhere it does nothing.
class EmptyLoopWatch {
 public:
  void arm();
  void disarm();

 private:
  static void on_signal(int signal, siginfo_t* info, void* context);

  struct sigaction old_action_ {};
  struct itimerval old_timer_ {};
};

}  // namespace ps
