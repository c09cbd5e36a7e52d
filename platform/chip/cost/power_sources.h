#pragma once

#include <vector>

#include <chip/cost/parts.h>
#include <chip/cost/power_options.h>
#include <chip/cost/power_states.h>
#include <chip/system/zynq.h>
#include <fpga/power/power_table.h>
#include <vp/power_meter.h>

namespace platform {

/// What takes power on the Zynq-7020, for the meter: from the coefficients, the design, and the
/// mode. What is passed must outlive the sources.
std::vector<vp::PowerSource> power_sources(Zynq& zynq, const PowerOptions& options,
                                           const power::PowerTable& table,
                                           const std::vector<Part>& parts,
                                           const PowerStates& states);

}  // namespace platform
