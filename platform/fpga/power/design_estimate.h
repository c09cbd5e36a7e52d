#pragma once

#include <optional>
#include <string>
#include <vector>

#include <fpga/device/device.h>
#include <fpga/power/power_table.h>
#include <vp/power_meter.h>

/// What parts of the chip take at the vendor's default activity, and what leaks.

// The power of a design of which there are only figures: those of a utilisation report and its
// clocks. The vendor's default activity, as power.mode=vivado-default.
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

/// Of signals, a clock: the vendor's default.
constexpr double default_toggle_rate = 0.125;

/// What is on one clock of the PL.
struct ClockDomain {
  std::string name;
  double mhz = 0;
  double lut = 0, ff = 0, bram36 = 0, dsp = 0;
  double toggle_rate = default_toggle_rate;
};

/// Pins of the PL.
struct Pins {
  double count = 0;
  double mhz = 0;                            ///< of their data
  double toggle_rate = default_toggle_rate;  ///< of their clock
};

/// Settings of the processing system.
struct PsSettings {
  double cpu_mhz = 0;
  double load = 0.5;  ///< of each core
  double hp_mhz = 0;  ///< clock of an HP port in use, 0 for none
  DdrInterface ddr;
};

struct DesignFigures {
  device::Device device;
  std::vector<ClockDomain> clocks;
  double mmcm = 0;
  Pins io;
  std::optional<PsSettings> ps;
  vp::ThermalPath thermal{25, 11.5};
};

/// Reads a YAML file:
///
///   device: xc7z020-1
///   clocks:
///     pixel: {frequency: 50 MHz, lut: 24206, ff: 5279, bram36: 4, dsp: 0, toggle_rate: 12.5 %}
///   mmcm: 0
///   io: {pins: 36, frequency: 25 MHz, toggle_rate: 12.5 %}
///   ps: {cpu_clock: 666.67 MHz, load: 50 %, hp_clock: 100 MHz,
///        ddr: {width: 32, frequency: 533.33 MHz, voltage: 1.5 V}}
///   ambient: 25 C
///   theta_ja: 11.5
///
/// Of a clock `frequency`, `lut` and `ff` must be there, of pins `pins` and `frequency`; the PS
/// takes the vendor's defaults for what is not written, and `ps: none` leaves it out. Throws
/// vp::InputError with file, line and the nearest that works for anything unknown, missing,
/// negative or beyond the device.
DesignFigures read_design_figures(const std::string& file);

struct PowerEstimate {
  /// Of a second: joules are watts. Groups are the kinds of a vendor's report: "PS", "clocks",
  /// "logic and signals", "block RAM", "DSP", "MMCM", "I/O", "static".
  vp::EnergyLedger ledger;
  double junction_c = 0;
};

/// Throws vp::InputError for thermal runaway.
PowerEstimate estimate_power(const DesignFigures& design, const PowerTable& table);

}  // namespace platform::power
