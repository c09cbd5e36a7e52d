#pragma once

#include <optional>
#include <string>
#include <vector>

#include <fpga/device/device.h>
#include <fpga/power/toggle_count.h>
#include <vp/power_meter.h>

/// A design of which there are only figures: what its utilisation report and its clocks say.

namespace platform::power {

/// Of signals, a clock: the vendor's default.
constexpr double default_toggle_rate = 0.125;

/// The memory interface of the PS: `width` is 16 or 32 bit.
struct DdrInterface {
  unsigned width = 32;
  double mhz = 0;
  double volts = 1.5;
};

/// What is on one clock of the PL. What its logic, memories and multipliers do no utilisation
/// tells: a design may declare it. The coefficient of each follows, and with it the band.
struct ClockDomain {
  std::string name;
  double mhz = 0;
  double lut = 0, ff = 0, bram36 = 0, dsp = 0;
  double toggle_rate = default_toggle_rate;
  std::optional<ToggleCount> toggles = {};  ///< of a simulation, from which toggle_rate comes
  std::string logic = "pl.logic";  ///< or pl.logic_rest, _control, _arithmetic, _cipher, _simulated
  std::string memory = "pl.bram";  ///< or pl.bram_always, _traffic, _buffer, _rest
  std::string multiplier = "pl.dsp";  ///< or pl.dsp_busy, _shared, _rest
};

/// Pins of the PL.
struct Pins {
  double count = 0;
  double mhz = 0;                            ///< of their data
  double toggle_rate = default_toggle_rate;  ///< of their clock
  double tmds_pairs = 0;                     ///< differential pairs of HDMI or DVI, at any clock
  std::optional<double> known_w;             ///< of all pins, instead of an estimate
};

/// An MMCM or a PLL.
struct ClockManager {
  double ghz = 1;           ///< of its oscillator
  bool fractional = false;  ///< multiplies or divides by a number that is not whole: an MMCM can
  bool declared = false;    ///< otherwise it may be any that the device allows
};

/// Settings of the processing system.
struct PsSettings {
  double cpu_mhz = 0;
  double load = 0.5;            ///< of each core
  std::optional<double> cores;  ///< none: as many as the vendor's tool bills
  double hp_mhz = 0;            ///< clock of an HP port in use, 0 for none
  DdrInterface ddr;
  std::optional<double> known_w;  ///< of the whole PS, instead of an estimate
};

struct DesignFigures {
  device::Device device;
  std::vector<ClockDomain> clocks;
  std::vector<ClockManager> mmcm, pll;
  Pins io;
  std::optional<PsSettings> ps;
  bool older_tool = false;  ///< estimate as Vivado up to 2017.2 does
  vp::ThermalPath thermal{25, 11.5};
};

/// Reads a YAML file:
///
///   device: xc7z020-1
///   tool: 2018.3
///   clocks:
///     pixel: {frequency: 50 MHz, lut: 24206, ff: 5279, bram36: 4, dsp: 0, toggle_rate: 12.5 %,
///             activity: control, bram_activity: buffer, dsp_activity: rest}
///     cipher: {frequency: 100 MHz, lut: 2000, ff: 1500,
///              trace: {file: run.vcd, below: top.cipher, clock: top.clk}}
///   mmcm: [1000 MHz, {oscillator: 850 MHz, fractional: yes}]
///   pll: [1000 MHz]
///   io: {pins: 36, frequency: 25 MHz, toggle_rate: 12.5 %, tmds_pairs: 4}
///   ps: {cpu_clock: 666.67 MHz, load: 50 %, cores: 2, hp_clock: 100 MHz,
///        ddr: {width: 32, frequency: 533.33 MHz, voltage: 1.5 V}}
///   ambient: 25 C
///   theta_ja: 11.5
///
/// Of a clock `frequency`, `lut` and `ff` must be there, of pins `pins` and `frequency`; the PS
/// takes the vendor's defaults for what is not written, and `ps: none` leaves it out. `mmcm` and
/// `pll` are a number, or a list of the frequencies of their oscillators; of an MMCM also whether
/// it multiplies or divides by a number that is not whole. `power` in `io` or `ps` takes the place
/// of all else there. A `trace`, which is sought beside the file, gives the toggle rate of its
/// clock's logic; its `clock` is a signal of it, or a frequency. Throws vp::InputError with file,
/// line and the nearest that works for anything unknown, missing, negative or beyond the device.
DesignFigures read_design_figures(const std::string& file);

}  // namespace platform::power
