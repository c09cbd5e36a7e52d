#include <chip/system/processing_system.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <gic_registers.h>
#include <global_timer_registers.h>
#include <private_timer_registers.h>
#include <ps_gpio_registers.h>
#include <ps_i2c_registers.h>
#include <ps_spi_registers.h>
#include <ps_xadc_registers.h>
#include <slcr_registers.h>
#include <ttc_registers.h>
#include <uart_registers.h>
#include <vp/error.h>
#include <vp/ip.h>

namespace platform {

namespace {

const device::Device& chosen(const vp::Parameter<std::string>& name) {
  try {
    return device::find_device(name);
  } catch (const vp::InputError& error) {
    throw vp::ParameterError(name.name(), std::string(name.name()) + ": " + error.what());
  }
}

}  // namespace

Chip::Chip()
    : name(
          "device", "xc7z020-1", vp::Source::published,
          "chip and speed grade: what fits, how fast, which clocks; 'markervp devices' lists them"),
      clocks("clocks", ClockMode::made, {{"made", ClockMode::made}, {"exact", ClockMode::exact}},
             vp::Source::decision,
             "made: clocks have what PLLs and dividers give, the nearest to what is asked for; "
             "exact: just that"),
      data(chosen(name)) {}

ClockSource::ClockSource(sc_core::sc_module_name name, vp::ClockScheduler& scheduler,
                         std::uint64_t default_hz, vp::Source source,
                         const std::string& documentation)
    : sc_module(name),
      frequency("frequency", default_hz, vp::Unit::frequency, {1'000, 1'000'000'000'000}, source,
                documentation),
      clk("clk", scheduler, frequency),
      start_hz_(frequency) {}

void ClockSource::make(double hz) {
  start_hz_ = static_cast<std::uint64_t>(std::llround(hz));
  if (clk.frequency_hz() != start_hz_) clk.set_frequency(start_hz_);
}

namespace {

// I/O peripherals, static memories and system registers, up to the private bus.
constexpr std::uint64_t peripheral_base = 0xE000'0000;
constexpr std::uint64_t peripheral_size = ps::private_bus_base - peripheral_base;
constexpr std::uint64_t device_size = 0x1000, private_device_size = 0x100;

device::ClockPlanner planner_of(const Chip& chip, const ps::Slcr& slcr) {
  try {
    return {chip.data, slcr.ps_clk};
  } catch (const vp::InputError& error) {
    const std::string path = slcr.ps_clk.name();
    throw vp::ParameterError(path, path + ": " + error.what());
  }
}

}  // namespace

ProcessingSystem::ProcessingSystem(sc_core::sc_module_name name, vp::ClockScheduler& scheduler,
                                   const Chip& chip, std::uint32_t usual_cores)
    : sc_module(name),
      fclk_clk0("fclk_clk0", scheduler, 100'000'000, vp::Source::published,
                "system clock of the PL (thesis table 4.2)"),
      fclk_clk1("fclk_clk1", scheduler, 50'000'000, vp::Source::published,
                "pixel clock (thesis table 4.2)"),
      cpu_clk("cpu_clk", scheduler, 666'666'667, vp::Source::published,
              "clock of the Cortex-A9 cores (CPU_6x4x)"),
      uart0_ref_clk("uart0_ref_clk", scheduler, 0),  // the SLCR sets it
      uart1_ref_clk("uart1_ref_clk", scheduler, 0),
      cpu_1x_clk("cpu_1x_clk", scheduler, 0),
      spi_ref_clk("spi_ref_clk", scheduler, 0),
      poll_elision("poll_elision", true, vp::Source::decision,
                   "polls pass over reads that cannot see anything new; false: every read is made "
                   "(no result depends on it)"),
      cache_guard_steps(
          "cache_guard_steps", 200, vp::Unit::none, {0, 1'000'000'000}, vp::Source::decision,
          "accesses beside cache lines that a DMA wrote and the program did not invalidate, which "
          "are looked at one by one (5 to 20 us of the host's time each); 0: no read is looked at "
          "(no result depends on it)"),
      ethernet("ethernet", true, vp::Source::published,
               "whether the I/O PLL feeds Ethernet, which must have 125 MHz: binds the frequencies "
               "that the PL's clocks can have (ZedBoard: true)"),
      cores("cores", usual_cores, vp::Unit::none, {1, 2}, vp::Source::published,
            "Cortex-A9 cores that are modelled: the second one does nothing until software starts "
            "it"),
      cpu("cpu", cpu_clk.clk),
      interconnect("interconnect"),
      private_bus("private_bus", cpu_clk.clk, ps::private_bus_times),
      gic("gic", scheduler),
      global_timer("global_timer", cpu_clk.clk),
      private_timer("private_timer", cpu_clk.clk),
      peripheral_bus("peripheral_bus", cpu_clk.clk, ps::peripheral_bus_times),
      slcr("slcr", scheduler, chip.data.idcode()),
      uart0("uart0", uart0_ref_clk),
      uart1("uart1", uart1_ref_clk),
      gpio("gpio", cpu_1x_clk),
      i2c0("i2c0", cpu_1x_clk),
      i2c1("i2c1", cpu_1x_clk),
      spi0("spi0", spi_ref_clk),
      spi1("spi1", spi_ref_clk),
      ttc0("ttc0", cpu_1x_clk),
      ttc1("ttc1", cpu_1x_clk),
      xadc("xadc", scheduler),
      devices(make_ps_devices(scheduler, cpu_1x_clk)),
      ocm("ocm", cpu_clk.clk),
      ocm_low("ocm_low", ocm),
      ddr("ddr"),
      m_axi_gp0("m_axi_gp0", fclk_clk0.clk),
      s_axi_hp0("s_axi_hp0"),
      fclk_reset0_n(slcr.fclk_reset0_n),
      scheduler_(scheduler),
      chip_(chip),
      planner_(planner_of(chip, slcr)) {
  using Addresses = vp::Router::Addresses;
  cpu.m_axi.socket.bind(interconnect.socket);
  interconnect.map("m_axi_gp0", gp0_base, gp0_size, Addresses::absolute).bind(m_axi_gp0.socket);
  interconnect.map("ocm", ps::Ocm::base, ps::Ocm::size).bind(ocm.socket);
  interconnect.map("ocm_low", 0, ps::Ocm::size).bind(ocm_low.socket);
  ocm.follow([this] { return slcr.registers[slcr::OCM_CFG]; });
  map_private_bus();
  map_peripherals();
  s_axi_hp0.map("ddr", ps::Ddr::base, ddr.size, Addresses::absolute).bind(ddr.socket);

  connect_interrupts();
  uart0.rst(slcr.uart0_rst);
  uart1.rst(slcr.uart1_rst);
  connect_resets();
  slcr.level_shifters.guard(*interconnect.find(gp0_base)->link);
  cpu.connect(ddr.dma_memory());
  place_stacks();
  cpu.set_poll_elision(poll_elision);
  cpu.surroundings.device = [this](std::uint32_t address) {
    return ps::Answerer{device_at(address)};
  };
  if (cores == 1) return;
  const vp::HierarchyScope scope(*this);
  second_core_ = std::make_unique<SecondCore>(*this, cpu_clk.clk);
}

ProcessingSystem::~ProcessingSystem() = default;

// Behind the DDR, out of the way of what programs address, or else below the DMA buffers.
void ProcessingSystem::leave_memory_to_parent() {
  ddr.leave_to_parent();
  if (stacks_) stacks_->leave_to_parent();
}

void ProcessingSystem::place_stacks() {
  constexpr std::uint64_t page = 4096;
  const std::uint64_t bytes = (cores * cpu.settings().stack_size + page - 1) / page * page;
  if (bytes > ps::StackMemory::ddr_end - ddr.end()) {
    cpu.end_stack_at(ddr.dma_memory().first());
    return;
  }
  const vp::HierarchyScope scope(*this);
  stacks_ = std::make_unique<ps::StackMemory>("stacks", bytes);
  s_axi_hp0.map("stacks", ps::StackMemory::ddr_end - bytes, bytes, vp::Router::Addresses::absolute)
      .bind(stacks_->socket);
  cpu.end_stack_at(ps::StackMemory::ddr_end);
}

std::vector<ps::Cpu*> ProcessingSystem::cpus() {
  std::vector<ps::Cpu*> all{&cpu};
  if (second_core_) all.push_back(&second_core_->cpu);
  return all;
}

ProcessingSystem::SecondCore::SecondCore(ProcessingSystem& ps, vp::Clock& clock)
    : gic("gic1", ps.gic),
      private_timer("private_timer1", clock),
      private_bus("private_bus1", clock, ps::private_bus_times),
      interconnect("interconnect1"),
      cpu("cpu1", clock, ps.cpu) {
  using Addresses = vp::Router::Addresses;
  cpu.m_axi.socket.bind(interconnect.socket);
  for (const vp::Router::Region& region : ps.interconnect.regions()) {
    const bool own = region.base == ps::private_bus_base;
    auto& socket = interconnect.map(region.name, region.base, region.size, Addresses::absolute);
    if (own) {
      socket.bind(private_bus.socket);
    } else {
      socket.bind(ps.interconnect.socket);
    }
  }
  vp::Router& devices = private_bus.devices;
  devices.map("gic_cpu_interface", gic::cpu_interface_base, private_device_size)
      .bind(gic.cpu_interface.socket);
  devices.map("global_timer", global_timer::base, private_device_size, Addresses::absolute)
      .bind(ps.private_bus.devices.socket);
  devices.map("private_timer", private_timer::base, private_device_size)
      .bind(private_timer.registers.socket);
  devices.map("gic_distributor", gic::distributor_base, device_size).bind(gic.distributor.socket);

  gic.connect(gic::private_timer_id, private_timer.irq);
  gic.connect(gic::watchdog_id, private_timer.watchdog_irq);
  cpu.n_irq(gic.n_irq);
  gic.on_software_interrupt([this] { cpu.software_interrupt_raised(); });
  ps.gic.on_software_interrupt([&ps] { ps.cpu.software_interrupt_raised(); });
}

void ProcessingSystem::map_private_bus() {
  interconnect
      .map("private_bus", ps::private_bus_base, ps::private_bus_size,
           vp::Router::Addresses::absolute)
      .bind(private_bus.socket);
  vp::Router& devices = private_bus.devices;
  devices.map("gic_cpu_interface", gic::cpu_interface_base, private_device_size)
      .bind(gic.cpu_interface.socket);
  devices.map("global_timer", global_timer::base, private_device_size)
      .bind(global_timer.registers.socket);
  devices.map("private_timer", private_timer::base, private_device_size)
      .bind(private_timer.registers.socket);
  devices.map("gic_distributor", gic::distributor_base, device_size).bind(gic.distributor.socket);
}

void ProcessingSystem::map_peripherals() {
  interconnect
      .map("peripheral_bus", peripheral_base, peripheral_size, vp::Router::Addresses::absolute)
      .bind(peripheral_bus.socket);
  vp::Router& bus = peripheral_bus.devices;
  bus.map("uart0", uart::uart0_base, device_size).bind(uart0.registers.socket);
  bus.map("uart1", uart::uart1_base, device_size).bind(uart1.registers.socket);
  bus.map("slcr", slcr::base, device_size).bind(slcr.registers.socket);
  const auto map = [&bus](const char* name, std::uint32_t base, vp::RegisterBank& bank,
                          std::uint64_t size = device_size) {
    bus.map(name, base, size).bind(bank.socket);
  };
  map("i2c0", ps_i2c::i2c0_base, i2c0.registers);
  map("i2c1", ps_i2c::i2c1_base, i2c1.registers);
  map("spi0", ps_spi::spi0_base, spi0.registers);
  map("spi1", ps_spi::spi1_base, spi1.registers);
  map("gpio", ps_gpio::base, gpio.registers);
  map("ttc0", ttc::ttc0_base, ttc0.registers);
  map("ttc1", ttc::ttc1_base, ttc1.registers);
  map("xadc", ps_xadc::base, xadc.registers, private_device_size);
  for (const PsDevice& device : devices)
    bus.map(device.module->basename(), device.base, device.size).bind(device.registers.socket);
}

// Software resets one block at a time, by its bit of the SLCR.
void ProcessingSystem::connect_resets() {
  const auto connect = [this](std::uint32_t offset, std::uint32_t bits, auto& device) {
    slcr.on_reset(offset, bits, [&device](bool held) { device.hold_in_reset(held); });
  };
  slcr.on_pull_up([this](unsigned pin, bool on) { gpio.set_pull_up(pin, on); });
  connect(slcr::GPIO_RST_CTRL, 1, gpio);
  connect(slcr::I2C_RST_CTRL, 1, i2c0);
  connect(slcr::I2C_RST_CTRL, 2, i2c1);
  connect(slcr::SPI_RST_CTRL, 1, spi0);
  connect(slcr::SPI_RST_CTRL, 2, spi1);
}

void ProcessingSystem::connect_interrupts() {
  interrupts_ = {{gic::global_timer_id, &global_timer.irq},
                 {gic::private_timer_id, &private_timer.irq},
                 {gic::watchdog_id, &private_timer.watchdog_irq},
                 {uart::uart0_interrupt, &uart0.irq},
                 {uart::uart1_interrupt, &uart1.irq},
                 {ps_xadc::interrupt_id, &xadc.irq},
                 {ps_gpio::interrupt_id, &gpio.irq},
                 {ps_i2c::i2c0_interrupt, &i2c0.irq},
                 {ps_i2c::i2c1_interrupt, &i2c1.irq},
                 {ps_spi::spi0_interrupt, &spi0.irq},
                 {ps_spi::spi1_interrupt, &spi1.irq}};
  for (unsigned n = 0; n < ttc::counter_count; ++n) {
    interrupts_.push_back({ttc::ttc0_interrupt + n, &ttc0.counter(n).irq});
    interrupts_.push_back({ttc::ttc1_interrupt + n, &ttc1.counter(n).irq});
  }
  for (const PsDevice& device : devices) {
    if (device.irq) interrupts_.push_back({device.interrupt, device.irq});
  }
  for (const Interrupt& interrupt : interrupts_) gic.connect(interrupt.id, *interrupt.source);
  cpu.n_irq(gic.n_irq);
}

void ProcessingSystem::connect(std::uint32_t id, vp::Signal<bool>& line) {
  gic.connect(id, line);
  interrupts_.push_back({id, &line});
}

double ProcessingSystem::highest_fclk_hz(double most_hz) const {
  constexpr auto kind = device::ClockKind::fclk;
  const double limit_hz = device::hz_per_mhz * limit_of(chip_.data, kind).value;
  const auto near = planner_.neighbours(std::min(most_hz, limit_hz), kind, plan_);
  return near.below ? near.below->hz : 0;
}

bool ProcessingSystem::clocks_are_made() const {
  return chip_.clocks == ClockMode::made && slcr.programmed_by_boot;
}

void ProcessingSystem::start_clocks() {
  device::ClockWishes wishes;
  wishes.cpu_hz = static_cast<double>(cpu_clk.frequency);
  wishes.ratio_621 = slcr.ratio_621();
  wishes.ethernet = ethernet;
  for (const auto& [number, fclk] : fclks())
    wishes.fclk_hz.push_back(static_cast<double>(fclk->frequency));
  plan_ = planner_.plan(wishes);
  if (clocks_are_made()) {
    slcr.boot_with({plan_.cpu.feedback, plan_.io_feedback, plan_.uart.divisor0});
    cpu_clk.make(plan_.cpu.hz);
  }
  slcr.drive_cpu(cpu_clk.clk);
  slcr.drive_cpu_1x(cpu_1x_clk);
  slcr.limit_fclk(static_cast<std::uint64_t>(device::hz_per_mhz *
                                             limit_of(chip_.data, device::ClockKind::fclk).value));
  drive_fclks();
  slcr.drive_uart_ref(0, uart0_ref_clk);
  slcr.drive_uart_ref(1, uart1_ref_clk);
  slcr.drive_spi_ref(spi_ref_clk);
}

void ProcessingSystem::drive_fclks() {
  auto made = plan_.fclk.begin();
  for (const auto& [number, fclk] : fclks()) {
    std::optional<ps::clock_tree::Dividers> dividers;
    if (clocks_are_made()) {
      fclk->make(made->hz);
      dividers = {slcr::peripheral_source::io_pll, made->divisor0, made->divisor1,
                  fclk->start_hz()};
    }
    slcr.drive_fclk(number, fclk->clk, dividers);
    ++made;
  }
}

ClockSource& ProcessingSystem::fclk_clk(unsigned number) {
  if (number < 2) return number == 0 ? fclk_clk0 : fclk_clk1;
  if (number > 3) throw std::out_of_range("the PS has FCLK_CLK0 to FCLK_CLK3");
  std::unique_ptr<ClockSource>& source = number == 2 ? fclk_clk2_ : fclk_clk3_;
  if (!source) {
    if (!plan_.fclk.empty()) throw std::logic_error("ask for FCLK_CLK2 and 3 in the constructor");
    const vp::HierarchyScope scope(*this);
    source = std::make_unique<ClockSource>(("fclk_clk" + std::to_string(number)).c_str(),
                                           scheduler_, 50'000'000, vp::Source::decision,
                                           "clock of the PL that the design asked for");
  }
  return *source;
}

ps::GpPort& ProcessingSystem::m_axi_gp1(const vp::Clock& aclk) {
  if (m_axi_gp1_) return *m_axi_gp1_;
  using Addresses = vp::Router::Addresses;
  const vp::HierarchyScope scope(*this);
  m_axi_gp1_ = std::make_unique<ps::GpPort>("m_axi_gp1", aclk);
  interconnect.map("m_axi_gp1", gp1_base, gp0_size, Addresses::absolute).bind(m_axi_gp1_->socket);
  slcr.level_shifters.guard(*interconnect.find(gp1_base)->link);
  if (second_core_) {
    second_core_->interconnect.map("m_axi_gp1", gp1_base, gp0_size, Addresses::absolute)
        .bind(interconnect.socket);
  }
  return *m_axi_gp1_;
}

std::map<unsigned, ClockSource*> ProcessingSystem::fclks() {
  std::map<unsigned, ClockSource*> sources{{0, &fclk_clk0}, {1, &fclk_clk1}};
  if (fclk_clk2_) sources[2] = fclk_clk2_.get();
  if (fclk_clk3_) sources[3] = fclk_clk3_.get();
  return sources;
}

std::string ProcessingSystem::device_at(std::uint32_t address) const {
  const vp::Router::Region* region = interconnect.find(address);
  return region ? region->name : std::string{};
}

}  // namespace platform
