#include <sweep/store.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <utility>

#include <host/document.h>
#include <sweep/content_hash.h>
#include <sweep/csv_line.h>
#include <vp/error.h>
#include <vp/output_file.h>

namespace platform::sweep {

namespace {

namespace fs = std::filesystem;

constexpr const char* manifest_name = "manifest.json";
constexpr const char* claims_name = "claims";

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

Store::Store(const std::string& folder) : folder_(folder) {
  host::prepare_output_folder(folder);
  for (const char* name : {"points", "runs"}) host::prepare_output_folder(path(name));
}

void Store::lock() {
  lock_ = std::make_unique<host::OutputFolder>(folder_);
}

void Store::leave_lock_to_parent() const {
  if (lock_) lock_->leave_to_parent();
}

void Store::flush() const {
  const std::string folder = path("points");
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const bool flushed = descriptor >= 0 && ::syncfs(descriptor) == 0;
  const int reason = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (!flushed) throw vp::OutputError(folder, reason);
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
  vp::write_file(point_path(record.key), point_text(record));
}

PointRecord Store::read(const std::string& key, bool verify) const {
  PointRecord record = read_point(point_path(key), verify);
  if (record.key != key)
    throw vp::InputError("'" + point_path(key) + "' is the point " + record.key +
                         " under another name: remove it, and the sweep computes it again");
  return record;
}

void Store::write_manifest(const Manifest& manifest) const {
  vp::write_file_durably(path(manifest_name), to_json(manifest).dump(1) + "\n");
  vp::write_file_durably(path("points.csv"), points_csv(manifest));
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

host::FileLock Store::claim(const std::string& key) const {
  host::FileLock lock;
  // Two points that share these digits would only wait for each other.
  lock.take(path(claims_name), std::stoull(key.substr(0, 15), nullptr, 16), true);
  return lock;
}

}  // namespace platform::sweep
