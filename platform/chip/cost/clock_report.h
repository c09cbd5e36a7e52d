#pragma once

#include <cstdint>
#include <vector>

#include <chip/cost/parts.h>
#include <chip/cost/power_options.h>
#include <chip/cost/power_states.h>
#include <facts/result.h>

namespace platform {

/// What the memory clock is: as configured, or what the chip makes of that. Hz.
std::uint64_t ddr_hz(const Zynq& zynq, const PowerOptions& options);

/// All clocks that have a limit, with the highest frequency that they had. Clocks of the PL that no
/// part of the design uses are marked so.
facts::ClockReport clock_report(Zynq& zynq, const PowerOptions& options, const PowerStates& states,
                                const std::vector<Part>& parts);

}  // namespace platform
