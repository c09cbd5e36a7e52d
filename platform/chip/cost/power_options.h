#pragma once

#include <cstdint>
#include <string>
#include <systemc>

#include <chip/system/design.h>
#include <vp/parameter.h>
#include <vp/power_meter.h>

namespace platform {

enum class PowerMode {
  vivado_default,  ///< a vendor estimate: constant PS, default toggling in the PL
  activity,        ///< load, traffic and events of the simulation
};

/// The parameters of the module that they are a member of.
struct PowerOptions {
  /// The defaults of pl_design and mode; `design` adds its own.
  PowerOptions(bool uses_pl, PowerMode usual, Design& design);

  vp::Parameter<PowerMode> mode;
  vp::Parameter<std::string> table;
  vp::Parameter<double> ambient;
  vp::Parameter<double> theta_ja;
  vp::Parameter<bool> pl_design;

  struct Ddr : sc_core::sc_module {
    explicit Ddr(sc_core::sc_module_name name);
    vp::Parameter<std::uint32_t> width;
    vp::Parameter<std::uint64_t> frequency;
    vp::Parameter<double> voltage;
  } ddr{"ddr"};

  vp::ThermalPath thermal_path() const { return {ambient, theta_ja}; }
};

}  // namespace platform
