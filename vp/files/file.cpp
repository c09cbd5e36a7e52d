#include <fcntl.h>

#include <poll.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#include <vp/error.h>
#include <vp/file.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <system_error>
#include <utility>

namespace vp {

InputFile::InputFile(const std::filesystem::path& path, std::string what)
    : path_(path), what_(std::move(what)) {
  // A blocking open of a pipe would wait for a writer.
  descriptor_ = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  if (descriptor_ < 0) fail(errno);
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

void InputFile::fail(int reason) const {
  if (!HostError::is_cause({reason, std::generic_category()})) fail(std::strerror(reason));
  throw HostError("cannot read " + what_ + " '" + path_.string() + "': " + std::strerror(reason) +
                  advice_for(reason));
}

void InputFile::wait_for_bytes(HostClock::time_point deadline) const {
  using std::chrono::milliseconds;
  const auto left = std::chrono::ceil<milliseconds>(deadline - HostClock::now());
  pollfd end{descriptor_, POLLIN, 0};
  const int ready = ::poll(&end, 1, static_cast<int>(std::max(left, milliseconds(0)).count()));
  if (ready < 0 && errno != EINTR) fail(errno);
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
    if (errno != EINTR && errno != EAGAIN) fail(errno);
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

/// The text after `mark`, up to a space or a comma.
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
    const int probe = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
    if (probe < 0) {
      throw HostError("cannot load '" + path + "': " + std::strerror(errno) + advice_for(errno));
    }
    ::close(probe);
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

namespace {

namespace fs = std::filesystem;

constexpr mode_t file_mode = 0666;  // the user's umask narrows it
constexpr std::size_t write_buffer_size = 1 << 16;
/// Leaves room in a name of 255 bytes for what makes it that of a part file.
constexpr std::size_t most_of_name = 200;

/// A path as a signal handler can read it.
struct Slot {
  std::atomic<bool> taken{false};
  std::atomic<pid_t> owner{0};  ///< 0: `path` is not to be removed
  char path[PATH_MAX];
};
static_assert(std::atomic<pid_t>::is_always_lock_free);
Slot slots[16];

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// Where bytes for a path have to go.
struct Place {
  fs::path target;               ///< with links followed
  bool in_place = false;         ///< a device or a pipe: written in place, not replaced
  int descriptor = -1;           ///< the open descriptor of this process that the path names
  std::optional<unsigned> mode;  ///< of the existing regular file
  int problem = 0;               ///< errno
};

/// The number of a descriptor if `link` is one of this process (/dev/stdout leads there).
int own_descriptor(const fs::path& link) {
  std::error_code error;
  const fs::path folder = fs::canonical(folder_of(link), error);
  if (error || folder != "/proc/" + std::to_string(::getpid()) + "/fd") return -1;
  return std::atoi(link.filename().c_str());
}

// stat() has told before that the chain of links ends.
void follow_links(Place& place) {
  std::error_code error;
  while (fs::is_symlink(fs::symlink_status(place.target, error))) {
    place.descriptor = own_descriptor(place.target);
    if (place.descriptor >= 0) return;
    place.target = folder_of(place.target) / fs::read_symlink(place.target, error);
  }
}

Place place_of(const std::string& path) {
  Place place;
  place.target = path;
  struct stat facts {};
  const bool exists = ::stat(path.c_str(), &facts) == 0;
  if (path.empty() || (!exists && errno != ENOENT)) {
    place.problem = path.empty() ? ENOENT : errno;
  } else if (exists && S_ISDIR(facts.st_mode)) {
    place.problem = EISDIR;
  } else {
    follow_links(place);
    place.in_place = place.descriptor >= 0 || (exists && !S_ISREG(facts.st_mode));
    if (exists && !place.in_place) place.mode = facts.st_mode & 07777;
    const auto may_write = [](const fs::path& asked) { return ::access(asked.c_str(), W_OK) == 0; };
    if (place.descriptor >= 0) return place;
    if ((exists && !may_write(place.target)) ||
        (!place.in_place && !may_write(folder_of(place.target)))) {
      place.problem = errno;
    }
  }
  return place;
}

bool has_proc() {
  static const bool has = ::access("/proc/self/fd", F_OK) == 0;
  return has;
}

std::string part_of(const fs::path& target) {
  const std::string name = target.filename().string().substr(0, most_of_name);
  return (folder_of(target) / (name + ".part-" + std::to_string(::getpid()))).string();
}

}  // namespace

std::string advice_for(int reason) {
  switch (reason) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return "; make room, or write less";
    case EMFILE:
      return "; raise ulimit -n";
    case ENFILE:
      return "; end other programs, or raise ulimit -n and fs.file-max";
    case EAGAIN:
      return "; end other programs, or raise ulimit -u and ulimit -n";
    case ENOENT:
    case ENOTDIR:
    case EISDIR:
    case EACCES:
    case EROFS:
    case ENAMETOOLONG:
      return "; name a file in a folder that exists and may be written";
    default:
      return "";
  }
}

bool HostError::is_cause(const std::error_code& code) {
  if (code.category() != std::generic_category() && code.category() != std::system_category())
    return false;
  constexpr int reasons[] = {ENOSPC, EDQUOT, EFBIG, EIO, EROFS, EMFILE, ENFILE, EAGAIN};
  return std::find(std::begin(reasons), std::end(reasons), code.value()) != std::end(reasons);
}

OutputError::OutputError(const std::string& path, int reason)
    : HostError("cannot write '" + path + "': " + std::strerror(reason) + advice_for(reason)) {}

PartFile::PartFile(std::string path) : path_(std::move(path)), slot_(-1) {
  if (path_.size() >= sizeof Slot::path) return;
  for (std::size_t i = 0; i < std::size(slots); ++i) {
    if (slots[i].taken.exchange(true)) continue;
    std::memcpy(slots[i].path, path_.c_str(), path_.size() + 1);
    slots[i].owner = ::getpid();
    slot_ = static_cast<int>(i);
    return;
  }
}

PartFile::~PartFile() {
  ::unlink(path_.c_str());
  if (slot_ < 0) return;
  slots[slot_].owner = 0;
  slots[slot_].taken = false;
}

void remove_part_files() noexcept {
  for (const Slot& slot : slots) {
    if (slot.owner == ::getpid()) ::unlink(slot.path);
  }
}

int output_problem(const std::string& path) {
  return place_of(path).problem;
}

OutputFile::OutputFile(std::string path, By by) : path_(std::move(path)) {
  const Place place = place_of(path_);
  if (place.problem != 0) throw OutputError(path_, place.problem);
  target_ = place.target.string();
  in_place_ = place.in_place;
  mode_ = place.mode;
  if (in_place_ && by == By::name) return;
  if (place.descriptor >= 0) {
    descriptor_ = ::fcntl(place.descriptor, F_DUPFD_CLOEXEC, 0);
  } else if (in_place_) {
    descriptor_ = ::open(target_.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
  } else {
    if (by == By::bytes) open_nameless();
    if (descriptor_ < 0) open_part();
  }
  if (descriptor_ < 0) throw OutputError(path_, errno);
  if (by == By::name) close();
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

// Not every file system can; /proc is needed to name the file in the end.
void OutputFile::open_nameless() {
  if (!has_proc()) return;
  descriptor_ = ::open(folder_of(target_).c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, file_mode);
}

void OutputFile::open_part() {
  part_.emplace(part_of(target_));
  ::unlink(part_->path().c_str());  // of a process of this number that was killed
  descriptor_ = ::open(part_->path().c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, file_mode);
}

void OutputFile::note(bool good) {
  if (!good && error_ == 0) error_ = errno;
}

void OutputFile::write(std::string_view bytes) {
  if (buffer_.size() + bytes.size() > write_buffer_size) flush();
  if (bytes.size() > write_buffer_size) {
    put(bytes);
  } else {
    buffer_ += bytes;
  }
}

void OutputFile::flush() {
  put(buffer_);
  buffer_.clear();
}

void OutputFile::put(std::string_view bytes) {
  written_ += bytes.size();
  while (!bytes.empty() && error_ == 0) {
    const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    note(count >= 0);
    if (count > 0) bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

void OutputFile::overwrite(std::uint64_t offset, std::string_view bytes) {
  flush();
  while (!bytes.empty() && error_ == 0) {
    const ssize_t count =
        ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    note(count >= 0);
    if (count <= 0) continue;
    bytes.remove_prefix(static_cast<std::size_t>(count));
    offset += static_cast<std::uint64_t>(count);
  }
}

void OutputFile::reserve(std::uint64_t bytes) {
  if (in_place_ || bytes <= reserved_) return;
  rlimit limit{};
  if (::getrlimit(RLIMIT_FSIZE, &limit) == 0 && bytes > limit.rlim_cur) {
    throw OutputError(path_, EFBIG);
  }
  int result = 0;
  do {
    result = ::fallocate(descriptor_, FALLOC_FL_KEEP_SIZE, static_cast<off_t>(reserved_),
                         static_cast<off_t>(bytes - reserved_));
  } while (result != 0 && errno == EINTR);
  if (result == 0) reserved_ = bytes;
  const bool no_room = errno == ENOSPC || errno == EDQUOT || errno == EFBIG;
  if (result != 0 && no_room) throw OutputError(path_, errno);
}

void OutputFile::close() {
  note(::close(std::exchange(descriptor_, -1)) == 0);
}

bool OutputFile::flush_to_disk() {
  if (descriptor_ >= 0) return ::fsync(descriptor_) == 0;
  const int descriptor = ::open(part().c_str(), O_RDONLY | O_CLOEXEC);
  const bool flushed = descriptor >= 0 && ::fsync(descriptor) == 0;
  const int reason = errno;
  if (descriptor >= 0) ::close(descriptor);
  errno = reason;
  return flushed;
}

// File systems on a network say only when a file is closed that the disk is full.
void OutputFile::finish(bool durably) {
  flush();
  if (!in_place_ && error_ == 0) {
    if (reserved_ != 0) note(::ftruncate(descriptor_, static_cast<off_t>(written_)) == 0);
    if (durably) note(flush_to_disk());
    if (error_ == 0) take_name();
  }
  if (descriptor_ >= 0) close();
  part_.reset();
  if (error_ != 0) throw OutputError(path_, error_);
}

void OutputFile::take_name() {
  if (!part_) {
    part_.emplace(part_of(target_));
    const std::string self = "/proc/self/fd/" + std::to_string(descriptor_);
    ::unlink(part_->path().c_str());  // of a process of this number that was killed
    note(::linkat(AT_FDCWD, self.c_str(), AT_FDCWD, part_->path().c_str(), AT_SYMLINK_FOLLOW) == 0);
  }
  if (descriptor_ >= 0) close();
  if (error_ != 0) return;
  if (mode_) ::chmod(part_->path().c_str(), *mode_);
  note(::rename(part_->path().c_str(), target_.c_str()) == 0);
}

void write_file(const std::string& path, std::string_view bytes) {
  OutputFile file(path);
  file.write(bytes);
  file.commit();
}

void write_file_durably(const std::string& path, std::string_view bytes) {
  OutputFile file(path);
  file.write(bytes);
  file.commit_durably();
}

}  // namespace vp
