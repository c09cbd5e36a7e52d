#include <host/process.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <initializer_list>
#include <new>
#include <ostream>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <vp/error.h>
#include <vp/output_file.h>

namespace platform::host {

namespace {

constexpr const char* standard_output = "standard output";

/// What a message quotes may be anything: lines, escape sequences of the terminal, a megabyte. One
/// line comes of it, with the beginning, which says where, and the end, which says what to do.
std::string one_line(std::string text) {
  constexpr std::size_t longest = 4000;
  constexpr std::size_t part = 1500;
  if (text.size() > longest) {
    text = text.substr(0, part) + " [... " + std::to_string(text.size() - 2 * part) +
           " characters ...] " + text.substr(text.size() - part);
  }
  std::replace_if(
      text.begin(), text.end(), [](char c) { return (c >= 0 && c < ' ') || c == 0x7f; }, ' ');
  return text;
}

void end_as_the_system_does(int signal) {
  std::signal(signal, SIG_DFL);
  // It is blocked while its handler runs.
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, signal);
  ::sigprocmask(SIG_UNBLOCK, &set, nullptr);
  ::raise(signal);
}

/// Of the second that a run has after a signal, for the frame at hand. The rest is for its results.
constexpr std::uint64_t frame_ns = 300'000'000;
constexpr std::uint64_t all_ns = 900'000'000;

volatile std::sig_atomic_t signal_noted = 0;
InterruptGuard* volatile innermost = nullptr;

}  // namespace

int fail(std::ostream& err, const std::string& message, ExitCode code) {
  err << "markervp: " << one_line(message) << std::endl;
  return code;
}

int exit_code_of(const std::function<int()>& work, std::ostream& err) {
  try {
    return work();
  } catch (const vp::InputError& error) {
    return fail(err, error.what(), wrong_input);
  } catch (const vp::ProtocolError& error) {
    return fail(err, error.what(), protocol_broken);
  } catch (const std::bad_alloc&) {
    return fail(
        err,
        "not enough memory on this machine: choose smaller images, depths or files, or give "
        "it more",
        wrong_input);
  } catch (const std::filesystem::filesystem_error& error) {
    const std::string file = error.path1().string();
    return fail(err, (file.empty() ? "" : "'" + file + "': ") + error.code().message(),
                wrong_input);
  } catch (const std::exception& error) {
    return fail(err, std::string("the model failed: ") + error.what(), protocol_broken);
  }
}

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
  while (true) ::syscall(SYS_exit_group, interrupted);
}

InterruptGuard::InterruptGuard(std::function<void()> interrupt)
    : interrupt_(std::move(interrupt)), outer_(innermost) {
  signal_noted = 0;
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

bool InterruptGuard::noted() {
  return signal_noted != 0;
}

void InterruptGuard::on_signal(int signal) {
  if (signal_noted != 0) end_by(signal);
  signal_noted = signal;
  InterruptGuard* const guard = innermost;
  if (guard->interrupt_) vp::HostTicks::add(*guard);
}

void InterruptGuard::on_host_tick(std::uint64_t spent_ns, void*) {
  spent_ns_ += spent_ns;
  if (spent_ns_ >= all_ns) end_by(signal_noted);
  if (spent_ns_ >= frame_ns) interrupt_();
}

void fill_standard_descriptors() {
  for (int descriptor = STDIN_FILENO; descriptor <= STDERR_FILENO; ++descriptor) {
    // The lowest free number is the one that is missing.
    if (::fcntl(descriptor, F_GETFD) < 0) ::open("/dev/null", O_RDONLY);
  }
}

void check_written(std::ostream& out) {
  if (!out.flush()) throw vp::OutputError(standard_output, errno);
}

// Closing a copy tells the same as closing the stream, which destructors may still want to write
// to.
void check_standard_output() {
  const bool written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  const int copy = written ? ::dup(STDOUT_FILENO) : -1;
  if (!written || (copy >= 0 && ::close(copy) != 0)) throw vp::OutputError(standard_output, errno);
}

std::string host_name() {
  char name[256] = "";
  if (::gethostname(name, sizeof name - 1) != 0) return "unknown";
  return name;
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  ::gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

std::vector<std::string> library_folders() {
  std::error_code error;
  const std::filesystem::path executable = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::filesystem::path root = executable.parent_path().parent_path();
  std::vector<std::string> folders{(root / "lib" / "markervp").string()};
  const std::string system = (root / MARKERVP_LIBDIR / "markervp").string();
  if (system != folders.front()) folders.push_back(system);
  return folders;
}

}  // namespace platform::host
