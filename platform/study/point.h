#pragma once

#include <string>
#include <utility>
#include <vector>

#include <result/metrics.h>
#include <study/manifest.h>
#include <vp/error.h>

namespace platform::study {

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
  std::string identity;  ///< as text, which is hashed and written more often than looked into
  Json run;
  Json outcome;

  Json identity_json() const { return Json::parse(identity); }
  bool failed() const { return outcome.at("status") == "failed"; }
};

PointRecord done_record(const Manifest& manifest, const PlannedPoint& point, Json result);
/// `result`: what there is of one, or null.
PointRecord failed_record(const Manifest& manifest, const PlannedPoint& point,
                          const Failure& failure, Json result = nullptr);

std::string point_text(const PointRecord& record);

/// How the third line of the text begins of a point that this version of the program computed.
std::string identity_start(const Json& program);

/// As text. File names may hold any bytes, JSON only UTF-8: others are replaced.
std::string json_text(const Json& json);

/// A point's file that is not whole: the power failed while it was on its way to the disk.
class HalfPoint : public vp::InputError {
 public:
  using vp::InputError::InputError;
};

/// Throws vp::InputError: cannot be read, no point file, of another version of the format, changed;
/// HalfPoint for one that is not whole.
/// Without `verify` the hashes are taken as they stand, for a file that was verified before.
PointRecord read_point(const std::string& path, bool verify = true);

/// What sweeps tell of a computed point; its file has the rest.
struct Outcome {
  bool failed = false;
  Failure failure;          ///< if it failed
  result::Metrics metrics;  ///< empty if there is no result
  /// The parts of its verdict (result::verdict_parts) that are not `yes`, each with why.
  std::vector<std::pair<std::string, std::string>> complaints;
};

Outcome outcome_of(const PointRecord& record);

/// Outcome::complaints of an `outcome`, a member of a point's file.
std::vector<std::pair<std::string, std::string>> complaints_of(const Json& outcome);

}  // namespace platform::study
