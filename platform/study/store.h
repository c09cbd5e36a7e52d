#pragma once

#include <memory>
#include <string>
#include <vector>

#include <host/output_folder.h>
#include <study/kept_result.h>
#include <study/manifest.h>

namespace platform::study {

/// The folder of a sweep:
///
///   manifest.json  the points of the last sweep in it; points.csv the same as a table
///   runs/          what came of every point that was ever computed in it, a Shard a process
///   points/        KEY.json of points whose whole result is kept (KeptResult)
///   sweep.csv, sweep.sqlite  results of the last sweep, made of these
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
  std::string kept_path(const std::string& key) const;

  /// Keeps a whole result. Throws vp::OutputError.
  void keep(const KeptResult& result) const;
  /// Flushes to the disk all that was written. Throws vp::OutputError.
  void flush() const;

  void write_manifest(const Manifest& manifest) const;
  Manifest read_manifest() const;

  /// Keys of the whole results in the folder, sorted. `foreign`: names of other files there.
  std::vector<std::string> kept_keys(std::vector<std::string>& foreign) const;

 private:
  std::string folder_;
  std::unique_ptr<host::OutputFolder> lock_;  ///< of the process that took it
};

}  // namespace platform::study
