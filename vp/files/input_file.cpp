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

namespace {

bool has(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

/// What stands behind `mark`, up to a blank or a comma.
std::string word_behind(std::string_view text, std::string_view mark) {
  const std::string_view rest = text.substr(text.find(mark) + mark.size());
  return std::string(rest.substr(0, rest.find_first_of(" ,")));
}

}  // namespace

// The GNU C library puts the file at fault before the colon: the object itself, or a library that
// it needs.
std::string load_problem(const std::string& path, std::string_view said) {
  const std::string file(said.substr(0, said.find(": ")));
  if (has(said, "undefined symbol: "))
    return "nothing defines '" + word_behind(said, "undefined symbol: ") +
           "', which it calls: link what does";
  if (has(said, "cannot open shared object file")) {
    if (file != path) return "it needs the library '" + file + "', which is not found";
    return std::string(said.substr(said.rfind(": ") + 2));
  }
  if (has(said, "version `") && has(said, "not found"))
    return "it was built against a newer '" + file + "': build it on this machine";
  for (const char* sign : {"invalid ELF header", "file too short", "ELF file", "wrong ELF class",
                           "only ET_DYN", "cannot dynamically load"}) {
    if (has(said, sign))
      return (file == path ? "it is" : "it needs '" + file + "', which is") +
             " no shared object for this machine: build it as one";
  }
  return std::string(said);
}

}  // namespace vp
