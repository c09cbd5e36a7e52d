#pragma once

#include <optional>
#include <string>
#include <vector>

#include <device/device.h>
#include <power/chip_energy.h>
#include <power/power_table.h>
#include <vp/power_meter.h>

// The power of a design of which there are only figures: those of a utilisation report and its
// clocks. The vendor's default activity, as power.mode=vivado-default.
namespace platform::power {

/// Of signals, a clock: the vendor's default.
constexpr double default_toggle_rate = 0.125;

/// What stands on one clock of the PL.
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
