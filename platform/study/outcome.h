#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <result/metrics.h>

namespace platform::study {

/// How a point's run failed.
struct Failure {
  int exit_code = -1;  ///< -1: a signal ended it
  int signal = 0;
  std::string message;  ///< one line
};

/// What came out of a point, and how it was computed.
struct Outcome {
  bool failed = false;
  Failure failure;          ///< if it failed
  result::Metrics metrics;  ///< empty if there is no result
  /// The parts of its verdict (result::verdict_parts) that are not `yes`, each with why.
  std::vector<std::pair<std::string, std::string>> complaints;
  // What follows differs between hosts and times, and decides nothing.
  std::int64_t date = 0;     ///< its end, seconds since 1970
  double wall_s = 0;         ///< rounded to a tenth of a millisecond, as the next
  double cpu_s = 0;          ///< of the platform's run itself
  std::int32_t attempt = 0;  ///< 0: nothing is known of when and how
};

}  // namespace platform::study
