#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>
#include <vp/error.h>
#include <vp/input_file.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

namespace vp {

InputFile::InputFile(const std::filesystem::path& path, std::string what)
    : path_(path), what_(std::move(what)) {
  // Opening a pipe would wait for somebody to write into it.
  descriptor_ = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  if (descriptor_ < 0) fail(std::strerror(errno));
  struct stat facts {};
  std::string problem;
  if (::fstat(descriptor_, &facts) != 0) {
    problem = std::strerror(errno);
  } else if (S_ISDIR(facts.st_mode)) {
    problem = "it is a folder: name a file";
  } else if (!S_ISREG(facts.st_mode) && !S_ISFIFO(facts.st_mode)) {
    problem = "it is a device: name a file";
  }
  if (!problem.empty()) {
    ::close(descriptor_);  // no destructor does it for a constructor that throws
    fail(problem);
  }
  is_regular_ = S_ISREG(facts.st_mode);
  if (is_regular_) size_ = static_cast<std::uint64_t>(facts.st_size);
}

InputFile::~InputFile() {
  ::close(descriptor_);
}

void InputFile::fail(const std::string& reason) const {
  throw InputError("cannot read " + what_ + " '" + path_.string() + "': " + reason);
}

void InputFile::wait_for_bytes(HostClock::time_point deadline) const {
  using std::chrono::milliseconds;
  const auto left = std::chrono::ceil<milliseconds>(deadline - HostClock::now());
  pollfd end{descriptor_, POLLIN, 0};
  const int ready = ::poll(&end, 1, static_cast<int>(std::max(left, milliseconds(0)).count()));
  if (ready < 0 && errno != EINTR) fail(std::strerror(errno));
  if (ready == 0) {
    fail("it is a pipe, and its end did not come within " + std::to_string(patience.count()) +
         " s: name a file");
  }
}

std::size_t InputFile::read(char* to, std::size_t size, HostClock::time_point deadline) {
  for (;;) {
    if (!is_regular_) wait_for_bytes(deadline);
    const ::ssize_t count = ::read(descriptor_, to, size);
    if (count >= 0) return static_cast<std::size_t>(count);
    // A few regular files of /proc have nothing to read yet, too.
    if (errno == EAGAIN && is_regular_) wait_for_bytes(deadline);
    if (errno != EINTR && errno != EAGAIN) fail(std::strerror(errno));
  }
}

std::string read_text(const std::filesystem::path& path, const std::string& what,
                      std::uint64_t most) {
  constexpr std::uint64_t largest_of_a_pipe = 1 << 26;
  constexpr std::size_t block = 1 << 16;
  InputFile file(path, what);
  const auto deadline = InputFile::HostClock::now() + InputFile::patience;
  if (!file.is_regular()) most = std::min(most, largest_of_a_pipe);
  std::string text;
  const auto check = [&](std::uint64_t size) {
    if (size <= most) return;
    throw InputError("cannot read " + what + " '" + path.string() + "': it is larger than " +
                     std::to_string(most >> 20) + " MiB, which no file of this kind is");
  };
  check(file.size());
  // Files of /proc and files that grow are larger than they say.
  for (std::size_t size = 0;;) {
    if (text.size() == size)
      text.resize(std::max(size + block, static_cast<std::size_t>(file.size() + 1)));
    const std::size_t count = file.read(text.data() + size, text.size() - size, deadline);
    size += count;
    check(size);
    if (count > 0) continue;
    text.resize(size);
    return text;
  }
}

}  // namespace vp
