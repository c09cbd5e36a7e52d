#pragma once

#include <pthread.h>

#include <csetjmp>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include <ps/cpu/program_watch.h>

namespace ps {

/// What ended code of a program before it returned.
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
  int signal = 0;         ///< SIGSEGV, SIGBUS, SIGILL, SIGFPE or SIGABRT
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

  /// "segmentation fault: write to 0x00000010", without time and place.
  std::string text() const;
};

/// Runs code of a program; a fault in it ends that code, not the process. Nothing is unwound.
///
/// Only faults while ProgramWatch::runs are the program's; others end the process as they always
/// did. Calls of exit() and its relatives are faults, too: see fault_trap.cpp. Several may run code
/// by turns, each on a stack of its own, in one thread. The actions of the signals and the
/// alternative stack of the thread are changed while any call() runs.
class FaultTrap {
 public:
  /// The thread that will call() needs that much more stack than the program: what a program
  /// writes beyond its own frames by mistake then harms nobody.
  static constexpr std::size_t gap = 16 * 1024;

  /// `stack_size` of the thread that will call().
  explicit FaultTrap(std::size_t stack_size);
  ~FaultTrap();
  FaultTrap(const FaultTrap&) = delete;
  FaultTrap& operator=(const FaultTrap&) = delete;

  /// Calls `code(context)`. Null if it returned, otherwise what stopped it. Exceptions pass. A
  /// limit of 0 ns is none.
  const Fault* call(void (*code)(void* context), void* context, const HostLimit& limit);
  /// Told of a fault before its code is left, in a signal handler if a signal was it; once.
  void on_fault(std::function<void(const Fault&)> listener) { listener_ = std::move(listener); }
  /// The code that runs now is that of its call().
  void resume() { active_ = this; }
  /// The code of its call() never goes on.
  void abandon() { disarm(); }

  /// The program's code runs in this thread: it can be left.
  static bool can_leave();
  /// Ends the program's code that calls it, as a fault would.
  [[noreturn]] static void leave(Fault::Kind kind, const char* call = "", int code = 0);
  /// The same because of ProgramWatch::stop.
  [[noreturn]] static void leave_at_stop();

 private:
  static constexpr int signals[] = {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT};
  static constexpr std::size_t signal_count = sizeof signals / sizeof signals[0];

  static void call_below(void (*code)(void* context), void* context);
  void arm();
  void disarm();
  static void on_signal(int signal, siginfo_t* info, void* context);
  static void on_terminate();
  static void leave_from_signal(const void* context);
  static void give_back(int signal);
  [[noreturn]] void land();
  bool is_stack_overflow(std::uintptr_t address) const;

  std::size_t stack_size_;
  std::function<void(const Fault&)> listener_;
  std::uintptr_t stack_top_ = 0;
  HostWatch watch_;
  bool watched_ = false;
  bool armed_ = false;
  bool landed_ = false;
  sigjmp_buf landing_;
  Fault fault_;

  /// What is changed in the process while traps are armed, and what was there before.
  struct Changed {
    unsigned traps = 0;
    std::unique_ptr<char[]> signal_stack;
    stack_t old_stack{};
    struct sigaction old_actions[signal_count] = {};
    std::terminate_handler old_terminate = nullptr;
    pthread_t thread{};
  };
  static Changed changed_;
  static FaultTrap* active_;
};

}  // namespace ps
