#include <host/guard.h>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <random>
#include <sstream>
#include <system_error>
#include <vector>

#include <vp/error.h>
#include <vp/kernel.h>

namespace platform::host {

namespace {

namespace fs = std::filesystem;

/// All signals are blocked while it lives.
class NoSignals {
 public:
  NoSignals() {
    sigset_t all;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~NoSignals() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  NoSignals(const NoSignals&) = delete;
  NoSignals& operator=(const NoSignals&) = delete;

 private:
  sigset_t before_;
};

// Not _exit(), which ends a PS program that runs.
[[noreturn]] void leave() {
  vp::end_process(0);
}

void use_default_signals() {
  constexpr int signals = 65;
  for (int signal = 1; signal < signals; ++signal) std::signal(signal, SIG_DFL);
  sigset_t none;
  ::sigemptyset(&none);
  ::pthread_sigmask(SIG_SETMASK, &none, nullptr);
}

/// The errno with which it could not become the command comes over the pipe, which exec() closes.
pid_t start(const Guard::Become& become, int& error) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return error = errno, -1;
  const pid_t process = ::fork();
  if (process == 0) {
    ::setpgid(0, 0);
    use_default_signals();
    const int reason = become();
    static_cast<void>(!::write(ends[1], &reason, sizeof reason));
    leave();
  }
  error = process < 0 ? errno : 0;
  ::close(ends[1]);
  if (process > 0 && ::read(ends[0], &error, sizeof error) != sizeof error) error = 0;
  ::close(ends[0]);
  return process;
}

/// 0 for a process that has just ended.
pid_t parent_of(const fs::path& process) {
  std::ifstream file(process / "stat");
  std::string text;
  std::getline(file, text);
  const std::size_t name_end = text.rfind(')');
  if (name_end == std::string::npos) return 0;
  std::istringstream rest(text.substr(name_end + 1));
  char state = 0;
  pid_t parent = 0;
  rest >> state >> parent;
  return parent;
}

// Before its number is free: what is gone has been noted.
void note_ends() {
  siginfo_t info{};
  while (::waitid(P_ALL, 0, &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid != 0) {
    const bool exited = info.si_code == CLD_EXITED;
    const Guard::Note note{info.si_pid, exited ? info.si_status << 8 : info.si_status};
    static_cast<void>(::send(STDIN_FILENO, &note, sizeof note, MSG_NOSIGNAL));
    ::waitpid(info.si_pid, nullptr, 0);
    info.si_pid = 0;
  }
}

void kill_children() {
  const pid_t self = ::getpid();
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator("/proc", ignored)) {
    const pid_t process = std::atoi(entry.path().filename().c_str());
    if (process > 1 && parent_of(entry.path()) == self) ::kill(process, SIGKILL);
  }
}

// What has lost its parent becomes a child of this process, a subreaper, and its turn comes.
void end_tree() {
  constexpr timespec pause{0, 2'000'000};
  constexpr int most_pauses = 2500;  // some may wait for a disk
  for (int i = 0; i < most_pauses; ++i) {
    pid_t ended = 0;
    while ((ended = ::waitpid(-1, nullptr, WNOHANG)) > 0) continue;
    if (ended < 0) return;
    kill_children();
    ::nanosleep(&pause, nullptr);
  }
}

}  // namespace

Guard::Guard(const Become& become, const std::string& folder) {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0)
    throw std::system_error(errno, std::generic_category(), "no socket");
  {
    const NoSignals none;
    process_ = ::fork();
    if (process_ == 0) watch(become, folder, ends[1]);
  }
  const int error = errno;
  ::close(ends[1]);
  socket_ = ends[0];
  if (process_ > 0) return;
  ::close(socket_);
  throw std::system_error(error, std::generic_category(), "no process");
}

Guard::~Guard() {
  ::close(socket_);
  while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) continue;
}

// It holds no file of the platform's open, so that no reader of a pipe waits for it.
void Guard::watch(const Become& become, const std::string& folder, int theirs) const {
  ::setpgid(0, 0);
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);
  std::signal(SIGCHLD, SIG_DFL);
  Note first{};
  if (become) {
    first.process = start(become, first.status);
    static_cast<void>(::send(theirs, &first, sizeof first, MSG_NOSIGNAL));
  }
  ::dup2(theirs, STDIN_FILENO);
  ::close_range(STDIN_FILENO + 1, ~0u, 0);
  sigset_t child;
  ::sigemptyset(&child);
  ::sigaddset(&child, SIGCHLD);
  pollfd events[2] = {{STDIN_FILENO, POLLIN, 0}, {::signalfd(-1, &child, SFD_NONBLOCK), POLLIN, 0}};
  while (events[0].revents == 0) {
    ::poll(events, 2, -1);
    signalfd_siginfo ignored{};
    while (::read(events[1].fd, &ignored, sizeof ignored) > 0) continue;
    note_ends();
  }
  end_tree();
  std::error_code none;
  if (!folder.empty() && first.status == 0) fs::remove_all(folder, none);
  leave();
}

std::optional<Guard::Note> Guard::next_note(bool waits) {
  Note note{};
  ssize_t count = 0;
  while ((count = ::recv(socket_, &note, sizeof note, waits ? 0 : MSG_DONTWAIT)) < 0 &&
         errno == EINTR)
    continue;
  gone_ = gone_ || count == 0;
  if (count != static_cast<ssize_t>(sizeof note)) return std::nullopt;
  return note;
}

ProcessTree::ProcessTree(const Become& become) : Guard(become, "") {
  const std::optional<Note> first = next_note(true);
  const int error = first ? first->status : ECHILD;
  if (error != 0) throw std::system_error(error, std::generic_category(), "no process");
  first_ = first->process;
}

int ProcessTree::wait() {
  while (const std::optional<Note> note = next_note(true)) {
    if (note->process == first_) return note->status;
  }
  return SIGKILL;  // with its guard
}

// The guard's own child makes it, so there is no moment at which it has no guard.
ScratchLink::ScratchLink(const std::string& target, const std::string& path)
    : Guard(
          [&] {
            if (::symlink(target.c_str(), path.c_str()) != 0) return errno;
            leave();
          },
          path) {
  const std::optional<Note> made = next_note(true);
  const int error = made ? made->status : ECHILD;
  if (error != 0) throw std::system_error(error, std::generic_category(), "no link");
}

// The guard's own child makes it, as a link's.
ScratchFolder::Made::Made(const fs::path& path)
    : Guard(
          [&] {
            if (::mkdir(path.c_str(), S_IRWXU) != 0) return errno;
            leave();
          },
          path) {
  const std::optional<Note> made = next_note(true);
  const int error = made ? made->status : ECHILD;
  if (error != 0) throw std::system_error(error, std::generic_category());
}

namespace {

[[noreturn]] void no_scratch_folder(const std::string& place, const std::error_code& reason) {
  throw vp::HostError("no folder can be made for temporary files in '" + place + "' (" +
                      reason.message() + "): let TMPDIR name one that takes files");
}

fs::path temporary_folder() {
  std::error_code error;
  fs::path folder = fs::temp_directory_path(error);
  const char* const chosen = std::getenv("TMPDIR");
  if (error) no_scratch_folder(chosen ? chosen : "/tmp", error);
  return folder;
}

}  // namespace

ScratchFolder::ScratchFolder(const std::string& name) {
  constexpr int most_tries = 100;  // another folder may have the name
  const fs::path folder = temporary_folder();
  std::random_device random;
  for (int i = 0; !guard_; ++i) {
    const std::uint64_t number = std::uint64_t{random()} << 32 | random();
    std::ostringstream unique;
    unique << "markervp-" << name << "-" << std::hex << number;
    path_ = folder / unique.str();
    try {
      guard_ = std::make_unique<Made>(path_);
    } catch (const std::system_error& error) {
      if (error.code() == std::errc::file_exists && i < most_tries) continue;
      no_scratch_folder(folder.string(), error.code());
    }
  }
}

ScratchFolder::~ScratchFolder() = default;

}  // namespace platform::host
