#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <linux_app/protocol.h>

namespace platform {

/// What `--linux` asks for.
struct LinuxOptions {
  std::string file;                    ///< executable
  std::vector<std::string> arguments;  ///< without its name
};

/// The process of a Linux application, with the shim loaded into it. It does not outlive the
/// object, and neither does what it started.
class LinuxApplication {
 public:
  using Print = std::function<void(const char* text, std::size_t length)>;

  /// Starts nothing. Throws vp::InputError if the file is none that the shim can be loaded into.
  explicit LinuxApplication(const LinuxOptions& options);
  ~LinuxApplication();
  LinuxApplication(const LinuxApplication&) = delete;
  LinuxApplication& operator=(const LinuxApplication&) = delete;

  /// Its file without folder.
  const std::string& name() const { return name_; }

  /// Starts it. `folder` has /dev and /sys as it sees them, `memory` is the DDR. What it prints
  /// goes to `print`, before what it asks for next. Throws std::system_error if the host has no
  /// process.
  void start(const std::string& folder, int memory, Print print);

  /// What it asks for, and the text of that.
  struct Asked {
    linux_app::Request request;
    std::string text;
  };
  /// The next request; none: it has ended, or not yet if 100 ms went by: see ended().
  std::optional<Asked> next();
  /// It has ended by itself: next() gives no more.
  bool ended() const { return status_.has_value(); }
  void answer(const linux_app::Reply& reply);
  /// Asks where it is, while it waits for an answer; "" if it does not say.
  std::string place();

  /// Ends it where it is, and says where; "" if it does not.
  std::string end_for_time();

  /// What it said before it died of a signal.
  struct Death {
    int signal;
    std::uint64_t address;
    std::string place;
  };
  /// How it ended: its exit code, or the signal.
  int exit_code() const;
  std::optional<Death> death() const;
  /// It became another program, by exec().
  bool was_replaced() const;

 private:
  void print_output();
  std::optional<Asked> receive();
  void look_for_end();

  LinuxOptions options_;
  std::string name_, path_, shim_;
  Print print_;
  pid_t process_ = 0;
  int socket_ = -1, output_ = -1;
  bool silent_ = false;  ///< the socket is closed at its end
  std::optional<int> status_;
  std::optional<Death> death_;
  std::optional<Asked> failure_;  ///< of another thread, while this one was asked where it is
};

}  // namespace platform
