#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <vector>

namespace platform::host {

/// A file lock that ends with its process.
class FileLock {
 public:
  FileLock() = default;
  ~FileLock();
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;

  /// Locks a byte of a file, which is made if missing. Without `wait`, false if another process has
  /// it. Throws vp::OutputError.
  bool take(const std::string& path, std::uint64_t byte, bool wait);

  /// Ends it, unless another process has the same open file.
  void close();

  /// The open file; -1 if nothing is locked.
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_ = -1;
};

/// Makes the folder (and those above it) if missing and proves that files can be written into it.
/// Throws vp::InputError otherwise; leaves no file behind. Returns whether it made the folder.
bool prepare_output_folder(const std::string& folder);

/// The same for one file that is written after long work; makes its folder.
void prepare_output_file(const std::string& file);

/// A folder that one run or sweep writes into at a time.
///
/// Its file ".markervp" is locked while this lives, and says who has it and what it wrote there. So
/// the next run finds the files of this one, however it ended, and takes them away before it writes
/// its own: the two never mix. No other file in the folder is touched.
class OutputFolder {
 public:
  /// Makes the folder if missing, and locks it. Throws vp::InputError if it cannot be, and names
  /// who has it.
  explicit OutputFolder(const std::string& path);
  /// Leaves things as they were found if nothing was added.
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// The path of a file that is about to be written; `name` has no folder. The first call removes
  /// the files of an earlier run. Throws vp::OutputError.
  std::string add(const std::string& name);

  const std::string& path() const { return path_; }

  /// In a forked process: lets others in, however long it takes to end.
  void leave_to_parent();

 private:
  void rewrite(const std::string& text);
  void append(const std::string& text);

  std::string path_;
  std::string list_;  ///< path of ".markervp"
  bool made_ = false;
  bool changed_ = false;
  FileLock lock_;
  off_t size_ = 0;                    ///< of the list
  std::vector<std::string> earlier_;  ///< names of the files of the run before
};

}  // namespace platform::host
