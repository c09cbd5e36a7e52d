#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <tuple>
#include <utility>

#include <host/document.h>
#include <host/process.h>
#include <sweep/identity.h>
#include <sweep/report.h>
#include <sweep/store.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>

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

namespace {

std::string node_name() {
  // Several Slurm nodes may be one machine.
  const char* const node = std::getenv("SLURMD_NODENAME");
  return node != nullptr ? node : host::host_name();
}

std::optional<double> seconds(const Json& entry, const char* name) {
  if (!entry.contains(name)) return std::nullopt;
  return entry.at(name).get<double>();
}

/// None for a line that is damaged: a process may have been killed while it wrote.
std::optional<RunEntry> entry_of(const std::string& line) {
  try {
    const Json json = host::parse_json<Json>(line, "");
    if (!json.is_object() || !json.contains("key")) return std::nullopt;
    return RunEntry{json.value("key", ""),    seconds(json, "wall_s"),  seconds(json, "cpu_s"),
                    json.value("attempt", 1), json.value("engine", ""), json.value("host", ""),
                    json.value("date", "")};
  } catch (const vp::InputError&) {
  } catch (const Json::exception&) {
  }
  return std::nullopt;
}

}  // namespace

RunLog::RunLog(const Store& store, const std::string& engine)
    : engine_(engine), host_(node_name()) {
  path_ = store.path("runs/" + host_ + "-" + std::to_string(::getpid()) + ".jsonl");
}

RunLog::~RunLog() {
  if (file_ >= 0) ::close(file_);
}

void RunLog::add(const std::string& key, double wall_s, double cpu_s, int attempt) {
  Json json;
  json["key"] = key;
  json["engine"] = engine_;
  json["host"] = host_;
  json["date"] = host::utc_now();
  json["attempt"] = attempt;
  json["wall_s"] = std::stod(vp::format_fixed(wall_s, 4));
  json["cpu_s"] = std::stod(vp::format_fixed(cpu_s, 4));
  append(json);
}

void RunLog::add_untold(const std::string& key) {
  append(Json{{"key", key}});
}

void RunLog::append(const Json& entry) {
  const std::string line = entry.dump() + "\n";
  if (file_ < 0) file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (file_ < 0 || ::write(file_, line.data(), line.size()) != static_cast<ssize_t>(line.size()))
    throw vp::OutputError(path_, errno);
}

std::vector<RunEntry> read_runs(const Store& store) {
  std::vector<RunEntry> entries;
  std::error_code ignored;
  for (const auto& file : std::filesystem::directory_iterator(store.path("runs"), ignored)) {
    std::istringstream lines(vp::read_text(file.path(), "log of runs", host::largest_result));
    for (std::string line; std::getline(lines, line);) {
      if (const auto entry = entry_of(line)) entries.push_back(*entry);
    }
  }
  std::sort(entries.begin(), entries.end(), [](const RunEntry& a, const RunEntry& b) {
    return std::tie(a.date, a.key, a.host) < std::tie(b.date, b.key, b.host);
  });
  return entries;
}

std::vector<RunEntry> complete_runs(const Store& store, const Manifest& manifest) {
  std::vector<RunEntry> entries = read_runs(store);
  std::set<std::string> told;
  for (const RunEntry& entry : entries) told.insert(entry.key);
  RunLog log(store);
  bool complete = true;
  for (const PlannedPoint& point : manifest.points) {
    if (told.count(point.key) != 0 || !store.has(point.key)) continue;
    log.add_untold(point.key);
    complete = false;
  }
  return complete ? entries : read_runs(store);
}

}  // namespace platform::sweep
