#pragma once

#include <string>
#include <systemc>

#include <vp/clock_scheduler.h>
#include <vp/parameter.h>
#include <zynq/processing_system.h>
#include <zynq/programmable_logic.h>

namespace platform {

/// The Zynq-7020 with the marker detector in its programmable logic: everything that is simulated.
struct Zynq {
  Zynq();

  vp::Parameter<std::string> fidelity{"fidelity",
                                      "clocked",
                                      {"clocked"},
                                      vp::Source::decision,
                                      "how the programmable logic is modelled: clock by clock"};
  vp::ClockScheduler scheduler{"scheduler"};
  ProcessingSystem ps{"ps", scheduler};
  ProgrammableLogic pl{"pl", ps.fclk_clk0.clk, ps.fclk_clk1.clk};
};

}  // namespace platform
