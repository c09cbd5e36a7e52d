#pragma once

#include <cstdint>
#include <string>
#include <systemc>

#include <vp/parameter.h>
#include <vp/thermal.h>

namespace platform {

enum class PowerMode {
  vivado_default,  ///< a vendor estimate: constant PS, default toggling in the PL
  activity,        ///< load, traffic and events of the simulation
};

/// The parameters of the module that they are a member of.
struct PowerOptions {
  /// The defaults of pl_design and mode.
  PowerOptions(bool uses_pl, PowerMode usual);

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

  struct Blob : sc_core::sc_module {
    explicit Blob(sc_core::sc_module_name name);
    vp::Parameter<bool> figure_includes_static;
  } blob{"blob"};

  vp::ThermalPath thermal_path() const { return {ambient, theta_ja}; }
};

}  // namespace platform
