#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include <vp/error.h>

namespace vp {

/// A file that a user named, open for reading: a regular file or a pipe (`<(…)`, /dev/stdin).
/// Neither opening nor reading blocks for ever, whatever the name refers to.
class InputFile {
 public:
  using HostClock = std::chrono::steady_clock;

  /// How long a pipe may let its reader wait.
  static constexpr std::chrono::seconds patience{10};

  /// `what` says in messages what the file is: "trace". Throws InputError "cannot read trace
  /// 'name': reason" for what cannot be opened, a folder or a device.
  InputFile(const std::filesystem::path& path, std::string what);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// Up to `size` bytes; 0 at the end. Throws InputError if nothing has come until `deadline`.
  std::size_t read(char* to, std::size_t size, HostClock::time_point deadline);

  bool is_regular() const { return is_regular_; }
  /// In bytes, when it was opened; 0 for a pipe.
  std::uint64_t size() const { return size_; }
  /// For the kernel's calls on it.
  int descriptor() const { return descriptor_; }

 private:
  [[noreturn]] void fail(const std::string& reason) const;
  /// The same for an errno. Throws HostError if the machine is the cause.
  [[noreturn]] void fail(int reason) const;
  void wait_for_bytes(HostClock::time_point deadline) const;

  std::filesystem::path path_;
  std::string what_;
  int descriptor_ = -1;
  bool is_regular_ = false;
  std::uint64_t size_ = 0;
};

/// The largest document that a person writes: a configuration, a sweep, checks. 4 MiB.
constexpr std::uint64_t largest_by_hand = 1 << 22;

/// The whole file, of at most `most` bytes. A pipe has `patience` to end. Throws InputError as
/// InputFile does, and for a larger one.
std::string read_text(const std::filesystem::path& path, const std::string& what,
                      std::uint64_t most = largest_by_hand);

/// What to do about `reason`, an errno, as the end of a message: "; raise ulimit -n". Empty where
/// nothing is known.
std::string advice_for(int reason);

/// What to say of a shared object that dlopen() refused; `said` is the text of dlerror(). Continues
/// "cannot load program 'x.so': ". Throws HostError if the machine is the cause.
std::string load_problem(const std::string& path, std::string_view said);

/// Something could not be written: the disk is full, a pipe lost its reader, a folder is missing.
class OutputError : public HostError {
 public:
  using HostError::HostError;
  /// "cannot write 'PATH': REASON; ADVICE" for an errno.
  OutputError(const std::string& path, int reason);
};

/// A file that does not outlive its process: it is removed when this object ends, and by
/// remove_part_files().
class PartFile {
 public:
  explicit PartFile(std::string path);
  ~PartFile();
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
  int slot_;  ///< of the list that a signal handler can read; -1: there are too many
};

/// Removes the part files of this process, not those of a parent. For signal handlers.
void remove_part_files() noexcept;

/// Why nothing could be written to `path` (an errno), or 0. Makes nothing.
int output_problem(const std::string& path);

/// A file that is there whole or not at all.
///
/// The bytes go into a file without a name, and commit() puts it in the place of an earlier file;
/// without commit() nothing changes, however the process ends. The file is called "NAME.part-PID"
/// while it is written if the file system has no nameless files, or if a library has to open it.
///
/// Symbolic links are followed: the file that a link leads to is replaced, and the link stays. What
/// is no regular file (a device, a pipe) is written in place; a pipe waits for its reader.
class OutputFile {
 public:
  enum class By : std::uint8_t {
    bytes,  ///< with write()
    name    ///< a library writes the file part()
  };

  /// Throws OutputError if nothing can be written there.
  explicit OutputFile(std::string path, By by = By::bytes);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Bytes wait in a buffer until they are worth a call of the system. After an error they are
  /// lost, and commit() throws.
  void write(std::string_view bytes);
  bool failed() const { return error_ != 0; }
  /// Replaces bytes that were written before, for headers that say what follows.
  void overwrite(std::uint64_t offset, std::string_view bytes);

  /// The file that a library is to write.
  const std::string& part() const { return part_ ? part_->path() : target_; }

  /// Makes sure that the disk has room for so many bytes in all, where the file system can. Throws
  /// OutputError if it has none; what was written stays good.
  void reserve(std::uint64_t bytes);

  /// Gives the file its name. Throws OutputError, after which nothing is left.
  void commit() { finish(false); }
  /// The same, and a power failure does not undo it.
  void commit_durably() { finish(true); }

 private:
  void open_nameless();
  void open_part();
  void flush();
  void put(std::string_view bytes);
  void finish(bool durably);
  void close();
  bool flush_to_disk();
  void take_name();
  void note(bool good);

  std::string path_;    ///< as the user wrote it
  std::string target_;  ///< with links followed
  bool in_place_ = false;
  std::optional<unsigned> mode_;  ///< access rights of the file that is replaced
  int descriptor_ = -1;
  std::optional<PartFile> part_;
  std::string buffer_;
  std::uint64_t written_ = 0;
  std::uint64_t reserved_ = 0;
  int error_ = 0;  ///< errno of the first failure
};

/// Writes a whole file. Throws OutputError.
void write_file(const std::string& path, std::string_view bytes);
/// The same, and a power failure does not undo it.
void write_file_durably(const std::string& path, std::string_view bytes);

}  // namespace vp
