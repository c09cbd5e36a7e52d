#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

#include <sweep/manifest.h>
#include <sweep/store.h>

namespace platform::sweep {

/// What a point's run needs.
struct PointRun {
  std::string program;
  std::vector<std::string> inputs;
  std::map<std::string, std::string> settings;  ///< the values that are not their defaults
  InputChoice input;
};

PointRun run_of(const Manifest& manifest, const PlannedPoint& point);

/// Runs the platform and writes result.json into the folder: the process is its own. Returns the
/// exit code of `markervp run`, and says on `err` what went wrong; may throw what that throws.
using RunPoint =
    std::function<int(const PointRun& run, const std::string& folder, std::ostream& err)>;

/// How a sweep went.
struct Tally {
  std::uint64_t computed = 0;  ///< done now
  std::uint64_t failed = 0;    ///< of these, without result
  bool interrupted = false;
};

/// Called when points were completed: how many of those asked for.
using OnProgress = std::function<void(std::uint64_t done)>;

struct LocalOptions {
  std::uint32_t jobs = 1;
  std::string name = "local";  ///< stands in the records of runs
};

/// Computes the points at these positions of the manifest, `jobs` at a time, each in a process of
/// its own; a process that crashes or is killed costs one point, which is tried once more. Points
/// that are there are left alone. Throws StorageError if a result cannot be written: those written
/// before are kept.
Tally run_local(const Store& store, const Manifest& manifest,
                const std::vector<std::size_t>& positions, const LocalOptions& options,
                const RunPoint& run, const OnProgress& progress);

}  // namespace platform::sweep
