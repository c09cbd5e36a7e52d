#include <cli/run_child.h>

#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <iostream>
#include <system_error>
#include <utility>

#include <cli/program.h>

namespace platform::cli {

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

RunChild::RunChild(const Work& work)
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

RunChild::RunChild(RunChild&& other) noexcept
    : process_(std::exchange(other.process_, 0)),
      out_(std::exchange(other.out_, -1)),
      err_(std::exchange(other.err_, -1)) {}

RunChild::~RunChild() {
  if (process_ > 0) {
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }
  ::close(out_);
  ::close(err_);
}

void RunChild::become(const Work& work, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
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

bool RunChild::ended() const {
  siginfo_t info{};
  ::waitid(P_PID, static_cast<id_t>(process_), &info, WEXITED | WNOHANG | WNOWAIT);
  return info.si_pid != 0;
}

ChildEnd RunChild::wait() {
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

}  // namespace platform::cli
