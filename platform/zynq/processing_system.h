#pragma once

#include <cstdint>
#include <string>
#include <systemc>

#include <ps/cpu/cpu.h>
#include <ps/ddr/ddr.h>
#include <ps/gic/gic.h>
#include <ps/global_timer/global_timer.h>
#include <ps/interconnect/gp_port.h>
#include <ps/interconnect/private_bus.h>
#include <vp/router.h>

#include <zynq/clock_source.h>

namespace platform {

/// The processing system of the Zynq-7020 as far as the marker detector uses it (UG585): one
/// Cortex-A9 with its private devices, DDR, the GP0 and HP0 ports, the two PL clocks.
class ProcessingSystem : public sc_core::sc_module {
 public:
  ProcessingSystem(sc_core::sc_module_name name, vp::ClockScheduler& scheduler);

  // The system clock is made before the pixel clock: at coincident edges it samples first (see
  // pl::ClockCrossing).
  ClockSource fclk_clk0;
  ClockSource fclk_clk1;
  ClockSource cpu_clk;

  ps::Cpu cpu;
  vp::Router interconnect;
  ps::PrivateBus private_bus;
  ps::Gic gic;
  ps::GlobalTimer global_timer;
  ps::Ddr ddr;
  ps::GpPort m_axi_gp0;
  vp::Router s_axi_hp0;

  vp::Signal<bool> fclk_reset0_n{"fclk_reset0_n", 1, true};

 private:
  std::string device_at(std::uint32_t address) const;
};

}  // namespace platform
