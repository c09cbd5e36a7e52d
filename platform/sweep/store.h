#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <host/output_folder.h>
#include <sweep/manifest.h>
#include <sweep/point.h>

namespace platform::sweep {

/// The folder of a sweep:
///
///   manifest.json  the points of the last sweep in it; points.csv the same as a table
///   points/        KEY.json of every point that was ever computed in it
///   runs/          who computed what when: lines of JSON, one file a process
///   sweep.csv, sweep.sqlite  results of the last sweep
class Store {
 public:
  /// Makes the folder if missing. Throws vp::InputError if that cannot be.
  explicit Store(const std::string& folder);

  /// Keeps other sweeps out of the folder until this ends. Throws vp::InputError that names who has
  /// it.
  void lock();

  /// In a forked process: keeps nobody out any more, however long it takes to end.
  void leave_lock_to_parent() const;

  const std::string& folder() const { return folder_; }
  std::string path(const std::string& name) const;
  std::string point_path(const std::string& key) const;

  bool has(const std::string& key) const;
  /// Whole or not at all, unless the power fails before flush(). Throws vp::OutputError.
  void write(const PointRecord& record) const;
  /// Flushes to the disk all points that were written. Throws vp::OutputError.
  void flush() const;
  /// Whether the point's file begins as one that this version of the program wrote; false if it
  /// cannot be read. A glance: a folder may have a million points.
  bool looks_like_one_of(const Json& program, const std::string& key) const;
  /// Throws vp::InputError for a damaged one, or one of another name.
  PointRecord read(const std::string& key, bool verify = true) const;

  void write_manifest(const Manifest& manifest) const;
  Manifest read_manifest() const;

  /// Keys of all points in the folder, sorted. Names what stands there and is no point.
  std::vector<std::string> keys(std::vector<std::string>& foreign) const;

  /// So that one point is computed by one process at a time, whoever works here. Waits.
  host::FileLock claim(const std::string& key) const;

 private:
  std::string folder_;
  std::unique_ptr<host::OutputFolder> lock_;  ///< of the process that took it
};

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
