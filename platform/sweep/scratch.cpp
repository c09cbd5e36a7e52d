#include <sweep/scratch.h>

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include <sweep/durable_file.h>

namespace platform::sweep {

namespace {

namespace fs = std::filesystem;

constexpr const char* prefix = "markervp-sweep-";

std::string lock_of(const fs::path& folder) {
  return (folder / "lock").string();
}

std::string make_folder(const std::string& parent) {
  std::string name = (fs::path(parent) / (std::string(prefix) + "XXXXXX")).string();
  if (::mkdtemp(name.data()) == nullptr)
    throw StorageError("'" + name + "' cannot be made: " + std::strerror(errno));
  return name;
}

/// Removes the folder if nobody uses it.
void remove_if_left(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::exists(lock_of(folder), ignored)) {
    // Only just made, perhaps: goes if it is empty, and whoever made it makes another.
    fs::remove(folder, ignored);
    return;
  }
  try {
    FileLock lock;
    if (lock.take(lock_of(folder), 0, false)) fs::remove_all(folder, ignored);
  } catch (const StorageError&) {
    // Somebody else's.
  }
}

void remove_left(const std::string& parent) {
  std::error_code ignored;
  std::vector<fs::path> folders;
  for (const auto& entry : fs::directory_iterator(parent, ignored)) {
    if (entry.path().filename().string().rfind(prefix, 0) == 0) folders.push_back(entry.path());
  }
  for (const fs::path& folder : folders) remove_if_left(folder);
}

}  // namespace

Scratch::Scratch(std::uint32_t slots, const std::string& parent) {
  remove_left(parent);
  for (bool ours = false; !ours;) {
    path_ = make_folder(parent);
    // Another process may clear the folder away between its making and the lock: then once more.
    std::error_code ignored;
    try {
      ours = lock_.take(lock_of(path_), 0, false) && fs::exists(lock_of(path_), ignored);
    } catch (const StorageError&) {
      if (fs::exists(path_, ignored)) throw;
    }
  }
  for (std::uint32_t slot = 0; slot < slots; ++slot)
    free_.push_back((fs::path(path_) / std::to_string(slot)).string());
}

Scratch::~Scratch() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string Scratch::take() {
  std::string folder = free_.back();
  free_.pop_back();
  return folder;
}

std::string Scratch::default_parent() {
  std::error_code ignored;
  const fs::path memory = "/dev/shm";
  const bool usable =
      fs::is_directory(memory, ignored) && ::access(memory.c_str(), W_OK | X_OK) == 0;
  return (usable ? memory : fs::temp_directory_path()).string();
}

}  // namespace platform::sweep
