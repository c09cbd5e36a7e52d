#include "process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <stdexcept>

namespace bench {

namespace {

double milliseconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_usec) / 1e3;
}

/// The last line of a file that is not empty.
std::string last_line(const std::string& path) {
  std::ifstream file(path);
  std::string last;
  for (std::string line; std::getline(file, line);) {
    if (!line.empty()) last = line;
  }
  return last;
}

pid_t start(const Command& command, const std::string& folder) {
  std::vector<char*> arguments;
  for (const std::string& argument : command) {
    arguments.push_back(const_cast<char*>(argument.c_str()));
  }
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  const auto open = [&](int descriptor, const std::string& file, int flags) {
    posix_spawn_file_actions_addopen(&actions, descriptor, file.c_str(), flags, 0600);
  };
  open(STDIN_FILENO, "/dev/null", O_RDONLY);
  open(STDOUT_FILENO, folder + "/stdout", O_WRONLY | O_CREAT | O_TRUNC);
  open(STDERR_FILENO, folder + "/stderr", O_WRONLY | O_CREAT | O_TRUNC);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  pid_t process = 0;
  const int error =
      ::posix_spawn(&process, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw std::runtime_error("cannot start " + command[0]);
  return process;
}

}  // namespace

ProcessResult run_process(const Command& command, const std::string& folder) {
  const pid_t process = start(command, folder);
  int status = 0;
  rusage usage{};
  ::wait4(process, &status, 0, &usage);
  ProcessResult result;
  result.usage.cpu_ms = milliseconds(usage.ru_utime) + milliseconds(usage.ru_stime);
  result.usage.memory_mb = static_cast<double>(usage.ru_maxrss) * 1024 / 1e6;
  result.succeeded = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  if (!result.succeeded) {
    result.message = WIFSIGNALED(status) ? "ended by signal " + std::to_string(WTERMSIG(status))
                                         : last_line(folder + "/stderr");
  }
  return result;
}

}  // namespace bench
