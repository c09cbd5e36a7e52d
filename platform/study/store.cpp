#include <study/store.h>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>

#include <result/table.h>
#include <study/manifest.h>
#include <study/report.h>
#include <vp/error.h>
#include <vp/file.h>

namespace platform::study {

namespace {

namespace fs = std::filesystem;

constexpr const char* manifest_name = "manifest.json";

void write_points_csv(const std::string& path, const Manifest& manifest) {
  vp::OutputFile file(path);
  std::vector<std::string> fields{"key"};
  fields.insert(fields.end(), manifest.swept.begin(), manifest.swept.end());
  file.write(result::csv_line(fields));
  for (const Point& point : manifest.points) {
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

Store::Store(const std::string& folder) : folder_(folder) {
  host::prepare_output_folder(folder);
  host::prepare_output_folder(path("runs"));
}

void Store::lock() {
  lock_ = std::make_unique<host::OutputFolder>(folder_);
}

void Store::leave_lock_to_parent() const {
  if (lock_) lock_->leave_to_parent();
}

void Store::flush() const {
  const std::string folder = path("runs");
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const bool flushed = descriptor >= 0 && ::syncfs(descriptor) == 0;
  const int reason = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (!flushed) throw vp::OutputError(folder, reason);
}

std::string Store::path(const std::string& name) const {
  return (fs::path(folder_) / name).string();
}

std::string Store::kept_path(const std::string& key) const {
  return path("points/" + key + ".json");
}

void Store::keep(const KeptResult& result) const {
  host::prepare_output_folder(path("points"));
  vp::write_file(kept_path(result.key), kept_text(result));
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

std::vector<std::string> Store::kept_keys(std::vector<std::string>& foreign) const {
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

}  // namespace platform::study
