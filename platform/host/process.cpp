#include <host/process.h>

#include <host/guard.h>

#include <dlfcn.h>
#include <fcntl.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/kernel.h>
#include <vp/text.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <initializer_list>
#include <iostream>
#include <new>
#include <ostream>
#include <string_view>
#include <system_error>
#include <utility>

namespace platform::host {

namespace {

constexpr const char* standard_output = "standard output";

/// What a message quotes may be anything: lines, escape sequences of the terminal, a megabyte.
/// One line comes of it, with the beginning, which says where, and the end, which says what to
/// do.
std::string one_line(std::string text) {
  constexpr std::size_t longest = 4000;
  constexpr std::size_t part = 1500;
  if (text.size() > longest) {
    text = text.substr(0, part) + " [... " + std::to_string(text.size() - 2 * part) +
           " characters ...] " + text.substr(text.size() - part);
  }
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\t'; }, ' ');
  return vp::visible(text);
}

void end_as_the_system_does(int signal) {
  std::signal(signal, SIG_DFL);
  // It is blocked while its handler runs.
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, signal);
  ::sigprocmask(SIG_UNBLOCK, &set, nullptr);
  vp::raise_again(signal);
}

/// Of the second that a run has after a signal, for the frame at hand. The rest is for its
/// results.
constexpr std::uint64_t frame_ns = 300'000'000;
constexpr std::uint64_t all_ns = 900'000'000;

volatile std::sig_atomic_t signal_noted = 0;
InterruptGuard* volatile innermost = nullptr;

}  // namespace

int fail(std::ostream& err, const std::string& message, ExitCode code) {
  err << "markervp: " << one_line(message) << std::endl;
  return code;
}

namespace {

int fail_as_model(std::ostream& err, const std::exception& error) {
  return fail(err, std::string("the model failed: ") + error.what(), protocol_broken);
}

}  // namespace

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
        "not enough memory on this machine: choose smaller inputs, depths or files, or give "
        "it more",
        wrong_input);
  } catch (const std::filesystem::filesystem_error& error) {
    const std::string file = error.path1().string();
    return fail(
        err,
        (file.empty() ? "" : "'" + file + "': ") + error.code().message() +
            (vp::HostError::is_cause(error.code()) ? vp::advice_for(error.code().value()) : ""),
        wrong_input);
  } catch (const std::system_error& error) {
    if (!vp::HostError::is_cause(error.code())) return fail_as_model(err, error);
    return fail(err, error.what() + vp::advice_for(error.code().value()), wrong_input);
  } catch (const std::exception& error) {
    return fail_as_model(err, error);
  } catch (...) {
    return fail(err, "the model failed: it threw an exception of an unknown type", protocol_broken);
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

// Nothing but system calls, as it comes from a signal handler. Not _exit(), which ends a PS
// program that runs (vp/foreign/process_calls.cpp).
void end_by(int signal) {
  vp::remove_part_files();
  if (signal == SIGQUIT) end_as_the_system_does(signal);
  constexpr std::string_view text = "markervp: interrupted\n";
  static_cast<void>(!::write(STDERR_FILENO, text.data(), text.size()));
  vp::end_process(interrupted);
}

InterruptGuard::InterruptGuard(std::function<void()> interrupt)
    : interrupt_(std::move(interrupt)), outer_(innermost) {
  // What an outer guard noted holds: work that begins in between ends soon, too.
  if (!outer_) signal_noted = 0;
  innermost = this;
  struct sigaction action {};
  action.sa_handler = &InterruptGuard::on_signal;
  action.sa_flags = SA_RESTART | SA_ONSTACK;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, &old_interrupt_);
  sigaction(SIGTERM, &action, &old_terminate_);
  sigaction(SIGHUP, &action, &old_hang_up_);
  // nohup: the run continues.
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

bool is_socket(int descriptor) {
  struct stat status;
  return ::fstat(descriptor, &status) == 0 && S_ISSOCK(status.st_mode);
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

unsigned usable_cores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (::sched_getaffinity(0, sizeof set, &set) != 0) return 1;
  return static_cast<unsigned>(std::max(1, CPU_COUNT(&set)));
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
  static const std::vector<std::string> all = [] {
    std::error_code error;
    const std::filesystem::path executable = std::filesystem::read_symlink("/proc/self/exe", error);
    const std::filesystem::path root = executable.parent_path().parent_path();
    std::vector<std::string> folders{(root / "lib" / "markervp").string()};
    const std::string system = (root / MARKERVP_LIBDIR / "markervp").string();
    if (system != folders.front()) folders.push_back(system);
    return folders;
  }();
  return all;
}

void* load_plugin(const std::vector<std::string>& folders, const std::string& file,
                  const std::string& entry, const std::string& problem) {
  for (const std::string& folder : folders) {
    const std::string path = (std::filesystem::path(folder) / file).string();
    if (!std::filesystem::exists(path)) continue;
    void* library = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) {
      throw vp::InputError(problem + ": '" + path + "': " + vp::load_problem(path, ::dlerror()) +
                           "; install markervp completely");
    }
    void* function = ::dlsym(library, entry.c_str());
    if (function != nullptr) return function;
    throw vp::InputError(problem + ": '" + path +
                         "' is of another version than this program; install both anew");
  }
  throw vp::InputError(problem + ": " + file + " is missing in " + vp::one_of(folders) +
                       "; install markervp completely");
}

namespace {

std::string read_all(int pipe) {
  std::string text;
  char buffer[4096];
  for (;;) {
    const ssize_t count = ::read(pipe, buffer, sizeof buffer);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(buffer, static_cast<std::size_t>(count));
  }
}

}  // namespace

void require_descriptors(int count, const std::string& command) {
  std::vector<int> copies;
  int error = 0;
  while (error == 0 && static_cast<int>(copies.size()) < count) {
    const int copy = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 0);
    copy < 0 ? static_cast<void>(error = errno) : copies.push_back(copy);
  }
  for (const int copy : copies) ::close(copy);
  if (error == 0) return;
  throw vp::HostError("'" + command + "' opens " + std::to_string(count) +
                      " files at once, and this process may not: " +
                      std::generic_category().message(error) + vp::advice_for(error));
}

CommandEnd run_command(const std::vector<std::string>& arguments, const std::string& temporary) {
  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
    throw std::system_error(errno, std::generic_category(), "no pipe");
  const auto become = [&] {
    ::dup2(::open("/dev/null", O_RDONLY | O_CLOEXEC), STDIN_FILENO);
    ::dup2(ends[1], STDOUT_FILENO);
    ::dup2(ends[1], STDERR_FILENO);
    if (!temporary.empty()) ::setenv("TMPDIR", temporary.c_str(), 1);
    ::execvp(argv[0], argv.data());
    return errno;
  };
  CommandEnd end;
  try {
    ProcessTree command(become);
    ::close(std::exchange(ends[1], -1));
    end.out = read_all(ends[0]);
    const int status = command.wait();
    if (WIFEXITED(status)) end.exit_code = WEXITSTATUS(status);
  } catch (const std::system_error& error) {
    for (const int descriptor : ends) ::close(descriptor);
    const int reason = error.code().value();
    if (reason != ENOENT && reason != EACCES) throw;
    end.exit_code = no_such_command;
    return end;
  }
  ::close(ends[0]);
  return end;
}

std::string shell_quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

namespace {

[[noreturn]] void refuse(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

std::string content(int file) {
  std::string text;
  char buffer[4096];
  ::lseek(file, 0, SEEK_SET);
  for (ssize_t count; (count = ::read(file, buffer, sizeof buffer)) > 0;) {
    text.append(buffer, static_cast<std::size_t>(count));
  }
  return text;
}

}  // namespace

Child::Child(const Work& work)
    : out_(::memfd_create("out", MFD_CLOEXEC)), err_(::memfd_create("err", MFD_CLOEXEC)) {
  // What is in the buffers would be printed twice.
  std::cout.flush();
  std::cerr.flush();
  const pid_t parent = ::getpid();
  if (out_ >= 0 && err_ >= 0) process_ = ::fork();
  if (out_ < 0 || err_ < 0 || process_ < 0) {
    const int reason = errno;
    ::close(out_);
    ::close(err_);
    errno = reason;
    refuse("cannot start a process for a run");
  }
  if (process_ == 0) become(work, parent);
}

Child::Child(Child&& other) noexcept
    : process_(std::exchange(other.process_, 0)),
      out_(std::exchange(other.out_, -1)),
      err_(std::exchange(other.err_, -1)) {}

Child::~Child() {
  if (process_ > 0) end();
  ::close(out_);
  ::close(err_);
}

// It takes its part files away; what does not hear is ended.
void Child::end() {
  constexpr timespec pause{0, 10'000'000};
  constexpr int most_pauses = 200;
  ::kill(process_, SIGTERM);
  for (int i = 0; i < most_pauses && !ended(); ++i) ::nanosleep(&pause, nullptr);
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
}

namespace {

/// Ends this process some time after its parent, whatever it is at: SIGTERM lets a point end.
class ParentWatch final : private vp::HostTicks::Listener {
 public:
  explicit ParentWatch(pid_t parent) : parent_(parent) { vp::HostTicks::add(*this); }
  ~ParentWatch() { vp::HostTicks::remove(*this); }
  ParentWatch(const ParentWatch&) = delete;
  ParentWatch& operator=(const ParentWatch&) = delete;

 private:
  void on_host_tick(std::uint64_t spent_ns, void*) override {
    constexpr std::uint64_t patience_ns = 2'000'000'000;
    if (::getppid() == parent_) return;
    alone_ns_ += spent_ns;
    if (alone_ns_ >= patience_ns) end_by(SIGTERM);
  }

  pid_t parent_;
  std::uint64_t alone_ns_ = 0;
};

}  // namespace

void Child::become(const Work& work, pid_t parent) {
  // Not SIGKILL: it would leave part files.
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  const ParentWatch watch(parent);
  if (::getppid() != parent) ::_exit(run_failed);
  ::dup2(out_, STDOUT_FILENO);
  ::dup2(err_, STDERR_FILENO);
  const int code = exit_code_of([&] { return work(std::cout, std::cerr); }, std::cerr);
  std::cout.flush();
  std::cerr.flush();
  // Without destructors of static objects: those are the parent's to end.
  ::_exit(code);
}

bool Child::ended() const {
  siginfo_t info{};
  ::waitid(P_PID, static_cast<id_t>(process_), &info, WEXITED | WNOHANG | WNOWAIT);
  return info.si_pid != 0;
}

ChildEnd Child::wait() {
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) continue;
  process_ = 0;
  ChildEnd end;
  if (WIFEXITED(status)) end.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) end.signal = WTERMSIG(status);
  end.out = content(out_);
  end.err = content(err_);
  return end;
}

WorkingFolder::WorkingFolder() : descriptor_(::open(".", O_PATH | O_DIRECTORY | O_CLOEXEC)) {}

WorkingFolder::~WorkingFolder() {
  restore();
  if (descriptor_ >= 0) ::close(descriptor_);
}

void WorkingFolder::restore() const {
  if (descriptor_ >= 0) static_cast<void>(!::fchdir(descriptor_));
}

}  // namespace platform::host
