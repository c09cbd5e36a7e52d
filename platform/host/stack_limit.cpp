#include <host/stack_limit.h>

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>

#include <vp/error.h>

namespace platform::host {

namespace {

/// Runs need 128 KiB; four times as much leaves room for libraries and other machines (decision).
constexpr rlim_t least_bytes = 512 << 10;
/// What Linux gives usually.
constexpr rlim_t usual_bytes = 8 << 20;

}  // namespace

void ensure_stack(char* const arguments[]) {
  rlimit limit{};
  if (::getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= least_bytes) return;
  const std::string problem = "the stack may take " + std::to_string(limit.rlim_cur >> 10) +
                              " KiB (ulimit -s), and " + std::to_string(least_bytes >> 10) +
                              " are needed: raise ulimit -s";
  if (limit.rlim_max < least_bytes) throw vp::HostError(problem);
  limit.rlim_cur = std::min(usual_bytes, limit.rlim_max);
  if (::setrlimit(RLIMIT_STACK, &limit) != 0) throw vp::HostError(problem);
  // Not by its name in /proc, which ps would show.
  std::error_code error;
  const std::string self = std::filesystem::read_symlink("/proc/self/exe", error).string();
  if (!error) ::execv(self.c_str(), arguments);
  throw vp::HostError(problem + " (it cannot be done here: " +
                      (error ? error.message() : std::strerror(errno)) + ")");
}

}  // namespace platform::host
