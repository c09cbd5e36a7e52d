#pragma once

#include <csignal>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include <sys/types.h>
#include <vp/host_ticks.h>

/// This process: its standard streams, its working folder, and how signals and errors end it; and
/// the processes that it starts: commands of the host, and copies of itself.
namespace platform::host {

/// Exit codes of the program (README).
enum ExitCode {
  done = 0,
  run_failed = 1,  ///< the program said so, or a required job was not done
  wrong_input = 2,
  protocol_broken = 3,
  points_failed = 4,  ///< some points of a sweep did not run
  interrupted = 130,  ///< by Ctrl-C (SIGINT), SIGTERM or SIGHUP
};

/// Prints `message` as one line of the program's on `err`; returns `code`.
int fail(std::ostream& err, const std::string& message, ExitCode code);

/// What `work` returns, or the code of the error that it throws, after one line about it on `err`.
int exit_code_of(const std::function<int()>& work, std::ostream& err);

/// Sets what signals do to this process, once at its start: those that end it remove its part files
/// first; a pipe without reader and a file that grows too large are errors of writing, not signals.
void prepare_signals();

/// Ends the process because of `signal`, after removing its part files: with `interrupted`, or as
/// the system does after SIGQUIT. For signal handlers.
[[noreturn]] void end_by(int signal);

/// While it lives, the first Ctrl-C (SIGINT), SIGTERM or SIGHUP is only noted, so that a run ends
/// after the current frame and keeps its results. The second ends the process at once.
class InterruptGuard : private vp::HostTicks::Listener {
 public:
  /// Of work that ends in bounded time by itself.
  InterruptGuard() : InterruptGuard(std::function<void()>()) {}
  /// The first signal is followed up, too: where the next frame does not come soon, `interrupt` is
  /// called, in the signal handler; what has not ended within a second is ended. A second of the
  /// host's processor, or of waiting: a busy machine loses no results.
  explicit InterruptGuard(std::function<void()> interrupt);
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// A signal was noted since the outermost guard was made.
  static bool noted();

 private:
  static void on_signal(int signal);
  void on_host_tick(std::uint64_t spent_ns, void* context) override;

  std::function<void()> interrupt_;  ///< none: without bound
  std::uint64_t spent_ns_ = 0;       ///< since the signal
  InterruptGuard* outer_;
  struct sigaction old_interrupt_;
  struct sigaction old_terminate_;
  struct sigaction old_hang_up_;
};

/// Makes sure that descriptors 0 to 2 are taken: otherwise the first file that is opened becomes
/// the standard output of a program that was started without one. Writing to them fails.
void fill_standard_descriptors();

/// True if `descriptor` is an open socket of this process.
bool is_socket(int descriptor);

/// Throws vp::OutputError if what went to `out` could not all be written. Call it right after
/// writing: errno says why.
void check_written(std::ostream& out);

/// The same for all that this process wrote to its standard output, also with printf(), and for
/// what the system tells only when the descriptor is closed.
void check_standard_output();

/// The working folder as it is now. A program that changes it with chdir() does so for itself only:
/// inputs and results are found where the user said.
class WorkingFolder {
 public:
  WorkingFolder();
  ~WorkingFolder();
  WorkingFolder(const WorkingFolder&) = delete;
  WorkingFolder& operator=(const WorkingFolder&) = delete;

  /// Goes back to it. Nothing if it could not be opened.
  void restore() const;

 private:
  int descriptor_;
};

}  // namespace platform::host

/// The machine that the program runs on, and where the program is installed on it.
namespace platform::host {

/// Its name; "unknown" if it has none.
std::string host_name();

/// Processors that this process may use: at least 1.
unsigned usable_cores();

/// Its time as results are dated: "2024-05-01T12:34:56Z".
std::string utc_now();

/// Where the program's plug-ins and data are: `lib/markervp` beside the folder of the running
/// executable, in the build tree as where it is installed; the system's library folder name
/// (`lib/x86_64-linux-gnu`) is tried too.
std::vector<std::string> library_folders();

/// The function `entry` of the plug-in `file`, from the first of `folders` that has it; it stays
/// loaded. Throws vp::InputError "PROBLEM: why" if it is missing, no plug-in, or of another
/// version, which has another entry.
void* load_plugin(const std::vector<std::string>& folders, const std::string& file,
                  const std::string& entry, const std::string& problem);

constexpr int no_such_command = 127;

struct CommandEnd {
  int exit_code = -1;  ///< no_such_command if it is not installed; -1: a signal ended it
  std::string out;     ///< what it printed, errors too
};

/// Runs a command of the host and waits for it. Ctrl-C does not reach it; it and what it started
/// end with this process. `temporary` is a folder for its own temporary files ($TMPDIR), if not
/// empty. Throws std::system_error if the host has no process left.
CommandEnd run_command(const std::vector<std::string>& arguments,
                       const std::string& temporary = {});

/// Throws vp::HostError if a command could not open so many files: what it says of that itself is
/// of little help.
void require_descriptors(int count, const std::string& command);

/// A word for the shell, in quotes.
std::string shell_quoted(const std::string& text);

/// How work in a process of its own ended.
struct ChildEnd {
  int exit_code = -1;  ///< -1: a signal ended it
  int signal = 0;      ///< that ended it; 0: it ended by itself
  std::string out;     ///< what it printed
  std::string err;
};

/// Work in a forked process, so that a PS program that crashes ends nothing else. The child
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
