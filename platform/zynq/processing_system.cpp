#include <zynq/processing_system.h>

namespace platform {

namespace {

// UG585 table 4-1.
constexpr std::uint64_t m_axi_gp0_base = 0x4000'0000, m_axi_gp0_size = 0x4000'0000;
// UG585 appendix B: offsets from the private bus' base.
constexpr std::uint64_t gic_cpu_interface = 0xF8F0'0100, global_timer_base = 0xF8F0'0200,
                        gic_distributor = 0xF8F0'1000;
constexpr std::uint32_t global_timer_interrupt = 27;

}  // namespace

ProcessingSystem::ProcessingSystem(sc_core::sc_module_name name, vp::ClockScheduler& scheduler)
    : sc_module(name),
      fclk_clk0("fclk_clk0", scheduler, 100'000'000, vp::Source::published,
                "system clock of the PL (thesis table 4.2)"),
      fclk_clk1("fclk_clk1", scheduler, 50'000'000, vp::Source::published,
                "pixel clock (thesis table 4.2)"),
      cpu_clk("cpu_clk", scheduler, 666'666'667, vp::Source::published,
              "clock of the Cortex-A9 cores (CPU_6x4x)"),
      cpu("cpu", cpu_clk.clk),
      interconnect("interconnect"),
      private_bus("private_bus", cpu_clk.clk),
      gic("gic", scheduler),
      global_timer("global_timer", cpu_clk.clk),
      ddr("ddr"),
      m_axi_gp0("m_axi_gp0", fclk_clk0.clk),
      s_axi_hp0("s_axi_hp0") {
  using Addresses = vp::Router::Addresses;
  cpu.m_axi.socket.bind(interconnect.socket);
  interconnect.map("m_axi_gp0", m_axi_gp0_base, m_axi_gp0_size, Addresses::absolute)
      .bind(m_axi_gp0.socket);
  interconnect.map("private_bus", ps::PrivateBus::base, ps::PrivateBus::size, Addresses::absolute)
      .bind(private_bus.socket);
  private_bus.devices.map("gic_cpu_interface", gic_cpu_interface, 0x100)
      .bind(gic.cpu_interface.socket);
  private_bus.devices.map("global_timer", global_timer_base, 0x100)
      .bind(global_timer.registers.socket);
  private_bus.devices.map("gic_distributor", gic_distributor, 0x1000).bind(gic.distributor.socket);
  s_axi_hp0.map("ddr", ps::Ddr::base, ddr.size, Addresses::absolute).bind(ddr.socket);

  gic.connect(global_timer_interrupt, global_timer.irq);
  cpu.n_irq(gic.n_irq);
  cpu.connect(ddr.dma_memory());
  cpu.name_devices([this](std::uint32_t address) { return device_at(address); });
}

std::string ProcessingSystem::device_at(std::uint32_t address) const {
  const vp::Router::Region* region = interconnect.find(address);
  return region ? region->name : std::string{};
}

}  // namespace platform
