#include <ucontext.h>

#include <cstdint>

#include <ps/cpu/empty_loop.h>
#include <ps/cpu/program_watch.h>

extern "C" void __sanitizer_cov_trace_pc(void);

namespace ps {

namespace {

constexpr suseconds_t period_us = 100'000;

#if defined(__x86_64__)
/// Where an empty loop goes on. A leaf function may stand in one with any stack pointer.
__attribute__((noinline, force_align_arg_pointer)) void loop_with_call() {
  while (true) __sanitizer_cov_trace_pc();
}

bool is_jump_to_itself(std::uintptr_t instruction) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(instruction);
  return bytes[0] == 0xEB && bytes[1] == 0xFE;
}
#endif

}  // namespace

void EmptyLoopWatch::arm() {
  struct sigaction action {};
  action.sa_sigaction = &EmptyLoopWatch::on_signal;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK | SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGVTALRM, &action, &old_action_);
  const itimerval timer{{0, period_us}, {0, period_us}};
  setitimer(ITIMER_VIRTUAL, &timer, &old_timer_);
}

void EmptyLoopWatch::disarm() {
  setitimer(ITIMER_VIRTUAL, &old_timer_, nullptr);
  sigaction(SIGVTALRM, &old_action_, nullptr);
}

// As if the jump were a call: who walks the stack finds the loop. What lies below the stack pointer
// is of no use any more.
void EmptyLoopWatch::on_signal(int, siginfo_t*, void* context) {
#if defined(__x86_64__)
  if (!ProgramWatch::runs) return;
  greg_t* const registers = static_cast<ucontext_t*>(context)->uc_mcontext.gregs;
  const auto instruction = static_cast<std::uintptr_t>(registers[REG_RIP]);
  if (!is_jump_to_itself(instruction)) return;
  registers[REG_RSP] -= static_cast<greg_t>(sizeof(std::uintptr_t));
  *reinterpret_cast<std::uintptr_t*>(registers[REG_RSP]) = instruction + 1;
  registers[REG_RIP] = reinterpret_cast<greg_t>(&loop_with_call);
#else
  static_cast<void>(context);
#endif
}

}  // namespace ps
