#pragma once

#include <string>

#include <sweep/results.h>

namespace platform::sweep {

/// One line a point: key, status, message, the swept parameters, the metrics.
std::string results_csv(const Results& results);

}  // namespace platform::sweep
