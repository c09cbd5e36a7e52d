#pragma once

#include <string>

#include <report/hardware_map.h>
#include <zynq/zynq.h>

namespace platform {

/// The text of xparameters.h for the platform as it is configured: what Vivado would export for it.
/// `map` has the addresses and interrupts.
std::string xparameters_header(const Zynq& zynq, const report::HardwareMap& map);

}  // namespace platform
