#pragma once

#include <cstdint>
#include <string>

namespace platform::host {

/// A file lock that ends with its process.
class FileLock {
 public:
  FileLock() = default;
  ~FileLock();
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;

  /// Locks a byte of a file, which is made if missing. Without `wait`, false if somebody else has
  /// it. Throws vp::OutputError.
  bool take(const std::string& path, std::uint64_t byte, bool wait);

  /// Ends it, unless another process has the same open file.
  void close();

  /// The open file; -1 if nothing is locked.
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_ = -1;
};

}  // namespace platform::host
