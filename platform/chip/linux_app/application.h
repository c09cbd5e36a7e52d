#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <chip/linux_app/protocol.h>
#include <host/guard.h>

namespace platform {

/// What `--linux` asks for.
struct LinuxOptions {
  std::string file;                    ///< executable
  std::vector<std::string> arguments;  ///< without its name
};

/// The process of a Linux application, with the shim loaded into it, and its copies by fork(). None
/// outlives the object, and neither does what they started.
class LinuxApplication {
 public:
  using Print = std::function<void(const char* text, std::size_t length)>;

  /// Starts nothing. Throws vp::InputError if the shim could not be loaded into the file, or the
  /// host allows too few descriptors.
  explicit LinuxApplication(const LinuxOptions& options);
  ~LinuxApplication();
  LinuxApplication(const LinuxApplication&) = delete;
  LinuxApplication& operator=(const LinuxApplication&) = delete;

  /// Its file without folder.
  const std::string& name() const { return name_; }
  /// Its file, absolute and without links.
  const std::string& path() const { return path_; }

  /// Starts it. `folder` has /dev and /sys as it sees them, `memory` is the DDR. What it prints
  /// goes to `print`, before what it asks for next. Throws vp::InputError if the host has no
  /// process.
  void start(const std::string& folder, int memory, Print print);

  /// What it asks for, and the text of that.
  struct Asked {
    linux_app::Request request;
    std::string text;
  };
  /// The next request; none: it has ended, or not yet if 100 ms went by: see ended().
  std::optional<Asked> next();
  /// It has ended by itself, with its copies: next() gives no more.
  bool ended() const { return status_.has_value(); }
  /// The process that was started has ended, and a copy of it runs.
  bool left_copy() const { return !ended() && ends_.count(process_) != 0; }
  void answer(const linux_app::Reply& reply);
  /// It does not run, and continues when it gets SIGCONT.
  bool is_stopped() const;
  /// Asks where it is, while it waits for an answer; "" if it does not say.
  std::string place();

  /// Ends it where it is, and says where; "" if it does not.
  std::string end_for_time();

  /// What it said before it died of a signal.
  struct Death {
    int signal;
    std::uint64_t address;  ///< linux_app::no_address: not known
    std::string reason;     ///< may be empty
    std::string place;
  };
  /// How it ended: its exit code, or the signal.
  int exit_code() const;
  std::optional<Death> death() const;
  /// It reaches the platform no more, and runs on; the program that it became by exec(). None: it
  /// is connected, or about to end.
  std::optional<std::string> replacement() const;

 private:
  void print_output();
  std::optional<Asked> receive();
  void look_for_end();
  void note_death(const Asked& asked);
  void note_loss();

  LinuxOptions options_;
  std::string name_, path_, shim_;
  Print print_;
  std::optional<host::ProcessTree> tree_;
  pid_t process_ = 0;  ///< that was started
  pid_t user_ = 0;     ///< that asked last: it, or a copy by fork()
  int socket_ = -1, output_ = -1;
  bool silent_ = false;  ///< the socket is closed at its end
  std::map<pid_t, int> ends_;
  std::optional<int> status_;
  std::map<pid_t, Death> deaths_;
  pid_t ended_ = 0;  ///< whose status it is
  /// Of another thread, while this one was asked where it is; or the guard is lost.
  std::optional<Asked> failure_;
};

}  // namespace platform
