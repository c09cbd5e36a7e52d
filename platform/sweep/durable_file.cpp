#include <sweep/durable_file.h>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

namespace platform::sweep {

namespace {

constexpr mode_t file_mode = 0666;  // the user's umask narrows it

[[noreturn]] void fail(const std::string& path, int reason) {
  throw StorageError("'" + path + "' cannot be written: " + std::strerror(reason) +
                     "; what was computed before is kept: make room and run the sweep again");
}

/// A descriptor that is closed, and its file removed, unless it is kept.
class Part {
 public:
  explicit Part(const std::string& path)
      : path_(path + ".part-" + std::to_string(::getpid())),
        descriptor_(::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, file_mode)) {}
  ~Part() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!kept_) ::unlink(path_.c_str());
  }
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;

  bool write(std::string_view bytes) const {
    if (descriptor_ < 0) return false;
    while (!bytes.empty()) {
      const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return true;
  }

  bool flush() const { return ::fsync(descriptor_) == 0; }

  /// File systems on a network say here that the disk is full.
  bool close() { return ::close(std::exchange(descriptor_, -1)) == 0; }

  bool rename_to(const std::string& path) {
    kept_ = ::rename(path_.c_str(), path.c_str()) == 0;
    return kept_;
  }

 private:
  std::string path_;
  int descriptor_;
  bool kept_ = false;
};

}  // namespace

void write_durably(const std::string& path, std::string_view bytes) {
  Part part(path);
  if (!part.write(bytes) || !part.flush() || !part.close() || !part.rename_to(path))
    fail(path, errno);
}

void write_whole(const std::string& path, std::string_view bytes) {
  Part part(path);
  if (!part.write(bytes) || !part.close() || !part.rename_to(path)) fail(path, errno);
}

void flush_to_disk(const std::string& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const bool flushed = descriptor >= 0 && ::syncfs(descriptor) == 0;
  const int reason = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (!flushed) fail(folder, reason);
}

bool is_storage_problem(const std::string& message) {
  constexpr int reasons[] = {ENOSPC, EDQUOT, EFBIG, EIO, EROFS, EMFILE, ENFILE};
  return std::any_of(std::begin(reasons), std::end(reasons), [&](int reason) {
    return message.find(std::strerror(reason)) != std::string::npos;
  });
}

}  // namespace platform::sweep
