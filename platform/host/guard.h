#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include <sys/types.h>

namespace platform::host {

/// A process, forked from this one, that waits for this one to end: then, or when this object does,
/// it ends what it started and removes its folder. So nothing is left, even of a killed run.
class Guard {
 public:
  /// Becomes a command by exec(), in a process group of its own, where no signal is blocked or
  /// ignored. Returns errno if that fails.
  using Become = std::function<int()>;

  /// Starts a command if there is one; `folder` may be empty, and stays if the command does not
  /// start. Throws std::system_error if the host has no process left, or for what `become` returns.
  Guard(const Become& become, const std::string& folder);
  ~Guard();
  Guard(const Guard&) = delete;
  Guard& operator=(const Guard&) = delete;

  /// The end of a process of the command's, its status as waitpid() tells it.
  struct Note {
    pid_t process;
    int status;
  };

 protected:
  /// The next one; none: there is none yet, or, when it `waits`, the guard is gone.
  std::optional<Note> next_note(bool waits);
  /// The guard was ended from outside, as next_note() has seen.
  bool gone() const { return gone_; }
  /// The process that waits: the ancestor of all that the command starts.
  pid_t process() const { return process_; }

 private:
  [[noreturn]] void watch(const Become& become, const std::string& folder, int theirs) const;

  pid_t process_ = 0;
  int socket_ = -1;
  bool gone_ = false;
};

/// A command of the host and all that it starts, sessions of their own included. Nothing of it
/// outlives this object or this process.
class ProcessTree : private Guard {
 public:
  explicit ProcessTree(const Become& become);

  using Guard::Become;
  using End = Guard::Note;

  /// The command's own process.
  pid_t first() const { return first_; }
  /// The ancestor of all of them, which only waits.
  pid_t root() const { return process(); }
  /// A process that ended whose parent did not wait for it: first(), and those whose parent ended
  /// before. It is noted before its number is free. None: none has ended since the last call.
  std::optional<End> next_end() { return next_note(false); }
  /// root() was ended from outside, as next_end() has seen: no more ends are noted, and what the
  /// command started has no guard.
  bool lost() const { return gone(); }
  /// The status of first(), after its end.
  int wait();

 private:
  pid_t first_ = 0;
};

/// A symbolic link that outlives neither this object nor this process.
class ScratchLink : private Guard {
 public:
  /// Throws std::system_error; std::errc::file_exists if `path` is taken, which then stays.
  ScratchLink(const std::string& target, const std::string& path);
};

/// A new folder for temporary files, in $TMPDIR. It outlives neither this object nor this process.
class ScratchFolder {
 public:
  /// "markervp-NAME-" and a number. Throws vp::HostError, which names the place, if none can be
  /// made.
  explicit ScratchFolder(const std::string& name);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  /// Made where it has a guard at any moment. Throws std::system_error.
  class Made : private Guard {
   public:
    explicit Made(const std::filesystem::path& path);
  };

  std::filesystem::path path_;
  std::unique_ptr<Made> guard_;
};

}  // namespace platform::host
