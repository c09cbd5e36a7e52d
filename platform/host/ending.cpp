#include <host/ending.h>

#include <sys/syscall.h>
#include <unistd.h>

#include <csignal>
#include <initializer_list>
#include <string_view>

#include <vp/output_file.h>

namespace platform::host {

namespace {

void end_as_the_system_does(int signal) {
  std::signal(signal, SIG_DFL);
  // It is blocked while its handler runs.
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, signal);
  ::sigprocmask(SIG_UNBLOCK, &set, nullptr);
  ::raise(signal);
}

}  // namespace

void prepare_signals() {
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) {
    struct sigaction action {
    }, old{};
    action.sa_handler = end_by;
    action.sa_flags = SA_RESTART | SA_ONSTACK;
    sigemptyset(&action.sa_mask);
    sigaction(signal, &action, &old);
    // What nohup or a shell told the process to ignore stays ignored.
    if (old.sa_handler == SIG_IGN) sigaction(signal, &old, nullptr);
  }
}

// Nothing but system calls, as it comes from a signal handler. Not _exit(), which ends a PS program
// that runs (ps/cpu/fault_trap.cpp).
void end_by(int signal) {
  vp::remove_part_files();
  if (signal == SIGQUIT) end_as_the_system_does(signal);
  constexpr std::string_view text = "markervp: interrupted\n";
  static_cast<void>(!::write(STDERR_FILENO, text.data(), text.size()));
  while (true) ::syscall(SYS_exit_group, interrupted_code);
}

}  // namespace platform::host
