#pragma once

#include <string>

#include <sweep/results.h>

namespace platform::sweep {

/// How many points are feasible, and how many fail each part of the verdict: "3 of 12 points
/// feasible; 2 did not run, 7 miss timing".
std::string verdicts_text(const Results& results);

/// What a sweep found, for a terminal: a table of points (at most `most_rows`), what failed and
/// why, and the sweep's own text.
std::string sweep_text(const Results& results, std::size_t most_rows = 40);

}  // namespace platform::sweep
