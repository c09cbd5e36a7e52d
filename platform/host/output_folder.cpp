#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <utility>

#include <host/output_folder.h>
#include <host/process.h>
#include <vp/file.h>
#include <vp/text.h>

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

namespace {

namespace fs = std::filesystem;

constexpr const char* list_name = ".markervp";
constexpr const char* choose_another = "; choose another with --output";

std::string who_am_i() {
  return "process " + std::to_string(::getpid()) + " on " + host_name();
}

std::string content_of(int descriptor) {
  std::string text;
  char buffer[4096];
  for (ssize_t count;
       (count = ::pread(descriptor, buffer, sizeof buffer, static_cast<off_t>(text.size()))) > 0;) {
    text.append(buffer, static_cast<std::size_t>(count));
  }
  return text;
}

/// Who has the folder, as the end of a sentence; empty if it does not say so yet.
std::string owner(const std::string& list) {
  const int descriptor = ::open(list.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return "";
  const std::string who = vp::split(content_of(descriptor), '\n').front();
  ::close(descriptor);
  return who.empty() ? "" : " (" + who + ")";
}

/// Names without folders: nothing outside the folder is ever removed.
std::vector<std::string> names_in(const std::string& lines) {
  std::vector<std::string> names = vp::split(lines, '\n');
  names.erase(names.begin());  // who wrote them
  const auto is_no_name = [](const std::string& name) {
    return name.empty() || name.find('/') != std::string::npos;
  };
  names.erase(std::remove_if(names.begin(), names.end(), is_no_name), names.end());
  return names;
}

/// False: the file was removed by the process that had the lock before.
bool is_still_there(const FileLock& lock, const std::string& path) {
  struct stat locked {
  }, named{};
  return ::fstat(lock.descriptor(), &locked) == 0 && ::stat(path.c_str(), &named) == 0 &&
         locked.st_ino == named.st_ino && locked.st_dev == named.st_dev;
}

/// A link of the user's own stays, and so does anything else that no run made.
void remove_file(const fs::path& file) {
  std::error_code ignored;
  if (fs::symlink_status(file, ignored).type() == fs::file_type::regular) fs::remove(file, ignored);
}

}  // namespace

bool prepare_output_folder(const std::string& folder) {
  std::error_code error;
  const bool made = fs::create_directories(folder, error);
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) {
    const std::string why = error ? error.message() : "a file of that name is in the way";
    throw vp::InputError("output folder '" + folder + "' cannot be made: " + why + choose_another);
  }
  const std::string probe =
      (fs::path(folder) / (".markervp-" + std::to_string(::getpid()))).string();
  const int descriptor = ::open(probe.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0) {
    const int reason = errno;
    const std::string problem =
        "output folder '" + folder + "' is not writable: " + std::strerror(reason);
    if (vp::HostError::is_cause({reason, std::generic_category()}))
      throw vp::HostError(problem + vp::advice_for(reason));
    throw vp::InputError(problem + choose_another);
  }
  ::close(descriptor);
  ::unlink(probe.c_str());
  return made;
}

void prepare_output_file(const std::string& file) {
  const fs::path folder = fs::path(file).parent_path();
  if (!folder.empty()) prepare_output_folder(folder.string());
  const int problem = vp::output_problem(file);
  if (problem != 0) throw vp::OutputError(file, problem);
}

OutputFolder::OutputFolder(const std::string& path)
    : path_(path), list_((fs::path(path) / list_name).string()) {
  made_ = prepare_output_folder(path);
  do {
    if (!lock_.take(list_, 0, false)) {
      throw vp::InputError("another run or sweep writes into '" + path_ + "'" + owner(list_) +
                           ": wait for it, or choose another folder with --output");
    }
  } while (!is_still_there(lock_, list_));
  earlier_ = names_in(content_of(lock_.descriptor()));
  std::string text = who_am_i() + "\n";
  for (const std::string& name : earlier_) text += name + "\n";
  rewrite(text);
}

OutputFolder::~OutputFolder() {
  if (lock_.descriptor() < 0 || changed_ || !earlier_.empty()) return;
  ::unlink(list_.c_str());
  if (made_) ::rmdir(path_.c_str());
}

void OutputFolder::leave_to_parent() {
  lock_.close();
}

std::string OutputFolder::add(const std::string& name) {
  if (!changed_) {
    for (const std::string& earlier : earlier_) remove_file(fs::path(path_) / earlier);
    rewrite(who_am_i() + "\n");
    changed_ = true;
  }
  append(name + "\n");
  return (fs::path(path_) / name).string();
}

void OutputFolder::rewrite(const std::string& text) {
  size_ = 0;
  append(text);
  if (::ftruncate(lock_.descriptor(), size_) != 0) throw vp::OutputError(list_, errno);
}

void OutputFolder::append(const std::string& text) {
  for (std::string_view rest = text; !rest.empty();) {
    const ssize_t count = ::pwrite(lock_.descriptor(), rest.data(), rest.size(), size_);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw vp::OutputError(list_, errno);
    rest.remove_prefix(static_cast<std::size_t>(count));
    size_ += count;
  }
}

}  // namespace platform::host
