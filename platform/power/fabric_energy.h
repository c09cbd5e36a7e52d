#pragma once

#include <power/power_table.h>
#include <vp/power_meter.h>
#include <vp/thermal.h>

/// What primitives of the fabric take at the vendor's default activity, J per clock, and what
/// leaks.
namespace platform::power {

/// Logic and signals of so many LUT.
vp::Band logic_energy(const PowerTable& table, double lut);
/// The clock tree to so many flip-flops.
vp::Band clock_energy(const PowerTable& table, double ff);
/// A clock tree without load.
vp::Band clock_root_energy(const PowerTable& table);
/// Block memories of 36 kbit.
vp::Band block_memory_energy(const PowerTable& table, double bram36);
vp::Band dsp_energy(const PowerTable& table, double dsp);

/// Static power of a device that leaks `scale` times as much as the table's, for one of the three
/// estimates.
vp::LeakageCurve leakage(const PowerTable& table, double scale = 1,
                         double vp::Band::*estimate = &vp::Band::nominal);

}  // namespace platform::power
