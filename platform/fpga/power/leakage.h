#pragma once

#include <string>

#include <fpga/device/device.h>
#include <fpga/power/power_table.h>
#include <vp/power_meter.h>

/// Static power: what flows without any clock, and grows with the temperature.

namespace platform::power {

/// What leaks: a device, the block memories in use, and the tool that estimates.
struct Leaking {
  double scale = 1;        ///< of the device, over the part for which the coefficients hold
  double bram36 = 0;       ///< in use
  std::string older_tool;  ///< coefficient that Vivado up to 2017.2 adds; empty: a newer one
};

Leaking leaking(const device::Device& chip, double bram36 = 0, bool older_tool = false);

/// Static power of the whole device for the low, nominal and high coefficients at the dynamic power
/// of each, as energy of `seconds`, split by rail. `junction_c` gets the nominal temperature.
/// Throws vp::InputError for thermal runaway.
vp::EnergyLedger static_energy(const PowerTable& table, const Leaking& chip,
                               const vp::ThermalPath& path, const vp::Band& dynamic_w,
                               double seconds, double& junction_c);

/// The leakage of the whole device, for one of the estimates.
vp::LeakageCurve leakage(const PowerTable& table, const Leaking& chip = {},
                         double vp::Band::*estimate = &vp::Band::nominal);

}  // namespace platform::power
