#pragma once

#include <cstdint>

#include <pl/common/fidelity.h>
#include <vp/router.h>
#include <zynq/processing_system.h>

namespace platform {

/// What the processing system offers to the programmable logic: clocks, reset, buses, interrupts. A
/// design is wired to these in its constructor.
class PlPorts {
 public:
  /// `otherwise`: how a design is modelled where it does not choose.
  PlPorts(ProcessingSystem& chip, vp::ClockScheduler& clocks, pl::Fidelity otherwise)
      : ps(chip), scheduler(clocks), fidelity(otherwise) {}
  PlPorts(const PlPorts&) = delete;
  PlPorts& operator=(const PlPorts&) = delete;

  /// The rest of the chip, for those who watch the software.
  ProcessingSystem& ps;
  vp::ClockScheduler& scheduler;
  const pl::Fidelity fidelity;

  /// FCLK_CLK`number`, 0 to 3. At coincident edges the one with the lower number samples first.
  vp::Clock& fclk_clk(unsigned number) { return ps.fclk_clk(number).clk; }
  /// FCLK_RESET0_N: low while software holds the PL in reset.
  vp::Signal<bool>& fclk_reset0_n() { return ps.fclk_reset0_n; }
  /// M_AXI_GP0, 0x4000'0000 to 0x7FFF'FFFF: what software reaches is behind `registers`.
  void m_axi_gp0(vp::Router& registers);
  /// S_AXI_HP0: masters behind `memory` reach the DDR.
  void s_axi_hp0(vp::Router& memory);
  /// IRQ_F2P: bits 0 to 7 are interrupts 61 to 68, bits 8 to 15 are 84 to 91.
  void irq_f2p(vp::Signal<std::uint32_t>& lines);

  /// What is behind M_AXI_GP0; null if nothing is.
  const vp::Router* registers() const { return registers_; }

 private:
  const vp::Router* registers_ = nullptr;
};

}  // namespace platform
