#include <ucontext.h>

#include <ps/cpu/program_watch.h>

extern "C" void __sanitizer_cov_trace_pc(void);

namespace ps {

namespace {

#if defined(__x86_64__)
/// Where an empty loop goes on. A leaf function may stand in one with any stack pointer.
__attribute__((noinline, force_align_arg_pointer)) void loop_with_call() {
  while (true) __sanitizer_cov_trace_pc();
}

bool is_jump_to_itself(std::uintptr_t instruction) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(instruction);
  return bytes[0] == 0xEB && bytes[1] == 0xFE;
}

// As if the jump were a call: who walks the stack finds the loop. What lies below the stack pointer
// is of no use any more.
void leave_empty_loop(void* context) {
  greg_t* const registers = static_cast<ucontext_t*>(context)->uc_mcontext.gregs;
  const auto instruction = static_cast<std::uintptr_t>(registers[REG_RIP]);
  if (!is_jump_to_itself(instruction)) return;
  registers[REG_RSP] -= static_cast<greg_t>(sizeof(std::uintptr_t));
  *reinterpret_cast<std::uintptr_t*>(registers[REG_RSP]) = instruction + 1;
  registers[REG_RIP] = reinterpret_cast<greg_t>(&loop_with_call);
}
#else
void leave_empty_loop(void*) {}
#endif

}  // namespace

void HostWatch::arm(const HostLimit& limit, Leave leave) {
  limit_ = limit;
  leave_ = leave;
  spent_ns_ = progress_ = 0;
  told_ = false;
  vp::HostTicks::add(*this);
}

void HostWatch::disarm() {
  vp::HostTicks::remove(*this);
}

void HostWatch::on_host_tick(std::uint64_t spent_ns, void* context) {
  count(spent_ns);
  const bool runs = ProgramWatch::runs;
  const bool told_before = told_;
  if (runs && told_before) return leave_(context);
  told_ = ProgramWatch::stop != ProgramWatch::Stop::none;
  // Each call of the HAL sets the number of basic blocks anew.
  if (told_) ProgramWatch::stop_program(ProgramWatch::stop);
  // It is in a HAL call, between which it may be hardly ever.
  if (told_before) vp::HostTicks::hurry();
  if (runs) leave_empty_loop(context);
}

void HostWatch::count(std::uint64_t spent_ns) {
  const std::uint64_t progress = limit_.progress ? limit_.progress(limit_.context) : 0;
  const bool in_one_call = !ProgramWatch::runs && ProgramWatch::mark_call();
  if (progress != progress_) spent_ns_ = 0;
  progress_ = progress;
  if (in_one_call) return;
  spent_ns_ += spent_ns;
  if (spent_ns_ >= limit_.ns && ProgramWatch::stop == ProgramWatch::Stop::none) {
    ProgramWatch::stop_program(ProgramWatch::Stop::host_time);
  }
}

}  // namespace ps
