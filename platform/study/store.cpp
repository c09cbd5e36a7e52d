#include <study/store.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>

#include <result/table.h>
#include <study/manifest.h>
#include <study/report.h>
#include <vp/error.h>
#include <vp/file.h>

namespace platform::study {

namespace {

namespace fs = std::filesystem;

constexpr const char* manifest_name = "manifest.json";
constexpr const char* claims_name = "claims";

bool is_key(const std::string& text) {
  return text.size() == key_digits &&
         text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

void write_points_csv(const std::string& path, const Manifest& manifest) {
  vp::OutputFile file(path);
  std::vector<std::string> fields{"key"};
  fields.insert(fields.end(), manifest.swept.begin(), manifest.swept.end());
  file.write(result::csv_line(fields));
  for (const PlannedPoint& point : manifest.points) {
    fields = {point.key};
    for (const std::string& name : manifest.swept) {
      const std::string* value = find(point.swept, name);
      fields.push_back(value == nullptr ? "" : *value);
    }
    file.write(result::csv_line(fields));
  }
  file.commit_durably();
}

}  // namespace

Store::Store(const std::string& folder)
    : folder_(folder), points_((fs::path(folder) / "points" / "").string()) {
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
  return points_ + key + ".json";
}

bool Store::has(const std::string& key) const {
  struct stat facts {};
  return ::stat(point_path(key).c_str(), &facts) == 0;
}

void Store::write(const PointRecord& record) const {
  vp::write_file(point_path(record.key), point_text(record));
}

bool Store::looks_like_one_of(const Json& program, const std::string& key) const {
  std::ifstream file(point_path(key), std::ios::binary);
  const std::string wanted = identity_start(program);
  std::string line;
  for (int i = 0; i < 2; ++i) std::getline(file, line);
  std::string start(wanted.size(), ' ');
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  return file && start == wanted;
}

PointRecord Store::read(const std::string& key, bool verify) const {
  PointRecord record = read_point(point_path(key), verify);
  if (record.key != key)
    throw vp::InputError("'" + point_path(key) + "' is the point " + record.key +
                         " under another name: remove it, and the sweep computes it again");
  return record;
}

void Store::write_manifest(const Manifest& manifest) const {
  study::write_manifest(path(manifest_name), manifest);
  write_points_csv(path("points.csv"), manifest);
}

Manifest Store::read_manifest() const {
  const std::string file = path(manifest_name);
  std::error_code ignored;
  if (!fs::exists(file, ignored))
    throw vp::InputError("'" + folder_ + "' is no folder of a sweep: it has no " + manifest_name);
  return study::read_manifest(file);
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

}  // namespace platform::study
