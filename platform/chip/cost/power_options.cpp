#include <chip/cost/power_options.h>

#include <string>

#include <vp/error.h>

namespace platform {

PowerOptions::PowerOptions(bool uses_pl, PowerMode usual, Design& design)
    : mode("mode", usual,
           {{"vivado-default", PowerMode::vivado_default}, {"activity", PowerMode::activity}},
           vp::Source::decision,
           "what is estimated: as the vendor's tool does by default (reproduces the thesis' 1.5 W "
           "and 0.4 W), or by load, traffic and events of the simulation"),
      table("table", "zynq7020", vp::Source::decision,
            "coefficients: the name of an installed table, or a file .json"),
      ambient("ambient", 25, vp::Unit::temperature, {-40, 100}, vp::Source::published,
              "temperature around the board (default of the vendor's estimates)"),
      theta_ja(
          "theta_ja", 11.5, vp::Unit::none, {0, 100}, vp::Source::published,
          "how much hotter the junction gets, C/W (vendor's estimates: medium board, 250 LFM)"),
      pl_design("pl_design", uses_pl, vp::Source::decision,
                "whether the PL holds the design; a system without it leaves the PL unconfigured") {
  mode.follows("camera.rate");
  pl_design.follows("design");
  design.add_power_options();
}

PowerOptions::Ddr::Ddr(sc_core::sc_module_name name)
    : sc_module(name),
      width("width", 32, vp::Unit::none, {16, 32}, vp::Source::published,
            "data lines to the DDR chips, 16 or 32 (ZedBoard: 32)"),
      frequency("frequency", 533'333'333, vp::Unit::frequency, {200'000'000, 533'333'334},
                vp::Source::published, "memory clock; two transfers a clock"),
      voltage("voltage", 1.5, vp::Unit::voltage, {1.35, 1.5}, vp::Source::published,
              "supply of the DDR lines: 1.5 V, or 1.35 V for DDR3L") {
  if (width == 16 || width == 32) return;
  throw vp::InputError(std::string(width.name()) + " is " + std::to_string(width) +
                       ": give 16 or 32");
}

}  // namespace platform
