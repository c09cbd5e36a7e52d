#pragma once

#include <string>

#include <sweep/results.h>

namespace platform::sweep {

/// What a sweep found, for a terminal: a table of points (at most `most_rows`), what failed and
/// why, and the sweep's own text.
std::string sweep_text(const Results& results, std::size_t most_rows = 40);

}  // namespace platform::sweep
