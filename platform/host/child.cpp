#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <ctime>
#include <iostream>
#include <system_error>
#include <utility>

#include <host/child.h>
#include <host/process.h>
#include <vp/output_file.h>

namespace platform::host {

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

CommandEnd run_command(const std::vector<std::string>& arguments) {
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
    throw std::system_error(errno, std::generic_category(), "no pipe");
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  // What we ignore would be ignored by the command, too.
  sigset_t usual;
  sigemptyset(&usual);
  sigaddset(&usual, SIGPIPE);
  sigaddset(&usual, SIGXFSZ);
  posix_spawnattr_setsigdefault(&attributes, &usual);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
  pid_t process = 0;
  const int error = ::posix_spawnp(&process, argv[0], &actions, &attributes, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  ::close(ends[1]);
  CommandEnd end;
  if (error == 0) {
    end.out = read_all(ends[0]);
    int status = 0;
    while (::waitpid(process, &status, 0) < 0 && errno == EINTR) continue;
    if (WIFEXITED(status)) end.exit_code = WEXITSTATUS(status);
  }
  ::close(ends[0]);
  if (error == ENOENT || error == EACCES)
    end.exit_code = no_such_command;
  else if (error != 0)
    throw std::system_error(error, std::generic_category(), argv[0]);
  return end;
}

std::string shell_quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

CommandEnd draw_with_gnuplot(const std::string& file, const std::string& script) {
  vp::OutputFile plot(file, vp::OutputFile::By::name);
  const vp::PartFile commands(plot.part() + ".gnuplot");
  vp::write_file(commands.path(), "set output " + gnuplot_quoted(plot.part()) + "\n" + script);
  CommandEnd end = run_command({"gnuplot", commands.path()});
  if (end.exit_code == 0) plot.commit();
  return end;
}

std::string gnuplot_quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
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
  // What stands in the buffers would be printed twice.
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

void Child::become(const Work& work, pid_t parent) {
  // Not SIGKILL: it would leave part files.
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(run_failed);
  ::dup2(out_, STDOUT_FILENO);
  ::dup2(err_, STDERR_FILENO);
  int code = run_failed;
  try {
    code = exit_code_of([&] { return work(std::cout, std::cerr); }, std::cerr);
  } catch (...) {
    std::cerr << "markervp: unknown error\n";
  }
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

}  // namespace platform::host
