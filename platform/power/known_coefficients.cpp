#include <power/known_coefficients.h>

namespace platform::power {

const std::vector<KnownCoefficient>& known_coefficients() {
  static const std::vector<KnownCoefficient> all = {
      {"ps.core_cycle", "nJ/cycle", 10},
      {"ps.default_load", "1", 1},
      {"ps.uncore_32", "W", 5},
      {"ps.uncore_16", "W", 5},
      {"ps.pll", "W", 1},
      {"ps.aux_32", "W", 1},
      {"ps.aux_16", "W", 1},
      {"ps.mio", "W", 1},
      {"ps.ddr_current_32", "A", 5},
      {"ps.ddr_slope_32", "A/MHz", 0.01},
      {"ps.ddr_current_16", "A", 5},
      {"ps.ddr_slope_16", "A/MHz", 0.01},
      {"ps.ddr_low_voltage", "1", 1},
      {"ps.ddr_idle_share", "1", 1},
      {"ps.ddr_line_stall", "ns", 10'000},
      {"ps.hp_port", "mW/MHz", 10},
      {"static.base", "W", 5},
      {"static.leakage", "W", 5},
      {"static.slope", "1/C", 0.2},
      {"static.share_vccpint", "1", 0.5},
      {"static.share_vccint", "1", 0.5},
      {"pl.logic", "mW/(kLUT MHz)", 10},
      {"pl.logic_depth", "1", 2},
      {"pl.clock", "mW/(kFF MHz)", 10},
      {"pl.clock_root", "mW/MHz", 1},
      {"pl.bram", "uW/MHz", 1000},
      {"pl.bram_read", "pJ", 1000},
      {"pl.dsp", "uW/MHz", 1000},
      {"pl.mmcm", "W", 1},
      {"pl.io", "uW/(pin MHz)", 10'000},
      {"ip.blob_detection", "mW/MHz", 100},
      {"ip.blob_detection_net", "mW/MHz", 100},
      {"ip.axi_dma", "mW/MHz", 10},
      {"ip.axi_gpio", "mW/MHz", 10},
      {"ip.proc_sys_reset", "mW/MHz", 10},
      {"ip.axi_interconnect", "mW/MHz", 10},
  };
  return all;
}

}  // namespace platform::power
