#pragma once

#include <report/design_report.h>
#include <report/result_json.h>
#include <report/verdict.h>

namespace platform::report {

/// `energy_mj` of a frame: the total first.
Json energy_json(const std::vector<GroupEnergy>& energy);
/// `power_w` of the summary.
Json power_summary_json(const PowerReport& power);

Json to_json(const PowerReport& power);
Json to_json(const ResourceReport& resources);
Json to_json(const TimingReport& timing);
Json to_json(const ClockReport& clocks);
/// `feasible`, and by part `holds` ("yes", "no", "unknown") and what else is known.
Json to_json(const Verdict& verdict);

/// Places of watts and millijoules: sums of what stands in the file hold to 1e-9.
constexpr int energy_places = 12;

}  // namespace platform::report
