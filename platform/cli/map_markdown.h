#pragma once

#include <string>

#include <report/hardware_map.h>

namespace platform::cli {

/// The map as a page: memory map, interrupts, clocks, and the registers of each kind of device
/// once, as their descriptions declare them.
std::string map_as_markdown(const report::HardwareMap& map);

}  // namespace platform::cli
