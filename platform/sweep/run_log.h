#pragma once

#include <string>
#include <vector>

#include <sweep/store.h>

namespace platform::sweep {

/// One computation of a point: what differs between hosts and times, and so stays out of the
/// point's file.
struct RunEntry {
  std::string key;
  double wall_s = 0;
  double cpu_s = 0;  ///< of the platform's run itself
  int attempt = 1;
  std::string engine;
  std::string host;
  std::string date;  ///< its end, UTC
};

/// Appends to runs/HOST-PROCESS.jsonl.
class RunLog {
 public:
  /// `engine`: "local", "slurm".
  RunLog(const Store& store, const std::string& engine);
  /// Throws StorageError.
  void add(const std::string& key, double wall_s, double cpu_s, int attempt);

 private:
  std::string path_;
  std::string engine_;
  std::string host_;
};

/// All entries of a folder, sorted by date, then key; a line cut short by a crash is left out.
std::vector<RunEntry> read_runs(const Store& store);

}  // namespace platform::sweep
