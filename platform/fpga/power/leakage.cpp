#include <fpga/power/leakage.h>

#include <vp/error.h>

#include <utility>

namespace platform::power {

namespace {

constexpr double milli = 1e-3;  ///< of static.bram, which is in mW

}  // namespace

Leaking leaking(const device::Device& chip, double bram36, bool older_tool) {
  Leaking result;
  result.scale = chip.static_w.value / device::find_device(PowerTable::part).static_w.value;
  result.bram36 = bram36;
  // The devices below the XC7Z020 are one die.
  if (older_tool)
    result.older_tool = result.scale < 1 ? "static.older_tool_7010" : "static.older_tool_7020";
  return result;
}

vp::LeakageCurve leakage(const PowerTable& table, const Leaking& chip, double vp::Band::*estimate) {
  const auto value = [&](const std::string& name) { return table.value(name).*estimate; };
  return {
      chip.scale * value("static.base") + (chip.older_tool.empty() ? 0 : value(chip.older_tool)),
      chip.scale * value("static.leakage") + chip.bram36 * milli * value("static.bram"),
      value("static.slope")};
}

vp::EnergyLedger static_energy(const PowerTable& table, const Leaking& chip,
                               const vp::ThermalPath& path, const vp::Band& dynamic_w,
                               double seconds, double& junction_c) {
  const auto point = [&](double vp::Band::*estimate) {
    try {
      return vp::find_static_point(leakage(table, chip, estimate), path, dynamic_w.*estimate);
    } catch (const vp::InputError& error) {
      if (estimate != &vp::Band::high) throw;
      throw vp::InputError(std::string(error.what()) + " (by the high estimate of the table)");
    }
  };
  const vp::StaticPoint low = point(&vp::Band::low), nominal = point(&vp::Band::nominal),
                        high = point(&vp::Band::high);
  junction_c = nominal.junction_c;
  const vp::Band whole{low.static_w * seconds, nominal.static_w * seconds, high.static_w * seconds};
  const vp::LeakageCurve curve = leakage(table, chip);
  const vp::Band leaking =
      whole - vp::Band{leakage(table, chip, &vp::Band::low).base_w, curve.base_w,
                       leakage(table, chip, &vp::Band::high).base_w} *
                  seconds;
  const double of_memories = chip.bram36 * milli * table.value("static.bram").nominal;
  const double memories = curve.leakage_w > 0 ? of_memories / curve.leakage_w : 0;
  const std::string source = "static.leakage (" + table.at("static.leakage").status + ")";

  vp::EnergyLedger ledger;
  vp::Band rest = whole;
  const auto add = [&](const char* rail, double share) {
    const vp::Band part = leaking * share;
    ledger.add({"static", "static", rail, vp::PowerKind::leakage, source, part});
    rest = rest - part;
  };
  for (const auto& [rail, share] :
       {std::pair{"Vccpint", "static.share_vccpint"}, std::pair{"Vccint", "static.share_vccint"}})
    add(rail, (1 - memories) * table.value(share).nominal);
  if (memories > 0) add("Vccbram", memories);
  ledger.add({"static", "static", "Vccaux and others", vp::PowerKind::leakage, source, rest});
  return ledger;
}

}  // namespace platform::power
