#pragma once

#include <pthread.h>

#include <csetjmp>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <string>
#include <utility>

namespace vp {

/// Code that the platform does not answer for: of a PS program, or of a shared object's
/// constructors.
struct ForeignCode {
  /// It runs, and a fault is its own; false: the platform's code does.
  static volatile bool runs;

  /// Why it is to end.
  enum class Stop : std::uint8_t { none, host_time, interrupted };
  static volatile Stop stop;

  /// Basic blocks of instrumented code (-fsanitize-coverage=trace-pc) until it is looked at, and
  /// from one look to the next.
  static volatile std::uint64_t blocks_left, blocks_limit;

  /// Ends it at its next instrumented basic block. May be called in a signal handler.
  static void ask_to_stop(Stop why) {
    stop = why;
    blocks_limit = 1;
    if (runs) blocks_left = 1;
  }
  /// It is about to run; `blocks` without a look.
  static void start(std::uint64_t blocks = ~std::uint64_t{0}) {
    stop = Stop::none;
    blocks_left = blocks_limit = blocks;
    runs = true;
  }
};

/// What ended foreign code before it returned.
struct Fault {
  enum class Kind {
    none,
    signal,       ///< the host's processor refused to do something
    terminated,   ///< std::terminate() was called
    exit,         ///< exit() or a relative
    forbidden,    ///< another call that is not for programs
    no_hal,       ///< a HAL call while no processor runs the program
    host_time,    ///< it took too much of the host's time
    interrupted,  ///< the user wants an end
  };
  Kind kind = Kind::none;
  int signal = 0;         ///< SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT or SIGTRAP
  int code = 0;           ///< si_code; of an exit its status
  const char* call = "";  ///< the function that was called, of exit, forbidden and no_hal
  enum class Access { unknown, read, write, execute };
  Access access = Access::unknown;  ///< of SIGSEGV and SIGBUS
  std::uintptr_t address = 0;       ///< of SIGSEGV and SIGBUS
  bool address_known = false;
  bool stack_overflow = false;
  static constexpr std::size_t most_frames = 64;
  /// The instruction, and inside those that called its function and its callers.
  std::uintptr_t frames[most_frames] = {};
  std::size_t frame_count = 0;
  void add_frame(std::uintptr_t address);
  /// Adds the calls that are under way.
  void add_callers();

  /// "segmentation fault: write to 0x00000010", "the program called exit(0)", without time and
  /// place.
  std::string text(const std::string& who = "the program") const;
};

/// Runs foreign code; a fault in it ends that code, not the process. Nothing is unwound.
///
/// Faults while ForeignCode::runs belong to it. Calls of exit() and its relatives are faults, too:
/// see process_calls.cpp. Several traps may run code by turns, each on a stack of its own, in one
/// thread. The actions of the signals and the alternative stack of the thread are changed while any
/// call() runs.
///
/// A trap of `Of::objects` runs the platform's code, which calls shared objects that a user brought
/// (foreign_object.h): faults while a function of one is under way belong to it. All others end the
/// process: see end_if_damaged(). Such traps may be nested.
class FaultTrap {
 public:
  enum class Of { code, objects };

  /// Extra stack that the thread that will call() needs beyond the program's: it absorbs writes
  /// beyond the program's own frames.
  static constexpr std::size_t gap = 16 * 1024;

  /// `stack_size` of the thread that will call().
  explicit FaultTrap(std::size_t stack_size, Of of = Of::code);
  ~FaultTrap();
  FaultTrap(const FaultTrap&) = delete;
  FaultTrap& operator=(const FaultTrap&) = delete;

  /// From now on code runs on the stack [first, first + size), whose lowest page is closed, instead
  /// of the rest of the thread's.
  void use_stack(std::uintptr_t first, std::size_t size);
  /// Calls `code(context)`. Null if it returned, otherwise what stopped it. Lets exceptions pass.
  const Fault* call(void (*code)(void* context), void* context);
  /// Called once, before the faulting code is left: in a signal handler if the fault was a signal.
  void on_fault(std::function<void(const Fault&)> listener) { listener_ = std::move(listener); }
  /// The code of its call() runs now.
  void resume() { active_ = this; }
  /// The code of its call() never resumes.
  void abandon() { disarm(); }

  /// Foreign code runs in this thread: it can be left.
  static bool can_leave();
  /// Ends the foreign code that calls it, as a fault would.
  [[noreturn]] static void leave(Fault::Kind kind, const char* call = "", int code = 0);
  /// The same because of ForeignCode::stop.
  [[noreturn]] static void leave_at_stop();
  /// The same, in a signal handler with this `context` (a ucontext_t). Returns where nothing can be
  /// left.
  static void leave_from_signal(const void* context);
  /// Ends the foreign code that calls it, or the object's function that is under way. Returns where
  /// there is neither.
  static void leave_if_foreign(Fault::Kind kind, const char* call = "", int code = 0);

  /// In a signal handler with this `context`: ends the object's function that is under way in this
  /// thread because it takes too long. Returns if no function is under way.
  static void leave_object_from_signal(const void* context);
  /// A function of an object is under way at the `context` of a signal.
  static bool in_object(const void* context);
  /// What ended an object's function in a thread of its own, which waits since; null: nothing.
  static const Fault* stray();

  /// Asked first at a segmentation fault; true: the instruction is to be tried again. For a signal
  /// handler. Null: not asked.
  static bool (*on_access)(std::uintptr_t address, void* context);

 private:
  static constexpr int signals[] = {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGTRAP};
  static constexpr std::size_t signal_count = sizeof signals / sizeof signals[0];

  static void call_below(void (*code)(void* context), void* context);
  void call_on_stack(void (*code)(void* context), void* context);
  void arm();
  void disarm();
  static void on_signal(int signal, siginfo_t* info, void* context);
  static void on_terminate();
  static void on_exit();
  static void give_back(int signal);
  static bool in_own_thread();
  [[noreturn]] static void wait_for_end(const Fault& fault);
  [[noreturn]] void land();
  bool is_stack_overflow(std::uintptr_t address) const;

  std::size_t stack_size_;
  std::uintptr_t own_stack_ = 0;  ///< its first byte; 0: the thread's
  const Of of_;
  FaultTrap* outer_ = nullptr;  ///< of objects, around this one
  std::function<void(const Fault&)> listener_;
  std::uintptr_t stack_top_ = 0;
  bool armed_ = false;
  bool landed_ = false;
  sigjmp_buf landing_;
  Fault fault_;

  /// What is changed in the process while traps are armed, and what was there before.
  struct Changed {
    unsigned traps = 0;
    stack_t old_stack{};
    struct sigaction old_actions[signal_count] = {};
    std::terminate_handler old_terminate = nullptr;
    pthread_t thread{};
  };
  static Changed changed_;
  static FaultTrap* active_;   ///< whose code runs, or ran last
  static FaultTrap* objects_;  ///< the innermost one of objects
};

/// exit() of the C library, also while ForeignCode::runs.
[[noreturn]] void run_exit_handlers(int code);

}  // namespace vp
