#pragma once

#include <string>
#include <utility>
#include <vector>

#include <study/outcome.h>
#include <study/point.h>
#include <vp/error.h>

namespace platform::study {

/// A point with its whole result, as points/KEY.json keeps it (`--keep-results`; earlier
/// versions always did):
///
///   markervp_point  version of the format
///   key             hash of `identity`, the file's name
///   identity        everything that decides the result
///   run             program, inputs and settings to run it again
///   digest          hash of `outcome`
///   outcome         status "done" or "failed"; failure {exit_code, signal, message};
///                   result: result.json without provenance and configuration; of a failed point
///                   only if its program ended by itself
struct KeptResult {
  std::string key;
  std::string identity;  ///< as text, which is hashed and written more often than looked into
  Setup setup;
  Outcome outcome;
  Json result;  ///< null if there is none

  Json identity_json() const { return Json::parse(identity); }
};

/// Outcome::complaints of a result.json.
std::vector<std::pair<std::string, std::string>> complaints_of(const Json& result);

std::string kept_text(const KeptResult& kept);

/// A file that is not whole: the power failed while it was on its way to the disk.
class HalfPoint : public vp::InputError {
 public:
  using vp::InputError::InputError;
};

/// Throws vp::InputError: cannot be read, no point file, of another version of the format, changed,
/// under another name; HalfPoint for one that is not whole.
KeptResult read_kept(const std::string& path);

}  // namespace platform::study
