#pragma once

#include <string>

#include <fpga/power/design_figures.h>
#include <fpga/power/power_table.h>
#include <vp/power_meter.h>

/// What parts of the chip take at the vendor's default activity.

// The power of a design of which there are only figures: those of a utilisation report and its
// clocks. The vendor's default activity, as power.mode=vivado-default.
namespace platform::power {

constexpr double nano = 1e-9;  ///< mW/MHz is nJ a clock
constexpr double pico = 1e-12;

/// Logic and signals of so many LUT between so many flip-flops, J per clock. Of "pl.logic", which
/// is for logic of which nothing is declared: the deeper it is between two registers, the more its
/// signals toggle on the way; per LUT it takes (LUT / FF)^pl.logic_depth, within the ratios of the
/// designs that the coefficient comes from. The coefficients of declared logic have no depth.
vp::Band logic_energy(const PowerTable& table, double lut, double ff,
                      const std::string& coefficient = "pl.logic");
/// Of logic whose signals have so many bits, J for each change of one of them.
vp::Band change_energy(const PowerTable& table, double lut, double ff, double bits);
/// The clock tree to so many flip-flops, J per clock. So are the next ones.
vp::Band clock_energy(const PowerTable& table, double ff);
/// A clock net, loaded or not, and its branches, which reach over an area that grows with the
/// flip-flops on it.
vp::Band clock_net_energy(const PowerTable& table, double ff);
/// Block memories of 36 kbit.
vp::Band block_memory_energy(const PowerTable& table, double bram36,
                             const std::string& coefficient = "pl.bram");
vp::Band dsp_energy(const PowerTable& table, double dsp, const std::string& coefficient = "pl.dsp");

/// What makes estimates with this coefficient wrong, so that they are low or high together
/// (vp::EnergyEntry::cause): a design of which nothing is declared is busy or rests as a whole.
std::string cause_of(const std::string& coefficient);

/// Cores that the vendor's tool bills on any device of the family, at ps.default_load each.
double default_cores(const PowerTable& table);

/// DDR I/O of a bus that is always busy, W.
vp::Band ddr_io_power(const PowerTable& table, const DdrInterface& ddr);
/// "ps.uncore_32" or "ps.uncore_16": coefficients that depend on the width of the memory.
std::string of_width(const std::string& name, unsigned width);

struct PowerEstimate {
  /// Of a second: joules are watts. Groups are the kinds of a vendor's report: "PS", "clocks",
  /// "logic and signals", "block RAM", "DSP", "MMCM", "PLL", "I/O", "static".
  vp::EnergyLedger ledger;
  double junction_c = 0;
};

/// Throws vp::InputError for thermal runaway.
PowerEstimate estimate_power(const DesignFigures& design, const PowerTable& table);

}  // namespace platform::power
