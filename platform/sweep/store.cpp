#include <sweep/store.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

#include <host/document.h>
#include <report/file_output.h>
#include <sweep/content_hash.h>
#include <sweep/csv_line.h>
#include <sweep/durable_file.h>
#include <vp/error.h>

namespace platform::sweep {

namespace {

namespace fs = std::filesystem;

constexpr const char* manifest_name = "manifest.json";
constexpr const char* lock_name = "lock";
constexpr const char* claims_name = "claims";

std::string who_am_i() {
  char host[256] = "unknown host";
  ::gethostname(host, sizeof host - 1);
  return "process " + std::to_string(::getpid()) + " on " + host;
}

bool is_key(const std::string& text) {
  return text.size() == key_digits &&
         text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

std::string points_csv(const Manifest& manifest) {
  std::vector<std::string> head{"key"};
  head.insert(head.end(), manifest.swept.begin(), manifest.swept.end());
  std::string text = csv_line(head);
  for (const PlannedPoint& point : manifest.points) {
    std::vector<std::string> fields{point.key};
    for (const std::string& path : manifest.swept) {
      const auto found = std::find_if(point.swept.begin(), point.swept.end(),
                                      [&](const auto& value) { return value.first == path; });
      fields.push_back(found == point.swept.end() ? "" : found->second);
    }
    text += csv_line(fields);
  }
  return text;
}

}  // namespace

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
  descriptor_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw StorageError("'" + path + "' cannot be made: " + std::strerror(errno));
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
  ::close(std::exchange(descriptor_, -1));
  if (reason == EAGAIN || reason == EACCES) return false;
  throw StorageError("'" + path + "' cannot be locked: " + std::strerror(reason));
}

Store::Store(const std::string& folder) : folder_(folder) {
  report::prepare_output_folder(folder);
  for (const char* name : {"points", "runs"}) report::prepare_output_folder(path(name));
}

void Store::lock() {
  const std::string file = path(lock_name);
  if (!lock_.take(file, 0, false)) {
    throw vp::InputError("another sweep works in '" + folder_ + "' (" +
                         vp::read_text(file, "lock") +
                         "): wait for it, or choose another folder with --output");
  }
  write_durably(file + ".owner", who_am_i());
  std::ofstream(file, std::ios::trunc) << who_am_i();
  std::error_code ignored;
  fs::remove(file + ".owner", ignored);
}

std::string Store::path(const std::string& name) const {
  return (fs::path(folder_) / name).string();
}

std::string Store::point_path(const std::string& key) const {
  return (fs::path(folder_) / "points" / (key + ".json")).string();
}

bool Store::has(const std::string& key) const {
  struct stat facts {};
  return ::stat(point_path(key).c_str(), &facts) == 0;
}

void Store::write(const PointRecord& record) const {
  write_whole(point_path(record.key), point_text(record));
}

PointRecord Store::read(const std::string& key, bool verify) const {
  PointRecord record = read_point(point_path(key), verify);
  if (record.key != key)
    throw vp::InputError("'" + point_path(key) + "' is the point " + record.key +
                         " under another name: remove it, and the sweep computes it again");
  return record;
}

void Store::write_manifest(const Manifest& manifest) const {
  write_durably(path(manifest_name), to_json(manifest).dump(1) + "\n");
  write_durably(path("points.csv"), points_csv(manifest));
}

Manifest Store::read_manifest() const {
  const std::string file = path(manifest_name);
  std::error_code ignored;
  if (!fs::exists(file, ignored))
    throw vp::InputError("'" + folder_ + "' is no folder of a sweep: it has no " + manifest_name);
  return manifest_from(host::read_json<Json>(file, "manifest", host::largest_result), file);
}

std::vector<std::string> Store::keys(std::vector<std::string>& foreign) const {
  std::vector<std::string> keys;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(path("points"), error)) {
    const std::string name = entry.path().filename().string();
    const std::string stem = entry.path().stem().string();
    if (entry.path().extension() == ".json" && is_key(stem)) {
      keys.push_back(stem);
    } else if (name.find(".part-") == std::string::npos) {
      foreign.push_back(name);
    }
  }
  std::sort(keys.begin(), keys.end());
  std::sort(foreign.begin(), foreign.end());
  return keys;
}

FileLock Store::claim(const std::string& key) const {
  FileLock lock;
  // Two points that share these digits would only wait for each other.
  lock.take(path(claims_name), std::stoull(key.substr(0, 15), nullptr, 16), true);
  return lock;
}

}  // namespace platform::sweep
