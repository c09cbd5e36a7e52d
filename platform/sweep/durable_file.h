#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace platform::sweep {

/// The disk is full, or fails: not the fault of a point. The message is one line.
class StorageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Writes a file so that it is there completely or not at all, also after a power failure: beside
/// it, flushed to the disk, renamed. Throws StorageError and leaves nothing behind.
void write_durably(const std::string& path, std::string_view bytes);

/// As write_durably(), but not flushed: a power failure may leave half of it, or none.
/// flush_to_disk() of its folder ends that.
void write_whole(const std::string& path, std::string_view bytes);

/// Flushes all files of the file system that `folder` is on. Throws StorageError.
void flush_to_disk(const std::string& folder);

/// True if the message is one of a full or failing disk: a run that ends with it says nothing about
/// its point.
bool is_storage_problem(const std::string& message);

}  // namespace platform::sweep
