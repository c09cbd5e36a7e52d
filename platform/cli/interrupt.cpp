#include <cli/interrupt.h>

#include <sys/syscall.h>
#include <unistd.h>

#include <string_view>

#include <cli/program.h>

namespace platform::cli {

namespace {

/// Of the second that a run has after a signal, for the frame at hand. The rest is for its results.
constexpr std::uint64_t frame_ns = 300'000'000;
constexpr std::uint64_t all_ns = 900'000'000;

volatile std::sig_atomic_t noted = 0;
InterruptGuard* volatile innermost = nullptr;

/// Nothing but system calls: it comes from a signal handler. Not _exit(), which ends a program that
/// runs (ps/cpu/host_calls.cpp).
[[noreturn]] void end_now() {
  constexpr std::string_view text = "markervp: interrupted\n";
  static_cast<void>(!::write(STDERR_FILENO, text.data(), text.size()));
  while (true) ::syscall(SYS_exit_group, interrupted);
}

void handle(void (*handler)(int), struct sigaction* old_interrupt,
            struct sigaction* old_terminate) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART | SA_ONSTACK;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, old_interrupt);
  sigaction(SIGTERM, &action, old_terminate);
}

}  // namespace

void end_at_interrupts() {
  handle([](int) { end_now(); }, nullptr, nullptr);
}

InterruptGuard::InterruptGuard(Simulation* bounded) : bounded_(bounded), outer_(innermost) {
  noted = 0;
  innermost = this;
  handle(&InterruptGuard::on_signal, &old_interrupt_, &old_terminate_);
}

InterruptGuard::~InterruptGuard() {
  sigaction(SIGINT, &old_interrupt_, nullptr);
  sigaction(SIGTERM, &old_terminate_, nullptr);
  vp::HostTicks::remove(*this);
  innermost = outer_;
}

bool InterruptGuard::interrupted() {
  return noted != 0;
}

void InterruptGuard::on_signal(int) {
  if (noted != 0) end_now();
  noted = 1;
  InterruptGuard* const guard = innermost;
  if (guard->bounded_) vp::HostTicks::add(*guard);
}

void InterruptGuard::on_tick(std::uint64_t spent_ns, void*) {
  spent_ns_ += spent_ns;
  if (spent_ns_ >= all_ns) end_now();
  if (spent_ns_ >= frame_ns) bounded_->interrupt();
}

}  // namespace platform::cli
