#include <host/file_lock.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include <vp/output_file.h>

namespace platform::host {

FileLock::~FileLock() {
  close();
}

void FileLock::close() {
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
}

FileLock::FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

FileLock& FileLock::operator=(FileLock&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

// The lock belongs to the open file: a child that inherits it keeps it until it ends, too.
bool FileLock::take(const std::string& path, std::uint64_t byte, bool wait) {
  close();
  descriptor_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw vp::OutputError(path, errno);
  struct flock range {};
  range.l_type = F_WRLCK;
  range.l_whence = SEEK_SET;
  range.l_start = static_cast<off_t>(byte);
  range.l_len = 1;
  int result = 0;
  do {
    result = ::fcntl(descriptor_, wait ? F_OFD_SETLKW : F_OFD_SETLK, &range);
  } while (result != 0 && errno == EINTR);
  if (result == 0) return true;
  const int reason = errno;
  close();
  if (reason == EAGAIN || reason == EACCES) return false;
  throw vp::OutputError("'" + path + "' cannot be locked: " + std::strerror(reason));
}

}  // namespace platform::host
