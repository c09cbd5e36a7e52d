#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <systemc>
#include <vector>

#include <chip/system/ps_devices.h>
#include <fpga/device/clock_plan.h>
#include <fpga/device/device.h>
#include <ps/cpu/cpu.h>
#include <ps/gic/gic.h>
#include <ps/global_timer/global_timer.h>
#include <ps/gpio/gpio.h>
#include <ps/i2c/i2c.h>
#include <ps/interconnect/interconnect.h>
#include <ps/memory/memory.h>
#include <ps/private_timer/private_timer.h>
#include <ps/slcr/slcr.h>
#include <ps/spi/spi.h>
#include <ps/ttc/ttc.h>
#include <ps/uart/uart.h>
#include <ps/xadc/xadc.h>
#include <vp/clock.h>
#include <vp/parameter.h>
#include <vp/router.h>

namespace platform {

enum class ClockMode {
  made,   ///< clocks have the frequencies that PLLs and dividers give
  exact,  ///< clocks have the frequencies that were asked for
};

/// The chip that a platform is built for: parameters of the platform as a whole.
struct Chip {
  /// Throws vp::InputError for an unknown device.
  Chip();

  vp::Parameter<std::string> name;
  vp::Parameter<ClockMode> clocks;
  const device::Device& data;  ///< what is known of it
};

/// A clock that the PS makes. It starts with the frequency that was asked for, or with what the
/// chip makes of it.
class ClockSource : public sc_core::sc_module {
 public:
  ClockSource(sc_core::sc_module_name name, vp::ClockScheduler& scheduler, std::uint64_t default_hz,
              vp::Source source, const std::string& documentation);

  /// Starts with `hz` instead of what was asked for. Before the simulation.
  void make(double hz);
  std::uint64_t start_hz() const { return start_hz_; }

  vp::Parameter<std::uint64_t> frequency;  ///< asked for
  vp::Clock clk;

 private:
  std::uint64_t start_hz_;
};

/// The processing system of a Zynq-7000 (UG585): the Cortex-A9 cores with their private devices,
/// DDR and on-chip memory, the I/O peripherals, the GP0 and HP0 ports, and the clocks of the PL,
/// which follow the SLCR. Peripherals sleep until software uses them.
class ProcessingSystem : public sc_core::sc_module {
 public:
  /// `chip` must outlive it. `usual_cores`: if the user says nothing else. Throws vp::InputError
  /// for a crystal that the device does not take.
  ProcessingSystem(sc_core::sc_module_name name, vp::ClockScheduler& scheduler, const Chip& chip,
                   std::uint32_t usual_cores = 1);
  ~ProcessingSystem() override;

  ClockSource fclk_clk0;
  ClockSource fclk_clk1;
  ClockSource cpu_clk;
  vp::Clock uart0_ref_clk;
  vp::Clock uart1_ref_clk;
  vp::Clock cpu_1x_clk;
  vp::Clock spi_ref_clk;

  vp::Parameter<bool> poll_elision;
  vp::Parameter<std::uint32_t> cache_guard_steps;
  vp::Parameter<bool> ethernet;
  vp::Parameter<std::uint32_t> cores;
  ps::Cpu cpu;
  vp::Router interconnect;
  ps::RegisterBus private_bus;
  ps::Gic gic;
  ps::GlobalTimer global_timer;
  ps::PrivateTimer private_timer;
  ps::RegisterBus peripheral_bus;
  ps::Slcr slcr;
  ps::Uart uart0;
  ps::Uart uart1;
  ps::Gpio gpio;
  ps::I2c i2c0;
  ps::I2c i2c1;
  ps::Spi spi0;
  ps::Spi spi1;
  ps::Ttc ttc0;
  ps::Ttc ttc1;
  ps::XadcInterface xadc;
  const std::vector<PsDevice> devices;  ///< the other peripherals
  ps::Ocm ocm;
  ps::OcmLow ocm_low;
  ps::Ddr ddr;
  static constexpr std::uint64_t gp0_base = 0x4000'0000, gp0_size = 0x4000'0000;  // UG585 table 4-1
  ps::GpPort m_axi_gp0;
  static constexpr std::uint64_t gp1_base = 0x8000'0000;  ///< as large as GP0's
  vp::Router s_axi_hp0;

  vp::Signal<bool>& fclk_reset0_n;  ///< to the PL

  /// The second core with what belongs to it alone; its accesses to all else go the way of the
  /// first core's.
  struct SecondCore {
    SecondCore(ProcessingSystem& ps, vp::Clock& clock);

    ps::Gic gic;
    ps::PrivateTimer private_timer;
    ps::RegisterBus private_bus;
    vp::Router interconnect;
    ps::Cpu cpu;
  };
  /// Null if `cores` is 1.
  SecondCore* second_core() { return second_core_.get(); }
  const SecondCore* second_core() const { return second_core_.get(); }
  /// The cores that are modelled, by number.
  std::vector<ps::Cpu*> cpus();

  /// FCLK_CLK`number` of the PL. 2 and 3 are made when a design first asks for them, before
  /// start_clocks(). Throws std::out_of_range beyond 3, std::logic_error for one that comes too
  /// late.
  ClockSource& fclk_clk(unsigned number);
  /// Those that there are, by number.
  std::map<unsigned, ClockSource*> fclks();

  /// M_AXI_GP1, on the clock `aclk` of the PL: made when a design first asks for it, in its
  /// constructor.
  ps::GpPort& m_axi_gp1(const vp::Clock& aclk);

  /// An interrupt of the PS and the signal that raises it.
  struct Interrupt {
    std::uint32_t id;
    vp::Signal<bool>* source;
  };
  /// Those of the PS's own devices, by number. The PL's come through IRQ_F2P.
  const std::vector<Interrupt>& interrupts() const { return interrupts_; }
  /// Joins a line of the PL to a private interrupt of CPU 0 (Core0_nFIQ, Core0_nIRQ); before the
  /// simulation.
  void connect(std::uint32_t id, vp::Signal<bool>& line);

  /// In a process that was forked while it ran: FixedMapping::leave_to_parent() of all memory.
  void leave_memory_to_parent();

  /// Starts the clocks, once it is known which ones the design asks for: all FCLK share a PLL.
  void start_clocks();
  /// Of the device, with the crystal.
  const device::ClockPlanner& clock_planner() const { return planner_; }
  /// What the vendor's tool makes of the frequencies that are configured, used or not; FCLK in the
  /// order of fclks(). After start_clocks().
  const device::ClockPlan& clock_plan() const { return plan_; }
  /// The highest clock of the PL up to `most_hz` that the chip has by that plan; 0: none.
  double highest_fclk_hz(double most_hz) const;
  /// Whether the clocks follow that plan.
  bool clocks_are_made() const;

 private:
  void map_private_bus();
  void map_peripherals();
  void connect_interrupts();
  void connect_resets();
  void drive_fclks();
  void place_stacks();
  std::string device_at(std::uint32_t address) const;

  std::vector<Interrupt> interrupts_;
  std::unique_ptr<SecondCore> second_core_;
  std::unique_ptr<ps::StackMemory> stacks_;
  vp::ClockScheduler& scheduler_;
  std::unique_ptr<ClockSource> fclk_clk2_, fclk_clk3_;
  std::unique_ptr<ps::GpPort> m_axi_gp1_;
  const Chip& chip_;
  device::ClockPlanner planner_;
  device::ClockPlan plan_;
};

}  // namespace platform
