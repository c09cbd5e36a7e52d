#pragma once

#include <optional>
#include <string>
#include <vector>

#include <sweep/store.h>

namespace platform::sweep {

/// One computation of a point: what differs between hosts and times, and so stays out of the
/// point's file.
struct RunEntry {
  std::string key;
  // Nothing more is known where the process was killed before it told.
  std::optional<double> wall_s;
  std::optional<double> cpu_s;  ///< of the platform's run itself
  int attempt = 1;
  std::string engine;
  std::string host;
  std::string date;  ///< its end, UTC
};

/// Appends to runs/HOST-PROCESS.jsonl, a line at a time.
class RunLog {
 public:
  /// `engine`: "local", "slurm"; stands in the entries.
  explicit RunLog(const Store& store, const std::string& engine = "");
  ~RunLog();
  RunLog(const RunLog&) = delete;
  RunLog& operator=(const RunLog&) = delete;

  /// Throws vp::OutputError.
  void add(const std::string& key, double wall_s, double cpu_s, int attempt);
  /// A point of which nobody told who computed it. Throws vp::OutputError.
  void add_untold(const std::string& key);

 private:
  void append(const Json& entry);

  std::string path_;
  std::string engine_;
  std::string host_;
  int file_ = -1;  ///< from the first entry on
};

/// All entries of a folder, sorted by date, then key; a line cut short by a crash is left out.
std::vector<RunEntry> read_runs(const Store& store);

/// The same, after an entry was added for every point of the manifest that stands in the folder
/// without one: its process was killed between the two. Throws vp::OutputError.
std::vector<RunEntry> complete_runs(const Store& store, const Manifest& manifest);

}  // namespace platform::sweep
