#pragma once

#include <report/result.h>
#include <zynq/power_options.h>
#include <zynq/power_states.h>
#include <zynq/zynq.h>

namespace platform {

/// What the memory clock is: as configured, or what the chip makes of that. Hz.
std::uint64_t ddr_hz(const Zynq& zynq, const PowerOptions& options);

/// All clocks that have a limit, with the highest frequency that they had.
report::ClockReport clock_report(Zynq& zynq, const PowerOptions& options,
                                 const PowerStates& states);

}  // namespace platform
