#include <cli/interrupt.h>

#include <host/ending.h>

namespace platform::cli {

namespace {

/// Of the second that a run has after a signal, for the frame at hand. The rest is for its results.
constexpr std::uint64_t frame_ns = 300'000'000;
constexpr std::uint64_t all_ns = 900'000'000;

volatile std::sig_atomic_t noted = 0;
InterruptGuard* volatile innermost = nullptr;

}  // namespace

InterruptGuard::InterruptGuard(Simulation* bounded) : bounded_(bounded), outer_(innermost) {
  noted = 0;
  innermost = this;
  struct sigaction action {};
  action.sa_handler = &InterruptGuard::on_signal;
  action.sa_flags = SA_RESTART | SA_ONSTACK;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, &old_interrupt_);
  sigaction(SIGTERM, &action, &old_terminate_);
  sigaction(SIGHUP, &action, &old_hang_up_);
  // nohup: the run goes on.
  if (old_hang_up_.sa_handler == SIG_IGN) sigaction(SIGHUP, &old_hang_up_, nullptr);
}

InterruptGuard::~InterruptGuard() {
  sigaction(SIGINT, &old_interrupt_, nullptr);
  sigaction(SIGTERM, &old_terminate_, nullptr);
  sigaction(SIGHUP, &old_hang_up_, nullptr);
  vp::HostTicks::remove(*this);
  innermost = outer_;
}

bool InterruptGuard::interrupted() {
  return noted != 0;
}

void InterruptGuard::on_signal(int signal) {
  if (noted != 0) host::end_by(signal);
  noted = signal;
  InterruptGuard* const guard = innermost;
  if (guard->bounded_) vp::HostTicks::add(*guard);
}

void InterruptGuard::on_host_tick(std::uint64_t spent_ns, void*) {
  spent_ns_ += spent_ns;
  if (spent_ns_ >= all_ns) host::end_by(noted);
  if (spent_ns_ >= frame_ns) bounded_->interrupt();
}

}  // namespace platform::cli
