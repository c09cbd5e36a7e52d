#pragma once

#include <csetjmp>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <string>

#include <ps/cpu/empty_loop.h>

namespace ps {

/// What the host's processor refused to do for the program.
struct Fault {
  int signal = 0;  ///< SIGSEGV, SIGBUS, SIGILL, SIGFPE or SIGABRT
  int code = 0;    ///< si_code
  enum class Access { unknown, read, write, execute };
  Access access = Access::unknown;  ///< of SIGSEGV and SIGBUS
  std::uintptr_t address = 0;       ///< of SIGSEGV and SIGBUS
  bool address_known = false;
  bool stack_overflow = false;
  bool terminated = false;  ///< std::terminate() was called
  static constexpr std::size_t most_frames = 64;
  /// The instruction, and inside those that called its function and its callers.
  std::uintptr_t frames[most_frames] = {};
  std::size_t frame_count = 0;

  /// "segmentation fault: write to 0x00000010", without time and place.
  std::string text() const;
};

/// Runs code of a program; a fault in it ends that code, not the process. Nothing is unwound.
///
/// Only faults while ProgramWatch::runs are the program's; others end the process as they always
/// did. One in a process at a time. It changes the actions of the signals and the alternative stack
/// of the thread while call() runs.
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

  /// Calls `code(context)`. Null if it returned, otherwise what stopped it. Exceptions pass.
  const Fault* call(void (*code)(void* context), void* context);

 private:
  static constexpr int signals[] = {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT};
  static constexpr std::size_t signal_count = sizeof signals / sizeof signals[0];

  static void call_below(void (*code)(void* context), void* context);
  void arm();
  void disarm();
  static void on_signal(int signal, siginfo_t* info, void* context);
  static void on_terminate();
  void give_back(int signal);
  bool is_stack_overflow(std::uintptr_t address) const;

  std::size_t stack_size_;
  std::uintptr_t stack_top_ = 0;
  std::unique_ptr<char[]> signal_stack_;
  stack_t old_stack_{};
  struct sigaction old_actions_[signal_count] = {};
  EmptyLoopWatch empty_loops_;
  std::terminate_handler old_terminate_ = nullptr;
  bool armed_ = false;
  bool landed_ = false;
  sigjmp_buf landing_;
  Fault fault_;

  static FaultTrap* active_;
};

}  // namespace ps
