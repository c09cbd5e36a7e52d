#pragma once

#include <report/hardware_map.h>
#include <zynq/zynq.h>

namespace platform {

/// The map of the platform as it is built now, before the simulation starts.
report::HardwareMap hardware_map(Zynq& zynq);

}  // namespace platform
