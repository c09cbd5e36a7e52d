#pragma once

#include <string>

#include <device/device.h>
#include <power/power_table.h>
#include <vp/power_meter.h>

/// What parts of the chip take at the vendor's default activity, and what leaks.
namespace platform::power {

constexpr double nano = 1e-9;  ///< mW/MHz is nJ a clock
constexpr double pico = 1e-12;

/// Logic and signals of so many LUT between so many flip-flops, J per clock. The deeper the logic
/// between two registers, the more its signals toggle on the way: per LUT it takes
/// (LUT / FF)^pl.logic_depth, within the ratios of the designs that the coefficients come from.
vp::Band logic_energy(const PowerTable& table, double lut, double ff);
/// The clock tree to so many flip-flops, J per clock. So are the next ones.
vp::Band clock_energy(const PowerTable& table, double ff);
/// A clock tree without load.
vp::Band clock_root_energy(const PowerTable& table);
/// Block memories of 36 kbit.
vp::Band block_memory_energy(const PowerTable& table, double bram36);
vp::Band dsp_energy(const PowerTable& table, double dsp);

/// The memory interface of the PS: `width` is 16 or 32 bit.
struct DdrInterface {
  unsigned width = 32;
  double mhz = 0;
  double volts = 1.5;
};

/// DDR I/O of a bus that is always busy, W.
vp::Band ddr_io_power(const PowerTable& table, const DdrInterface& ddr);
/// "ps.uncore_32" or "ps.uncore_16": coefficients that depend on the width of the memory.
std::string of_width(const std::string& name, unsigned width);

/// Static power of a device over that of the part for which the coefficients hold.
double static_scale(const device::Device& chip);

/// Static power of the whole device for the low, nominal and high coefficients at the dynamic power
/// of each, as energy of `seconds`, split by rail. `scale`: static_scale(). `junction_c` gets the
/// nominal temperature. Throws vp::InputError for thermal runaway.
vp::EnergyLedger static_energy(const PowerTable& table, double scale, const vp::ThermalPath& path,
                               const vp::Band& dynamic_w, double seconds, double& junction_c);

/// The leakage of the whole device, `scale` times that of the table, for one of the estimates.
vp::LeakageCurve leakage(const PowerTable& table, double scale = 1,
                         double vp::Band::*estimate = &vp::Band::nominal);

}  // namespace platform::power
