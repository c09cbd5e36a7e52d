#include <fpga/power/design_estimate.h>

#include <fpga/power/leakage.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace platform::power {

namespace {

constexpr double per_thousand = 1e-3;
constexpr double full_voltage = 1.5, low_voltage = 1.35;
/// LUT over flip-flops in the reports that calibration/power/refit.py fits.
constexpr double least_depth = 0.5, most_depth = 4.5;
/// Oscillators of an MMCM of the slowest speed grade (DS181, DS187: MMCM_FVCOMIN, MMCM_FVCOMAX).
constexpr double slowest_ghz = 0.6, fastest_ghz = 1.2;

}  // namespace

vp::Band logic_energy(const PowerTable& table, double lut, double ff,
                      const std::string& coefficient) {
  double toggles = 1;
  if (coefficient == "pl.logic") {
    const double depth = ff > 0 ? std::clamp(lut / ff, least_depth, most_depth) : most_depth;
    toggles = std::pow(depth, table.value("pl.logic_depth").nominal);
  }
  return table.value(coefficient) * (toggles * lut * per_thousand * nano);
}

vp::Band change_energy(const PowerTable& table, double lut, double ff, double bits) {
  return logic_energy(table, lut, ff, "pl.logic_simulated") * (1 / (default_toggle_rate * bits));
}

vp::Band clock_energy(const PowerTable& table, double ff) {
  return table.value("pl.clock") * (ff * per_thousand * nano);
}

vp::Band clock_net_energy(const PowerTable& table, double ff) {
  vp::Band net = table.value("pl.clock_root");
  net += table.value("pl.clock_branch") * std::sqrt(ff * per_thousand);
  return net * nano;
}

vp::Band block_memory_energy(const PowerTable& table, double bram36,
                             const std::string& coefficient) {
  return table.value(coefficient) * (bram36 * pico);
}

vp::Band dsp_energy(const PowerTable& table, double dsp, const std::string& coefficient) {
  return table.value(coefficient) * (dsp * pico);
}

std::string cause_of(const std::string& coefficient) {
  const bool undeclared =
      coefficient == "pl.logic" || coefficient == "pl.bram" || coefficient == "pl.dsp";
  return undeclared ? "activity" : coefficient;
}

double default_cores(const PowerTable& table) {
  return table.value("ps.default_cores").nominal;
}

std::string of_width(const std::string& name, unsigned width) {
  return name + (width == 32 ? "32" : "16");
}

vp::Band ddr_io_power(const PowerTable& table, const DdrInterface& ddr) {
  vp::Band amperes = table.value(of_width("ps.ddr_current_", ddr.width));
  amperes += table.value(of_width("ps.ddr_slope_", ddr.width)) * ddr.mhz;
  const double lower = (full_voltage - ddr.volts) / (full_voltage - low_voltage);
  const vp::Band& factor = table.value("ps.ddr_low_voltage");
  const auto watts = [&](double vp::Band::*estimate) {
    return amperes.*estimate * (1 - (1 - factor.*estimate) * lower) * ddr.volts;
  };
  return {watts(&vp::Band::low), watts(&vp::Band::nominal), watts(&vp::Band::high)};
}

namespace {

using device::hz_per_mhz;
using vp::PowerKind;

class Estimator {
 public:
  explicit Estimator(const PowerTable& table) : table_(table) {}

  void add_ps(const PsSettings& ps) {
    if (ps.known_w) return add_known("ps", "PS", *ps.known_w);
    const double cores = ps.cores.value_or(default_cores(table_));
    const double cycles = ps.cpu_mhz * hz_per_mhz * ps.load * cores;
    add("ps.cores", "Vccpint", PowerKind::state, "ps.core_cycle",
        table_.value("ps.core_cycle") * (nano * cycles));
    add_state("ps.uncore", "Vccpint", of_width("ps.uncore_", ps.ddr.width));
    add_state("ps.pll", "Vccpll", "ps.pll");
    add_state("ps.aux", "Vccpaux", of_width("ps.aux_", ps.ddr.width));
    add_state("ps.mio", "Vcco_mio", "ps.mio");
    add("ps.ddr_io", "Vcco_ddr", PowerKind::state, of_width("ps.ddr_current_", ps.ddr.width),
        ddr_io_power(table_, ps.ddr));
    if (ps.hp_mhz > 0)
      add("ps.s_axi_hp", "Vccpint", PowerKind::state, "ps.hp_port",
          table_.value("ps.hp_port") * (nano * ps.hp_mhz * hz_per_mhz));
  }

  void add_clock(const ClockDomain& c) {
    const double hz = c.mhz * hz_per_mhz;
    const double toggles = c.toggle_rate / default_toggle_rate;
    vp::Band tree = clock_net_energy(table_, c.ff);
    tree += clock_energy(table_, c.ff);
    add("pl." + c.name, "Vccint", PowerKind::clock, "pl.clock", tree * hz);
    if (c.lut > 0)
      add("pl." + c.name + ".logic", "Vccint", PowerKind::state, c.logic,
          logic_energy(table_, c.lut, c.ff, c.logic) * (hz * toggles));
    if (c.bram36 > 0)
      add("pl." + c.name + ".bram36", "Vccbram", PowerKind::state, c.memory,
          block_memory_energy(table_, c.bram36, c.memory) * hz);
    if (c.dsp > 0)
      add("pl." + c.name + ".dsp", "Vccint", PowerKind::state, c.multiplier,
          dsp_energy(table_, c.dsp, c.multiplier) * (hz * multiplier_share(c)));
  }

  void add_mmcm(const ClockManager& manager) {
    vp::Band watts = mmcm(manager);
    if (!manager.declared) {
      watts.low = mmcm({slowest_ghz}).low;
      watts.high = mmcm({fastest_ghz, true}).high;
    }
    add("pl.mmcm", "Vccaux", PowerKind::clock, "pl.mmcm", watts);
  }

  void add_pll(const ClockManager& manager) {
    add("pl.pll", "Vccaux", PowerKind::clock, "pl.pll", table_.value("pl.pll") * manager.ghz);
  }

  void add_pins(const Pins& io) {
    if (io.known_w) return add_known("pl.io", "I/O", *io.known_w);
    if (io.tmds_pairs > 0)
      add("pl.io.tmds", "Vcco", PowerKind::state, "pl.tmds_pair",
          table_.value("pl.tmds_pair") * io.tmds_pairs);
    const double toggles = io.toggle_rate / default_toggle_rate;
    if (io.count > 0)
      add("pl.io", "Vcco", PowerKind::state, "pl.io",
          table_.value("pl.io") * (pico * io.count * io.mhz * hz_per_mhz * toggles));
  }

  PowerEstimate take(const DesignFigures& design) {
    PowerEstimate estimate{ledger_, 0};
    double bram36 = 0;
    for (const ClockDomain& clock : design.clocks) bram36 += clock.bram36;
    estimate.ledger.add(static_energy(table_, leaking(design.device, bram36, design.older_tool),
                                      design.thermal, ledger_.total(), 1, estimate.junction_c));
    return estimate;
  }

 private:
  vp::Band mmcm(const ClockManager& manager) const {
    vp::Band watts = table_.value("pl.mmcm");
    watts += table_.value("pl.mmcm_oscillator") * manager.ghz;
    if (manager.fractional) watts += table_.value("pl.mmcm_fractional") * manager.ghz;
    return watts;
  }

  /// Of the energy of a multiplier at the default toggle rate. In a simulation it cannot be busier
  /// than in every clock.
  static double multiplier_share(const ClockDomain& c) {
    const double toggles = c.toggle_rate / default_toggle_rate;
    return c.toggles ? std::min(1.0, toggles) : toggles;
  }

  /// As a vendor's report has them.
  static std::string kind_of(const std::string& coefficient) {
    static const std::map<std::string, std::string> kinds{
        {"pl.clock", "clocks"},   {"pl.logic", "logic and signals"},
        {"pl.bram", "block RAM"}, {"pl.dsp", "DSP"},
        {"pl.mmcm", "MMCM"},      {"pl.pll", "PLL"},
        {"pl.io", "I/O"},         {"pl.tmds", "I/O"}};
    const auto found = kinds.find(coefficient.substr(0, coefficient.find('_')));
    return found == kinds.end() ? "PS" : found->second;
  }
  void add(const std::string& module, const char* rail, PowerKind kind,
           const std::string& coefficient, const vp::Band& watts) {
    ledger_.add({module, kind_of(coefficient), rail, kind,
                 coefficient + " (" + table_.at(coefficient).status + ")", watts,
                 cause_of(coefficient)});
  }
  void add_known(const std::string& module, const std::string& kind, double watts) {
    ledger_.add({module, kind, "not split", PowerKind::state, "declared", {watts, watts, watts}});
  }
  void add_state(const std::string& module, const char* rail, const std::string& coefficient) {
    add(module, rail, PowerKind::state, coefficient, table_.value(coefficient));
  }

  const PowerTable& table_;
  vp::EnergyLedger ledger_;
};

}  // namespace

PowerEstimate estimate_power(const DesignFigures& design, const PowerTable& table) {
  Estimator estimator(table);
  if (design.ps) estimator.add_ps(*design.ps);
  for (const ClockDomain& clock : design.clocks) estimator.add_clock(clock);
  for (const ClockManager& manager : design.mmcm) estimator.add_mmcm(manager);
  for (const ClockManager& manager : design.pll) estimator.add_pll(manager);
  estimator.add_pins(design.io);
  return estimator.take(design);
}

}  // namespace platform::power
