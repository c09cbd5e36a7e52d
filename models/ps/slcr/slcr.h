#pragma once

#include <ps/slcr/slcr_clocks.h>
#include <vp/mm_link.h>
#include <vp/parameter.h>
#include <vp/register_bank.h>
#include <vp/signal.h>
#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <systemc>
#include <vector>

namespace vp {
class Clock;
class ClockScheduler;
}  // namespace vp

namespace ps {

/// The level shifters between PS and PL, as a guard on the links that cross them: it watches only
/// while an access would hang, so that it costs nothing otherwise.
class LevelShifters : public vp::MmObserver {
 public:
  /// Accesses through `link` need the shifters: before the simulation starts.
  void guard(vp::MmLink& link) { links_.push_back(&link); }
  /// The links are bound: begins to watch.
  void start();
  /// Value of LVL_SHFTR_EN.
  void set(std::uint32_t value);
  bool on() const { return on_; }

 private:
  /// Throws vp::ProtocolError: on the chip nothing answers, and the bus hangs.
  void before(vp::MmLink& link, tlm::tlm_generic_payload& payload, sc_core::sc_time&) override;

  std::vector<vp::MmLink*> links_;
  std::uint32_t value_ = 0;
  bool on_ = true;  ///< not observable
  bool started_ = false;
};

/// The system level control registers of the Zynq-7000: PLLs, clocks, resets, level shifters, and
/// the lock before them. Clocks that it drives follow the registers at the time of the write.
///
/// The boot code has run at time 0 (`programmed_by_boot`): the PLLs have the usual values, the
/// resets to the PL are released, the level shifters are on, and the dividers give the frequencies
/// that the driven clocks start with. Where no dividers give one exactly, the registers show the
/// nearest, and the clock keeps its own frequency until software writes the register or its PLL.
/// Without boot code the registers are as after reset, and so are the clocks.
class Slcr : public sc_core::sc_module {
 public:
  static constexpr std::uint32_t xc7z020_idcode = 0x0372'7093;

  /// `default_idcode`: of the chip.
  Slcr(sc_core::sc_module_name name, vp::ClockScheduler& scheduler,
       std::uint32_t default_idcode = xc7z020_idcode);
  const char* kind() const override { return "ps::Slcr"; }

  vp::RegisterBank registers;  ///< at 0xF800_0000

  vp::Parameter<bool> programmed_by_boot;
  vp::Parameter<double> ps_clk;
  vp::Parameter<std::uint32_t> boot_mode;
  vp::Parameter<std::uint32_t> idcode;
  vp::Parameter<std::uint64_t> mio_pull_ups;

  vp::Signal<bool> fclk_reset0_n, fclk_reset1_n, fclk_reset2_n, fclk_reset3_n;  ///< to the PL
  vp::Signal<bool> uart0_rst, uart1_rst;                                        ///< active high
  LevelShifters level_shifters;

  /// Boot code for other PLLs than those of a ZedBoard: before drive_fclk() and the like. Without
  /// effect unless boot code has run.
  struct BootClocks {
    std::uint32_t arm_feedback, io_feedback, uart_divisor;
  };
  void boot_with(const BootClocks& clocks);

  // What the registers drive: to be said before the simulation starts, FCLK 0 to 3 and UART 0 and
  // 1 by number.
  /// `chosen`: the dividers that boot code wrote; none: those that come nearest.
  void drive_fclk(unsigned number, vp::Clock& clock,
                  std::optional<clock_tree::Dividers> chosen = std::nullopt);
  void drive_uart_ref(unsigned number, vp::Clock& clock);
  void drive_cpu(vp::Clock& clock);
  /// CPU_1x, which most peripherals have: a sixth (6:2:1) or a fourth (4:2:1) of the CPU's clock.
  /// After drive_cpu().
  void drive_cpu_1x(vp::Clock& clock);
  /// The reference clock of both SPI controllers.
  void drive_spi_ref(vp::Clock& clock);
  /// Calls `hold` when software asserts (true) or releases the reset in `bits` of the register at
  /// `offset`.
  void on_reset(std::uint32_t offset, std::uint32_t bits, std::function<void(bool)> hold);

  /// Calls `change` for each MIO pin now, and whenever software switches its pull-up.
  void on_pull_up(const std::function<void(unsigned pin, bool on)>& change);

  /// Outputs of the PLLs now, Hz. 0: powered down or in reset, and not bypassed. A PLL that has not
  /// locked yet counts as locked.
  clock_tree::PllOutputs plls() const;

  /// What the registers give FCLK_CLK`number`, throttle aside, Hz.
  std::uint64_t programmed_fclk_hz(unsigned number) const;
  /// The highest clock that the chip gives to the PL: software that asks for more is warned of.
  void limit_fclk(std::uint64_t hz) { highest_fclk_hz_ = hz; }

  /// CPU clocks of the ratio that CLK_621_TRUE selects, Hz.
  struct CpuClocks {
    std::uint64_t cpu_6x4x, cpu_3x2x, cpu_2x, cpu_1x;
  };
  CpuClocks cpu_clocks() const;
  /// Whether the CPU clocks have the ratio 6:2:1; else 4:2:1.
  bool ratio_621() const { return clk_621_true_ != 0; }

 private:
  struct Pll {
    vp::Register& ctrl;
    vp::Register& cfg;
    std::uint32_t feedback;  ///< divider in effect
    bool off = false;        ///< in reset or powered down
    std::uint64_t locked_at_ps = 0;
  };
  enum PllNumber { arm, ddr, io, pll_count };

  void start_of_simulation() override { level_shifters.start(); }

  void program_as_boot_code();
  void wire();
  void wire_clocks();
  void on_write(std::uint32_t offset, std::function<void()> effect);
  void written(vp::Register& target, std::uint32_t word);
  bool is_secure(const vp::Register& target) const;
  void apply_locks();
  void lock_written(std::uint32_t word, std::uint32_t key, bool lock);

  void pll_written(Pll& pll);
  void fclk_written(unsigned number);
  double output_hz(const Pll& pll) const;
  std::uint32_t pll_status() const;
  double peripheral_source_hz(std::uint32_t select) const;
  double cpu_source_hz() const;
  double fclk_source_hz(unsigned number) const;
  void follow_plls();
  void update_uarts();
  void update_cpu();
  void update_cpu_1x();
  void update_spi();
  void resets_written(std::uint32_t offset);
  void update_fclk_resets();
  void update_uart_resets();
  void dci_written();
  void cpu_reset_written();
  [[noreturn]] void stop(const std::string& what) const;

  vp::ClockScheduler& scheduler_;
  std::map<std::uint32_t, std::function<void()>> effects_;  ///< by offset
  bool locked_ = true;
  vp::Register& arm_clk_ctrl_;
  vp::Register& uart_clk_ctrl_;
  vp::Register& clk_621_true_;
  vp::Register& dci_ctrl_;
  std::array<Pll, pll_count> pll_;
  std::deque<Fclk> fclk_;
  std::array<vp::Clock*, 2> uart_ref_{};
  vp::Clock* cpu_ = nullptr;
  vp::Clock* cpu_1x_ = nullptr;
  vp::Clock* spi_ref_ = nullptr;
  /// Resets of peripherals.
  struct Reset {
    std::uint32_t offset, bits;
    std::function<void(bool)> hold;
    bool held;
  };
  std::vector<Reset> resets_;
  std::uint64_t highest_fclk_hz_ = ~std::uint64_t{0};
  double cpu_source_hz_ = 0.0;
  bool dci_reset_ = false;      ///< RESET of DDRIOB_DCI_CTRL as it was
  bool dci_was_reset_ = false;  ///< it has fallen since power-on
};

}  // namespace ps
