#include <report/file_output.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include <vp/error.h>

namespace platform::report {

namespace {

constexpr mode_t file_mode = 0666;  // the user's umask narrows it

std::string reason() {
  return std::strerror(errno);
}

}  // namespace

bool prepare_output_folder(const std::string& folder) {
  std::error_code error;
  const bool made = std::filesystem::create_directories(folder, error);
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored)) {
    const std::string why = error ? error.message() : "a file of that name is in the way";
    throw vp::InputError("output folder '" + folder + "' cannot be made: " + why +
                         "; choose another with --output");
  }
  const std::string probe =
      (std::filesystem::path(folder) / (".markervp-" + std::to_string(::getpid()))).string();
  const int descriptor = ::open(probe.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, file_mode);
  if (descriptor < 0) {
    throw vp::InputError("output folder '" + folder + "' is not writable: " + reason() +
                         "; choose another with --output");
  }
  ::close(descriptor);
  ::unlink(probe.c_str());
  return made;
}

AtomicFile::AtomicFile(std::string path)
    : path_(std::move(path)), temporary_(path_ + ".part-" + std::to_string(::getpid())) {
  descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, file_mode);
  if (descriptor_ < 0) fail("cannot be written");
}

AtomicFile::~AtomicFile() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  ::unlink(temporary_.c_str());
}

void AtomicFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail("cannot be written");
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void AtomicFile::commit() {
  const int descriptor = std::exchange(descriptor_, -1);
  const bool closed = ::close(descriptor) == 0;
  if (closed && std::rename(temporary_.c_str(), path_.c_str()) == 0) return;
  const std::string why = reason();
  ::unlink(temporary_.c_str());
  throw vp::InputError("'" + path_ + "' cannot be written: " + why);
}

void AtomicFile::fail(const std::string& what) {
  throw vp::InputError("'" + path_ + "' " + what + ": " + reason());
}

}  // namespace platform::report
