#pragma once

#include <string>
#include <vector>

#include <report/result_json.h>

namespace platform::report {

/// Of result.json.
constexpr int result_schema = 1;

/// Adds what ran.
void add_run(Json& json, const RunFacts& facts);

/// Adds how it went.
void add_end(Json& json, const RunFacts& facts, const std::vector<std::string>& warnings);

/// Adds what stands behind the frames: summary, verdict, power, resources, timing, clocks.
void add_figures(Json& json, const RunFacts& facts, const Summary& summary);

}  // namespace platform::report
