#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <sweep/store.h>

namespace platform::sweep {

/// Folders for runs that are under way, one for each that runs at the same time, gone with this. In
/// memory, so that a run does not wait for the disk, nor fails because it is full. Those of a
/// process that was killed stay until the next one is made.
class Scratch {
 public:
  /// In `parent`, by default the host's folder in memory. Throws StorageError.
  explicit Scratch(std::uint32_t slots, const std::string& parent = default_parent());
  ~Scratch();
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  /// A folder that may not exist yet. Only as many at a time as there are slots.
  std::string take();
  void give_back(const std::string& folder) { free_.push_back(folder); }

  static std::string default_parent();

 private:
  std::string path_;
  FileLock lock_;  ///< shows others that this is in use
  std::vector<std::string> free_;
};

}  // namespace platform::sweep
