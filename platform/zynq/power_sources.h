#pragma once

#include <vector>

#include <power/power_table.h>
#include <vp/power_meter.h>
#include <vp/thermal.h>
#include <zynq/parts.h>
#include <zynq/power_options.h>
#include <zynq/power_states.h>
#include <zynq/zynq.h>

namespace platform {

/// What takes power on the Zynq-7020, for the meter: from the coefficients, the design, and the
/// mode. What is passed must outlive the sources.
std::vector<vp::PowerSource> power_sources(Zynq& zynq, const PowerOptions& options,
                                           const power::PowerTable& table,
                                           const std::vector<Part>& parts,
                                           const PowerStates& states);

/// Static power of a device over that of the part for which the coefficients hold.
double static_scale(const device::Device& chip);

/// Static power of the whole device for the low, nominal and high coefficients at the dynamic power
/// of each, as energy of `seconds`, split by rail. `scale`: static_scale(). `junction_c` gets the
/// nominal temperature. Throws vp::InputError for thermal runaway.
vp::EnergyLedger static_energy(const power::PowerTable& table, double scale,
                               const vp::ThermalPath& path, const vp::Band& dynamic_w,
                               double seconds, double& junction_c);

}  // namespace platform
