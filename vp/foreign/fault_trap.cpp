#include <dlfcn.h>
#include <execinfo.h>
#include <pthread.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <ucontext.h>
#include <unistd.h>

#include <vp/fault_trap.h>
#include <vp/file.h>
#include <vp/foreign_object.h>
#include <vp/kernel.h>
#include <vp/own_stack.h>
#include <vp/text.h>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <string_view>

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/asan_interface.h>
#endif

namespace vp {

namespace {

/// Enough to walk the stack of the program.
constexpr std::size_t signal_stack_size = 256 * 1024;
/// Of no object: a tick of HostTicks may come behind the end of all of them.
alignas(std::max_align_t) std::array<char, signal_stack_size> signal_stack;
/// Around the stack's end: what a function with large variables may miss the guard page by.
constexpr std::uintptr_t overflow_range = 1024 * 1024;
/// Between the caller of call() and the true top of the stack.
constexpr std::uintptr_t overflow_slack = 64 * 1024;

Fault::Access access_of(int signal, const void* context) {
#if defined(__x86_64__)
  if (signal != SIGSEGV && signal != SIGBUS) return Fault::Access::unknown;
  // Bits of the page fault's error code.
  constexpr greg_t write = 2, fetch = 16;
  const greg_t error = static_cast<const ucontext_t*>(context)->uc_mcontext.gregs[REG_ERR];
  if ((error & fetch) != 0) return Fault::Access::execute;
  return (error & write) != 0 ? Fault::Access::write : Fault::Access::read;
#else
  static_cast<void>(signal);
  static_cast<void>(context);
  return Fault::Access::unknown;
#endif
}

std::uintptr_t instruction_of(const void* context) {
#if defined(__x86_64__)
  return static_cast<std::uintptr_t>(
      static_cast<const ucontext_t*>(context)->uc_mcontext.gregs[REG_RIP]);
#else
  static_cast<void>(context);
  return 0;
#endif
}

/// The caller of an invalid address: its return address is on top of the stack.
std::uintptr_t caller_of_nothing(const void* context) {
#if defined(__x86_64__)
  return *reinterpret_cast<const std::uintptr_t*>(
      static_cast<const ucontext_t*>(context)->uc_mcontext.gregs[REG_RSP]);
#else
  static_cast<void>(context);
  return 0;
#endif
}

/// Whether a page can be read, without a fault: of two bad arguments the kernel names the set's
/// place first.
bool is_readable(std::uintptr_t address) {
  constexpr int no_operation = ~0;
  constexpr std::size_t set_bytes = 8;
  call_kernel(SYS_rt_sigprocmask, no_operation, static_cast<long>(address & ~std::uintptr_t{7}), 0,
              static_cast<long>(set_bytes));
  return errno != EFAULT;
}

/// The stack that the code is on has no room left: that of a SystemC thread, a thread of its own, …
bool is_beyond_stack(const void* context, std::uintptr_t address) {
#if defined(__x86_64__)
  // Below its stack pointer a function uses 128 bytes; above it, its variables.
  constexpr std::uintptr_t below = 256;
  const auto top = static_cast<std::uintptr_t>(
      static_cast<const ucontext_t*>(context)->uc_mcontext.gregs[REG_RSP]);
  if (address < top - below || address > top + overflow_range) return false;
  return address < top || !is_readable(top);
#else
  static_cast<void>(context);
  static_cast<void>(address);
  return false;
#endif
}

const char* arithmetic_text(int code) {
  switch (code) {
    case FPE_INTDIV:
    case FPE_INTOVF:
      return "integer division by zero, or its result does not fit";
    case FPE_FLTDIV:
      return "floating point division by zero";
    case FPE_FLTOVF:
      return "floating point overflow";
    case FPE_FLTUND:
      return "floating point underflow";
    case FPE_FLTINV:
      return "invalid floating point operation";
    default:
      return "arithmetic exception";
  }
}

}  // namespace

std::string Fault::text(const std::string& who) const {
  switch (kind) {
    case Kind::terminated:
      return who + " called std::terminate()";
    case Kind::exit:
      return who + " called " + call + "(" + std::to_string(code) + ")";
    case Kind::forbidden:
      return who + " called " + call + "()";
    case Kind::no_hal:
      return who + " called " + call + "() outside of its entry function";
    case Kind::host_time:
      return who + " takes the host's time and lets no simulated time pass";
    case Kind::interrupted:
      return "interrupted";
    default:
      break;
  }
  if (signal == SIGABRT) return who + " called abort()";
  if (signal == SIGILL) return "illegal instruction";
  if (signal == SIGTRAP) return "breakpoint instruction";
  if (signal == SIGFPE) return std::string("arithmetic trap: ") + arithmetic_text(code);
  if (stack_overflow) return "stack overflow";
  std::string text = "segmentation fault";
  if (!address_known) return text + ": access to an address that no machine has";
  switch (access) {
    case Access::read:
      text += ": read of ";
      break;
    case Access::write:
      text += ": write to ";
      break;
    case Access::execute:
      text += ": jump to ";
      break;
    case Access::unknown:
      text += ": access to ";
      break;
  }
  constexpr std::uintptr_t first_page = 4096;
  return text + vp::hex(address) + (address < first_page ? " (a null pointer)" : "");
}

void Fault::add_frame(std::uintptr_t address) {
  if (frame_count < most_frames) frames[frame_count++] = address;
}

void Fault::add_callers() {
  void* walked[most_frames];
  const int count = backtrace(walked, static_cast<int>(most_frames));
  for (int i = 0; i < count; ++i) add_frame(reinterpret_cast<std::uintptr_t>(walked[i]) - 1);
}

namespace {

/// Of the thread that waits for the end.
Fault stray_fault;
std::atomic<bool> stray_taken{false}, stray_known{false};

bool in_object(const Fault& fault) {
  for (std::size_t i = 0; i < fault.frame_count; ++i) {
    if (foreign_object_at(fault.frames[i])) return true;
  }
  return false;
}

}  // namespace

volatile bool ForeignCode::runs = false;
volatile ForeignCode::Stop ForeignCode::stop = ForeignCode::Stop::none;
volatile std::uint64_t ForeignCode::blocks_left = ~std::uint64_t{0};
volatile std::uint64_t ForeignCode::blocks_limit = ~std::uint64_t{0};

FaultTrap* FaultTrap::active_ = nullptr;
FaultTrap* FaultTrap::objects_ = nullptr;
FaultTrap::Changed FaultTrap::changed_;
bool (*FaultTrap::on_access)(std::uintptr_t address, void* context) = nullptr;

FaultTrap::FaultTrap(std::size_t stack_size, Of of) : stack_size_(stack_size), of_(of) {}

FaultTrap::~FaultTrap() {
  disarm();
}

// Noinline: the gap lies between the frame that lands and the program's.
__attribute__((noinline)) void FaultTrap::call_below(void (*code)(void* context), void* context) {
  // Read back below, so that it is not optimised away.
  volatile char room[gap];
  room[0] = 0;
  code(context);
  room[gap - 1] = room[0];
}

void FaultTrap::use_stack(std::uintptr_t first, std::size_t size) {
  own_stack_ = first;
  stack_size_ = size;
}

void FaultTrap::call_on_stack(void (*code)(void* context), void* context) {
  if (own_stack_ == 0) return call_below(code, context);
  run_on_stack(reinterpret_cast<void*>(own_stack_), stack_size_, code, context);
}

const Fault* FaultTrap::call(void (*code)(void* context), void* context) {
  char here = 0;
  stack_top_ = own_stack_ != 0 ? own_stack_ + stack_size_ : reinterpret_cast<std::uintptr_t>(&here);
  landed_ = false;
  fault_ = Fault();
  arm();
  if (sigsetjmp(landing_, 1) == 0) {
    try {
      call_on_stack(code, context);
    } catch (...) {
      disarm();
      throw;
    }
    disarm();
    return nullptr;
  }
  landed_ = true;
  disarm();
#if defined(__SANITIZE_ADDRESS__)
  // The frames that were left keep their marks otherwise.
  ASAN_UNPOISON_MEMORY_REGION(reinterpret_cast<void*>(stack_top_ - stack_size_ / 2),
                              stack_size_ / 2);
  ASAN_UNPOISON_MEMORY_REGION(signal_stack.data(), signal_stack.size());
#endif
  return &fault_;
}

void FaultTrap::arm() {
  armed_ = true;
  if (of_ == Of::objects) {
    outer_ = std::exchange(objects_, this);
  } else {
    active_ = this;
  }
  if (changed_.traps++ != 0) return;
  void* first[1];
  backtrace(first, 1);  // loads what it needs now, not in the signal handler
  stack_t stack{};
  stack.ss_sp = signal_stack.data();
  stack.ss_size = signal_stack_size;
  sigaltstack(&stack, &changed_.old_stack);
  struct sigaction action {};
  action.sa_sigaction = &FaultTrap::on_signal;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK | SA_NODEFER;
  sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < signal_count; ++i) {
    sigaction(signals[i], nullptr, &changed_.old_actions[i]);
    // Another owner steps through the program with it, and gives back what is not its own.
    if (signals[i] == SIGTRAP && changed_.old_actions[i].sa_handler != SIG_DFL) continue;
    sigaction(signals[i], &action, nullptr);
  }
  changed_.old_terminate = std::set_terminate(&FaultTrap::on_terminate);
  changed_.thread = pthread_self();
  static const int registered = std::atexit(&FaultTrap::on_exit);
  static_cast<void>(registered);
}

void FaultTrap::disarm() {
  if (!armed_) return;
  armed_ = false;
  if (of_ == Of::objects) objects_ = outer_;
  if (active_ == this) active_ = nullptr;
  if (--changed_.traps != 0) return;
  std::set_terminate(changed_.old_terminate);
  for (std::size_t i = 0; i < signal_count; ++i)
    sigaction(signals[i], &changed_.old_actions[i], nullptr);
  sigaltstack(&changed_.old_stack, nullptr);
}

bool FaultTrap::is_stack_overflow(std::uintptr_t address) const {
  const std::uintptr_t end = stack_top_ - stack_size_;
  return address < end + overflow_slack && address > end - overflow_range;
}

// Raises the signal again for its previous handler.
void FaultTrap::give_back(int signal) {
  for (std::size_t i = 0; i < signal_count; ++i) {
    if (signals[i] == signal) sigaction(signal, &changed_.old_actions[i], nullptr);
  }
}

// A second fault comes from walking a stack that the foreign code destroyed.
void FaultTrap::on_signal(int signal, siginfo_t* info, void* context) {
  const bool sent = info->si_code <= 0;
  const auto address = reinterpret_cast<std::uintptr_t>(info->si_addr);
  if (signal == SIGSEGV && !sent && on_access && on_access(address, context)) return;
  const bool by_code = can_leave();
  FaultTrap* const trap = by_code ? active_ : objects_;
  const bool by_others = sent && info->si_pid != getpid();
  const auto give_back_now = [&] {
#if !defined(__SANITIZE_ADDRESS__)  // whose report says more
    if (objects_ && !by_code && !by_others) end_if_damaged();
#endif
    give_back(signal);
    if (sent) raise_again(signal);
  };
  if (!trap || trap->landed_ || by_others) return give_back_now();
  Fault noted;  // in a thread of its own
  Fault& fault = in_own_thread() ? noted : trap->fault_;
  if (fault.kind != Fault::Kind::none) {
    if (by_code || vp::in_object(fault)) trap->land();
    return give_back_now();
  }
  fault.kind = Fault::Kind::signal;
  fault.signal = signal;
  fault.code = info->si_code;
  fault.access = access_of(signal, context);
  fault.address = address;
  fault.address_known = info->si_code > 0 && info->si_code != SI_KERNEL;
  fault.stack_overflow = (signal == SIGSEGV || signal == SIGBUS) && fault.address_known &&
                         (trap->is_stack_overflow(address) || is_beyond_stack(context, address));
  fault.add_frame(instruction_of(context));
  if (fault.access == Fault::Access::execute) fault.add_frame(caller_of_nothing(context) - 1);
  fault.add_callers();
  if (!by_code && !vp::in_object(fault)) {
    fault = Fault();
    return give_back_now();
  }
  if (in_own_thread()) wait_for_end(fault);
  trap->land();
}

void FaultTrap::land() {
  ForeignCode::runs = false;
  if (const auto listener = std::exchange(listener_, nullptr)) listener(fault_);
  siglongjmp(landing_, 1);
}

bool FaultTrap::in_own_thread() {
  return pthread_equal(changed_.thread, pthread_self()) == 0;
}

bool FaultTrap::can_leave() {
  return active_ && ForeignCode::runs && !in_own_thread();
}

// A fault while it is being recorded comes from a stack that the program destroyed: it lands, too.
void FaultTrap::leave(Fault::Kind kind, const char* call, int code) {
  Fault& fault = active_->fault_;
  fault.kind = kind;
  fault.call = call;
  fault.code = code;
  fault.add_callers();
  active_->land();
}

void FaultTrap::leave_at_stop() {
  leave(ForeignCode::stop == ForeignCode::Stop::interrupted ? Fault::Kind::interrupted
                                                            : Fault::Kind::host_time);
}

void FaultTrap::leave_if_foreign(Fault::Kind kind, const char* call, int code) {
  if (can_leave()) leave(kind, call, code);
  if (!objects_ || objects_->landed_ || !has_kept_objects()) return;
  Fault fault;
  fault.kind = kind;
  fault.call = call;
  fault.code = code;
  fault.add_callers();
  if (!vp::in_object(fault)) return;
  if (in_own_thread()) wait_for_end(fault);
  objects_->fault_ = fault;
  objects_->land();
}

bool FaultTrap::in_object(const void* context) {
  if (!has_kept_objects()) return false;
  Fault fault;
  fault.add_frame(instruction_of(context));
  fault.add_callers();
  return vp::in_object(fault);
}

void FaultTrap::leave_object_from_signal(const void* context) {
  if (!objects_ || objects_->landed_ || in_own_thread() || !in_object(context)) return;
  Fault& fault = objects_->fault_;
  fault.kind = Fault::Kind::host_time;
  fault.add_frame(instruction_of(context));
  fault.add_callers();
  objects_->land();
}

// The platform may be anywhere in its own code, so it is not interrupted here.
void FaultTrap::wait_for_end(const Fault& fault) {
  if (!stray_taken.exchange(true)) {
    stray_fault = fault;
    stray_known = true;
  }
  while (true) ::pause();
}

const Fault* FaultTrap::stray() {
  return stray_known ? &stray_fault : nullptr;
}

void FaultTrap::leave_from_signal(const void* context) {
  if (!can_leave()) return;
  active_->fault_.add_frame(instruction_of(context));
  leave_at_stop();
}

void FaultTrap::on_terminate() {
  leave_if_foreign(Fault::Kind::terminated);
  std::abort();
}

// A call inside the C library ends the process, which came around the functions below.
void FaultTrap::on_exit() {
  if (!objects_ || objects_->landed_) return;
  remove_part_files();
  constexpr std::string_view text =
      "markervp: a function of the C library that a program, an RTL or a design called ended the "
      "process: call none that does (err(), daemon())\n";
  static_cast<void>(!::write(STDERR_FILENO, text.data(), text.size()));
  constexpr int protocol_broken = 3;
  end_process(protocol_broken);
}

}  // namespace vp
