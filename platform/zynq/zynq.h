#pragma once

#include <systemc>

#include <vp/clock_scheduler.h>
#include <vp/parameter.h>
#include <zynq/processing_system.h>
#include <zynq/programmable_logic.h>

namespace platform {

/// The Zynq-7020 with the marker detector in its programmable logic: everything that is simulated.
struct Zynq {
  /// `otherwise`: the fidelity if none is configured.
  explicit Zynq(pl::Fidelity otherwise = pl::Fidelity::tlm);

  vp::Parameter<pl::Fidelity> fidelity;
  vp::ClockScheduler scheduler{"scheduler"};
  ProcessingSystem ps{"ps", scheduler};
  ProgrammableLogic pl{"pl", ps.fclk_clk0.clk, ps.fclk_clk1.clk, fidelity};

  /// Brings all memories and counters up to now, for whoever looks at them from outside.
  void settle() {
    scheduler.synchronise();
    pl.settle();
  }

  /// What the processor finds at an address; of several the nearest to the device. "" for nothing.
  std::string device_at(std::uint32_t address) const;
};

}  // namespace platform
