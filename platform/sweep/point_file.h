#pragma once

#include <string>

#include <sweep/manifest.h>

namespace platform::sweep {

/// How a point's run failed.
struct Failure {
  int exit_code = -1;  ///< -1: a signal ended it
  int signal = 0;
  std::string message;  ///< one line
};

/// A point and its result, as points/KEY.json holds it:
///
///   markervp_point  version of the format
///   key             hash of `identity`, the file's name
///   identity        everything that decides the result
///   run             program, inputs and settings to run it again
///   digest          hash of `outcome`
///   outcome         status "done" or "failed"; failure {exit_code, signal, message};
///                   result: result.json without provenance and configuration; of a failed point
///                   only if its program ended by itself
struct PointRecord {
  std::string key;
  Json identity;
  Json run;
  Json outcome;

  bool failed() const { return outcome.at("status") == "failed"; }
};

PointRecord done_record(const Manifest& manifest, const PlannedPoint& point, Json result);
/// `result`: what there is of one, or null.
PointRecord failed_record(const Manifest& manifest, const PlannedPoint& point,
                          const Failure& failure, Json result = nullptr);

std::string point_text(const PointRecord& record);

/// Throws vp::InputError: cannot be read, no point file, of another version of the format, damaged.
/// Without `verify` the hashes are taken as they stand, for a file that was verified before.
PointRecord read_point(const std::string& path, bool verify = true);

}  // namespace platform::sweep
