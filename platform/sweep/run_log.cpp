#include <sweep/run_log.h>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <set>
#include <sstream>
#include <tuple>

#include <host/document.h>
#include <report/utc_time.h>
#include <vp/output_file.h>
#include <vp/text.h>

namespace platform::sweep {

namespace {

std::string host_name() {
  // Several Slurm nodes may be one machine.
  if (const char* node = std::getenv("SLURMD_NODENAME")) return node;
  char name[256] = "unknown";
  ::gethostname(name, sizeof name - 1);
  return name;
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
    : engine_(engine), host_(host_name()) {
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
  json["date"] = report::utc_now();
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
