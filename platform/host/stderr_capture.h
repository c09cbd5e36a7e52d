#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <string>

namespace platform::host {

/// Libraries write what they think to stderr. While this lives, that goes into memory instead, to
/// be judged. All in the header, for plug-ins.
class StderrCapture {
 public:
  StderrCapture() : saved_(::dup(STDERR_FILENO)), memory_(::memfd_create("stderr", MFD_CLOEXEC)) {
    if (saved_ >= 0 && memory_ >= 0) ::dup2(memory_, STDERR_FILENO);
  }
  ~StderrCapture() {
    if (saved_ >= 0) ::dup2(saved_, STDERR_FILENO);
    ::close(saved_);
    ::close(memory_);
  }
  StderrCapture(const StderrCapture&) = delete;
  StderrCapture& operator=(const StderrCapture&) = delete;

  std::string text() const {
    std::string text(1 << 12, '\0');
    const ssize_t size = ::pread(memory_, text.data(), text.size(), 0);
    text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
    return text;
  }

 private:
  int saved_;
  int memory_;
};

}  // namespace platform::host
