#include <power/chip_energy.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <vp/error.h>

namespace platform::power {

namespace {

constexpr double per_thousand = 1e-3;
constexpr double full_voltage = 1.5, low_voltage = 1.35;
/// LUT over flip-flops in the reports that calibration/power/refit.py fits.
constexpr double least_depth = 0.5, most_depth = 4.5;

}  // namespace

vp::Band logic_energy(const PowerTable& table, double lut, double ff) {
  const double depth = ff > 0 ? std::clamp(lut / ff, least_depth, most_depth) : most_depth;
  const double toggles = std::pow(depth, table.value("pl.logic_depth").nominal);
  return table.value("pl.logic") * (toggles * lut * per_thousand * nano);
}

vp::Band clock_energy(const PowerTable& table, double ff) {
  return table.value("pl.clock") * (ff * per_thousand * nano);
}

vp::Band clock_root_energy(const PowerTable& table) {
  return table.value("pl.clock_root") * nano;
}

vp::Band block_memory_energy(const PowerTable& table, double bram36) {
  return table.value("pl.bram") * (bram36 * pico);
}

vp::Band dsp_energy(const PowerTable& table, double dsp) {
  return table.value("pl.dsp") * (dsp * pico);
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

double static_scale(const device::Device& chip) {
  return chip.static_w.value / device::find_device(PowerTable::part).static_w.value;
}

vp::EnergyLedger static_energy(const PowerTable& table, double scale, const vp::ThermalPath& path,
                               const vp::Band& dynamic_w, double seconds, double& junction_c) {
  const vp::Band base = table.value("static.base") * scale;
  const auto point = [&](double vp::Band::*estimate) {
    try {
      return vp::find_static_point(leakage(table, scale, estimate), path, dynamic_w.*estimate);
    } catch (const vp::InputError& error) {
      if (estimate != &vp::Band::high) throw;
      throw vp::InputError(std::string(error.what()) + " (by the high estimate of the table)");
    }
  };
  const vp::StaticPoint low = point(&vp::Band::low), nominal = point(&vp::Band::nominal),
                        high = point(&vp::Band::high);
  junction_c = nominal.junction_c;
  const vp::Band whole{low.static_w * seconds, nominal.static_w * seconds, high.static_w * seconds};
  const vp::Band leaking = whole - base * seconds;
  const std::string source = "static.leakage (" + table.at("static.leakage").status + ")";

  vp::EnergyLedger ledger;
  vp::Band rest = whole;
  for (const auto& [rail, share] :
       {std::pair{"Vccpint", "static.share_vccpint"}, std::pair{"Vccint", "static.share_vccint"}}) {
    const vp::Band part = leaking * table.value(share);
    ledger.add({"static", "static", rail, vp::PowerKind::leakage, source, part});
    rest = rest - part;
  }
  ledger.add({"static", "static", "Vccaux and others", vp::PowerKind::leakage, source, rest});
  return ledger;
}

vp::LeakageCurve leakage(const PowerTable& table, double scale, double vp::Band::*estimate) {
  return {scale * table.value("static.base").*estimate,
          scale * table.value("static.leakage").*estimate, table.value("static.slope").*estimate};
}

}  // namespace platform::power
