#pragma once

#include <vp/error.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace vp {

/// Something could not be written: the disk is full, a pipe lost its reader, a folder is missing.
class OutputError : public InputError {
 public:
  using InputError::InputError;
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
