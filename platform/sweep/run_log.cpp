#include <sweep/run_log.h>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <tuple>

#include <sweep/durable_file.h>
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

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  ::gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

}  // namespace

RunLog::RunLog(const Store& store, const std::string& engine)
    : engine_(engine), host_(host_name()) {
  path_ = store.path("runs/" + host_ + "-" + std::to_string(::getpid()) + ".jsonl");
}

void RunLog::add(const std::string& key, double wall_s, double cpu_s, int attempt) {
  Json json;
  json["key"] = key;
  json["engine"] = engine_;
  json["host"] = host_;
  json["date"] = utc_now();
  json["attempt"] = attempt;
  json["wall_s"] = std::stod(vp::format_fixed(wall_s, 4));
  json["cpu_s"] = std::stod(vp::format_fixed(cpu_s, 4));
  const std::string line = json.dump() + "\n";
  const int file = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  const bool written =
      file >= 0 && ::write(file, line.data(), line.size()) == static_cast<ssize_t>(line.size());
  const int reason = errno;
  if (file >= 0) ::close(file);
  if (!written)
    throw StorageError("'" + path_ + "' cannot be written: " + std::strerror(reason) +
                       "; what was computed before is kept: make room and run the sweep again");
}

std::vector<RunEntry> read_runs(const Store& store) {
  std::vector<RunEntry> entries;
  std::error_code ignored;
  for (const auto& file : std::filesystem::directory_iterator(store.path("runs"), ignored)) {
    std::ifstream lines(file.path());
    for (std::string line; std::getline(lines, line);) {
      const Json json = Json::parse(line, nullptr, false);
      if (!json.is_object() || !json.contains("cpu_s")) continue;
      entries.push_back({json.value("key", ""), json.value("wall_s", 0.0), json.value("cpu_s", 0.0),
                         json.value("attempt", 1), json.value("engine", ""), json.value("host", ""),
                         json.value("date", "")});
    }
  }
  std::sort(entries.begin(), entries.end(), [](const RunEntry& a, const RunEntry& b) {
    return std::tie(a.date, a.key, a.host) < std::tie(b.date, b.key, b.host);
  });
  return entries;
}

}  // namespace platform::sweep
