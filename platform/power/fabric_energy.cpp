#include <power/fabric_energy.h>

namespace platform::power {

namespace {

constexpr double nano = 1e-9;  // mW/MHz is nJ a clock
constexpr double pico = 1e-12;
constexpr double per_thousand = 1e-3;

}  // namespace

vp::Band logic_energy(const PowerTable& table, double lut) {
  return table.value("pl.logic") * (lut * per_thousand * nano);
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

vp::LeakageCurve leakage(const PowerTable& table, double scale, double vp::Band::*estimate) {
  return {scale * table.value("static.base").*estimate,
          scale * table.value("static.leakage").*estimate, table.value("static.slope").*estimate};
}

}  // namespace platform::power
