#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <systemc>
#include <vector>

#include <ps/cpu/cpu.h>
#include <ps/ddr/ddr.h>
#include <ps/gic/gic.h>
#include <ps/global_timer/global_timer.h>
#include <ps/interconnect/gp_port.h>
#include <ps/interconnect/private_bus.h>
#include <ps/ocm/ocm.h>
#include <ps/peripheral_bus/peripheral_bus.h>
#include <ps/private_timer/private_timer.h>
#include <ps/slcr/slcr.h>
#include <ps/uart/uart.h>
#include <vp/router.h>

#include <zynq/clock_source.h>

namespace platform {

/// The processing system of the Zynq-7020 as far as the marker detector uses it (UG585): one
/// Cortex-A9 with its private devices, DDR and on-chip memory, UARTs, the GP0 and HP0 ports, and
/// the two PL clocks, which follow the SLCR.
class ProcessingSystem : public sc_core::sc_module {
 public:
  ProcessingSystem(sc_core::sc_module_name name, vp::ClockScheduler& scheduler);

  ClockSource fclk_clk0;
  ClockSource fclk_clk1;
  ClockSource cpu_clk;
  vp::Clock uart0_ref_clk;
  vp::Clock uart1_ref_clk;

  vp::Parameter<bool> poll_elision;
  ps::Cpu cpu;
  vp::Router interconnect;
  ps::PrivateBus private_bus;
  ps::Gic gic;
  ps::GlobalTimer global_timer;
  ps::PrivateTimer private_timer;
  ps::PeripheralBus peripheral_bus;
  ps::Slcr slcr;
  ps::Uart uart0;
  ps::Uart uart1;
  ps::Ocm ocm;
  ps::Ddr ddr;
  ps::GpPort m_axi_gp0;
  vp::Router s_axi_hp0;

  vp::Signal<bool>& fclk_reset0_n;  ///< to the PL

  /// FCLK_CLK`number` of the PL. 2 and 3 are made when a design first asks for them, before the
  /// simulation. Throws std::out_of_range beyond 3.
  ClockSource& fclk_clk(unsigned number);
  /// Those that there are, by number.
  std::vector<ClockSource*> fclks();

  /// An interrupt of the PS and the signal that raises it.
  struct Interrupt {
    std::uint32_t id;
    vp::Signal<bool>* source;
  };
  /// Those of the PS's own devices, by number. The PL's come through IRQ_F2P.
  const std::vector<Interrupt>& interrupts() const { return interrupts_; }

 private:
  void map_private_bus();
  void map_peripherals();
  void connect_interrupts();
  void connect_clocks();
  std::string device_at(std::uint32_t address) const;

  std::vector<Interrupt> interrupts_;
  vp::ClockScheduler& scheduler_;
  std::unique_ptr<ClockSource> fclk_clk2_, fclk_clk3_;
};

}  // namespace platform
