#pragma once

#include <sys/types.h>

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

/// The processes that this one starts: commands of the host, and copies of itself.
namespace platform::host {

constexpr int no_such_command = 127;

struct CommandEnd {
  int exit_code = -1;  ///< no_such_command if it is not installed; -1: a signal ended it
  std::string out;     ///< what it printed, errors too
};

/// Runs a command of the host and waits for it. Ctrl-C does not reach it. Throws
/// std::system_error if the host has no process left.
CommandEnd run_command(const std::vector<std::string>& arguments);

/// A word for the shell, in quotes.
std::string shell_quoted(const std::string& text);

/// Runs gnuplot on `script`, which sets its terminal; the plot goes into `file`, whole or not at
/// all. Returns how it ended: 127 if it is not installed. Throws vp::OutputError if nothing can be
/// written there.
CommandEnd draw_with_gnuplot(const std::string& file, const std::string& script);

/// Text in single quotes for gnuplot.
std::string gnuplot_quoted(const std::string& text);

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
class Child {
 public:
  /// Returns the exit code; an exception becomes exit_code_of() it.
  using Work = std::function<int(std::ostream& out, std::ostream& err)>;

  /// Starts it. Throws std::system_error if the host has no process left.
  explicit Child(const Work& work);
  ~Child();
  Child(Child&& other) noexcept;
  Child& operator=(Child&&) = delete;

  pid_t pid() const { return process_; }

  /// Whether it has ended. Does not wait.
  bool ended() const;

  /// Waits for its end, once.
  ChildEnd wait();

 private:
  void end();
  [[noreturn]] void become(const Work& work, pid_t parent);

  pid_t process_ = 0;
  int out_ = -1;  ///< files without a name
  int err_ = -1;
};

}  // namespace platform::host
