#pragma once

#include <memory>
#include <string>
#include <vector>

#include <host/output_folder.h>
#include <study/manifest.h>
#include <study/point.h>

namespace platform::study {

/// The folder of a sweep:
///
///   manifest.json  the points of the last sweep in it; points.csv the same as a table
///   points/        KEY.json of every point that was ever computed in it
///   runs/          who computed what when, and what came of it (RunLog), one file a process
///   sweep.csv, sweep.sqlite  results of the last sweep
class Store {
 public:
  /// Makes the folder if missing. Throws vp::InputError if that cannot be.
  explicit Store(const std::string& folder);

  /// Keeps other sweeps out of the folder until this ends. Throws vp::InputError that names who has
  /// it.
  void lock();

  /// In a forked process: lets others in, however long it takes to end.
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

  /// Keys of all points in the folder, sorted. Names what is there and is no point.
  std::vector<std::string> keys(std::vector<std::string>& foreign) const;

  /// So that one point is computed by one process at a time, whoever works here. Waits.
  host::FileLock claim(const std::string& key) const;

 private:
  std::string folder_;
  std::string points_;                        ///< folder of the points, with the slash
  std::unique_ptr<host::OutputFolder> lock_;  ///< of the process that took it
};

}  // namespace platform::study
