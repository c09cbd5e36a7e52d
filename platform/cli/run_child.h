#pragma once

#include <sys/types.h>

#include <functional>
#include <iosfwd>
#include <string>

namespace platform::cli {

/// How work in a process of its own ended.
struct ChildEnd {
  int exit_code = -1;  ///< -1: a signal ended it
  int signal = 0;      ///< that ended it; 0: it ended by itself
  std::string out;     ///< what it printed
  std::string err;
};

/// Work in a forked process, so that a PS program that crashes takes nobody with it. The child
/// begins as a copy of the caller, which must have no other threads; what it is to return, it
/// writes to a file. It ends with its parent, and with this object.
class RunChild {
 public:
  /// Returns the exit code; an exception becomes the one that the command line gives it, its
  /// message goes to `err`.
  using Work = std::function<int(std::ostream& out, std::ostream& err)>;

  /// Starts it. Throws std::system_error if the host has no process left.
  explicit RunChild(const Work& work);
  ~RunChild();
  RunChild(RunChild&& other) noexcept;
  RunChild& operator=(RunChild&&) = delete;

  pid_t pid() const { return process_; }

  /// Whether it has ended. Does not wait.
  bool ended() const;

  /// Waits for its end, once.
  ChildEnd wait();

 private:
  [[noreturn]] void become(const Work& work, pid_t parent);

  pid_t process_ = 0;
  int out_ = -1;  ///< files without a name
  int err_ = -1;
};

}  // namespace platform::cli
