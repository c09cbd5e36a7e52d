#pragma once

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "temporary_files.h"

namespace kit {

/// How a program ended and what it printed.
struct Outcome {
  int exit_code = -1;  ///< -1: a signal ended it
  int signal = 0;      ///< that ended it; 0: it ended by itself
  std::string out;
  std::string err;
};

/// A program that runs in `folder`, its output kept aside. It does not outlive the object.
class ChildProcess {
 public:
  ChildProcess(const std::string& program, const std::vector<std::string>& arguments,
               const std::string& folder) {
    std::vector<char*> argv{const_cast<char*>(program.c_str())};
    for (const std::string& argument : arguments)
      argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    send_to(actions, STDOUT_FILENO, files_ / "out");
    send_to(actions, STDERR_FILENO, files_ / "err");
    posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
    const int error =
        posix_spawn(&process_, program.c_str(), &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) throw std::runtime_error("cannot start " + program);
  }
  ~ChildProcess() {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  pid_t pid() const { return process_; }
  void send(int signal) { ::kill(process_, signal); }
  /// What it printed to its standard output until now.
  std::string out() const { return read_file(files_ / "out"); }
  bool ended() const {
    siginfo_t info{};
    ::waitid(P_PID, static_cast<id_t>(process_), &info, WEXITED | WNOHANG | WNOWAIT);
    return info.si_pid != 0;
  }

  Outcome wait() {
    int status = 0;
    ::waitpid(std::exchange(process_, 0), &status, 0);
    Outcome outcome;
    if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) outcome.signal = WTERMSIG(status);
    outcome.out = read_file(files_ / "out");
    outcome.err = read_file(files_ / "err");
    return outcome;
  }

 private:
  static void send_to(posix_spawn_file_actions_t& actions, int descriptor,
                      const std::string& file) {
    posix_spawn_file_actions_addopen(&actions, descriptor, file.c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0600);
  }

  TemporaryFolder files_;
  pid_t process_ = 0;
};

/// Runs a program to its end.
inline Outcome run_process(const std::string& program, const std::vector<std::string>& arguments,
                           const std::string& folder) {
  return ChildProcess(program, arguments, folder).wait();
}

}  // namespace kit
