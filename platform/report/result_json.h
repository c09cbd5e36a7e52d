#pragma once

#include <nlohmann/json.hpp>

#include <report/result.h>
#include <report/summary.h>

namespace platform::report {

using Json = nlohmann::ordered_json;

/// `value` with that many decimal places: what result.json holds. Never -0. The table stands at
/// ResultWriter.
double rounded(double value, int places);

/// One element of `frames`.
Json to_json(const FrameReport& frame);
Json to_json(const Summary& summary);
/// The keys of `time_us` in the order of the flow; `part_of` names the stage that contains one.
Json stages_json(const Summary& summary);
Json to_json(const ProgramEnd& end);
Json to_json(const Provenance& provenance);

}  // namespace platform::report
