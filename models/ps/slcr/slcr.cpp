#include <slcr_registers.h>

#include <ps/slcr/slcr.h>

#include <vp/clock.h>
#include <vp/clock_scheduler.h>
#include <vp/error.h>
#include <vp/report.h>
#include <vp/text.h>

#include <string>

namespace ps {

namespace {

constexpr std::uint32_t ocm_last_high = 0x8;  // UG585 chapter 29: 192 KiB are at address 0
constexpr std::uint32_t dci_calibrated =
    slcr::ddriob_dci_status::LOCK | slcr::ddriob_dci_status::DONE;

/// What the boot code of a ZedBoard leaves behind (its FSBL's tables), clocks of the PL aside.
struct BootValue {
  std::uint32_t offset, value;
};
constexpr BootValue boot_values[] = {
    {slcr::ARM_PLL_CFG, 0x000FA220},
    {slcr::DDR_PLL_CFG, 0x0012C220},
    {slcr::IO_PLL_CFG, 0x001452C0},
    {slcr::ARM_PLL_CTRL, 0x00028008},
    {slcr::DDR_PLL_CTRL, 0x00020008},
    {slcr::IO_PLL_CTRL, 0x0001E008},
    {slcr::ARM_CLK_CTRL, 0x1F000200},
    {slcr::DDR_CLK_CTRL, 0x0C200003},
    {slcr::UART_CLK_CTRL, 0x00001403},  // 1000 MHz / 20, both UARTs
    {slcr::SPI_CLK_CTRL, 0x00000603},   // 1000 MHz / 6, both SPIs
    {slcr::FPGA_RST_CTRL, 0x00000000},
    {slcr::LVL_SHFTR_EN, slcr::lvl_shftr_en::all},
    {slcr::OCM_CFG, ocm_last_high},
    {slcr::DDRIOB_DCI_CTRL, 0x00000823},
    {slcr::DDRIOB_DCI_STATUS, dci_calibrated},
};

vp::RegisterBankOptions slcr_options() {
  vp::RegisterBankOptions options;
  options.holes = vp::RegisterBankOptions::Holes::acknowledge;
  options.address_bits = slcr::address_bits;
  return options;
}

}  // namespace

void LevelShifters::start() {
  started_ = true;
  if (on_) return;
  for (vp::MmLink* link : links_) link->add_observer(*this);
}

void LevelShifters::set(std::uint32_t value) {
  value_ = value;
  const bool on = (value & slcr::lvl_shftr_en::USER_LVL_SHFTR_EN) == slcr::lvl_shftr_en::all;
  if (on == on_) return;
  on_ = on;
  if (!started_) return;
  for (vp::MmLink* link : links_) {
    if (on) {
      link->remove_observer(*this);
    } else {
      link->add_observer(*this);
    }
  }
}

void LevelShifters::before(vp::MmLink& link, tlm::tlm_generic_payload& payload, sc_core::sc_time&) {
  throw vp::ProtocolError(std::string("bus hang: ") +
                          (payload.is_read() ? "read of " : "write to ") +
                          vp::hex(payload.get_address()) + " through " + link.name() +
                          ", but the level shifters between PS and PL are off (LVL_SHFTR_EN is " +
                          vp::hex(value_) + "): write 0xF to it first");
}

Slcr::Slcr(sc_core::sc_module_name name, vp::ClockScheduler& scheduler,
           std::uint32_t default_idcode)
    : sc_module(name),
      registers("registers", slcr::registers, slcr_options(), &scheduler),
      programmed_by_boot(
          "programmed_by_boot", true, vp::Source::published,
          "clocks, resets and level shifters are set up at time 0, as a ZedBoard's "
          "boot code does; off: as after reset, whatever frequencies are configured"),
      ps_clk("ps_clk", 100e6 / 3, vp::Unit::frequency, {1e6, 1e9}, vp::Source::published,
             "crystal before the PLLs (ZedBoard: 33.3333 MHz)"),
      boot_mode("boot_mode", 5, vp::Unit::address, {0, 0x1F}, vp::Source::published,
                "value of BOOT_MODE: 5 boots from the SD card"),
      idcode("idcode", default_idcode, vp::Unit::address, vp::Source::published,
             "value of PSS_IDCODE: that of the device, revision 0 (UG585 appendix B.28)"),
      mio_pull_ups("mio_pull_ups", slcr::mio_pin::pull_ups_at_reset, vp::Unit::address,
                   {0, (std::uint64_t{1} << slcr::mio_pins) - 1}, vp::Source::published,
                   "MIO pins whose pull-up the boot code leaves on, a bit a pin: those of reset "
                   "(UG585, table 6-4)"),
      fclk_reset0_n("fclk_reset0_n", 1, programmed_by_boot),
      fclk_reset1_n("fclk_reset1_n", 1, programmed_by_boot),
      fclk_reset2_n("fclk_reset2_n", 1, programmed_by_boot),
      fclk_reset3_n("fclk_reset3_n", 1, programmed_by_boot),
      uart0_rst("uart0_rst"),
      uart1_rst("uart1_rst"),
      scheduler_(scheduler),
      arm_clk_ctrl_(registers[slcr::ARM_CLK_CTRL]),
      uart_clk_ctrl_(registers[slcr::UART_CLK_CTRL]),
      clk_621_true_(registers[slcr::CLK_621_TRUE]),
      dci_ctrl_(registers[slcr::DDRIOB_DCI_CTRL]),
      pll_{{{registers[slcr::ARM_PLL_CTRL], registers[slcr::ARM_PLL_CFG], 0},
            {registers[slcr::DDR_PLL_CTRL], registers[slcr::DDR_PLL_CFG], 0},
            {registers[slcr::IO_PLL_CTRL], registers[slcr::IO_PLL_CFG], 0}}} {
  for (unsigned n = 0; n < slcr::fclk_count; ++n) {
    const std::string fclk = "fclk" + std::to_string(n);
    fclk_.emplace_back(fclk.c_str(), registers, slcr::FPGA0_CLK_CTRL + n * slcr::fclk_stride);
  }
  registers[slcr::BOOT_MODE] = boot_mode;
  registers[slcr::PSS_IDCODE] = idcode;
  if (programmed_by_boot) program_as_boot_code();
  for (Pll& pll : pll_) pll.feedback = clock_tree::pll_feedback(pll.ctrl);
  level_shifters.set(registers[slcr::LVL_SHFTR_EN]);
  wire();
  wire_clocks();
  apply_locks();
}

void Slcr::program_as_boot_code() {
  for (const BootValue& boot : boot_values) registers[boot.offset] = boot.value;
  for (unsigned pin = 0; pin < slcr::mio_pins; ++pin) {
    vp::Register& control = registers[slcr::MIO_PIN(pin)];
    control.clear_bits(slcr::mio_pin::PULLUP);
    if ((mio_pull_ups >> pin & 1) != 0) control.set_bits(slcr::mio_pin::PULLUP);
  }
  dci_reset_ = dci_was_reset_ = true;
}

void Slcr::boot_with(const BootClocks& clocks) {
  if (!programmed_by_boot) return;
  const auto program = [this](PllNumber number, std::uint32_t feedback) {
    Pll& pll = pll_[number];
    pll.ctrl = clock_tree::pll_ctrl_of(feedback);
    pll.cfg = clock_tree::pll_cfg_of(feedback);
    pll.feedback = feedback;
  };
  program(arm, clocks.arm_feedback);
  program(io, clocks.io_feedback);
  uart_clk_ctrl_.clear_bits(slcr::clk_ctrl::DIVISOR0);
  uart_clk_ctrl_.set_bits(clocks.uart_divisor << slcr::clk_ctrl::DIVISOR0_shift);
}

void Slcr::drive_fclk(unsigned number, vp::Clock& clock,
                      std::optional<clock_tree::Dividers> chosen) {
  Fclk& fclk = fclk_.at(number);
  if (!programmed_by_boot) {
    fclk.drive(clock, fclk_source_hz(number));
    return fclk.divide(fclk_source_hz(number));
  }
  vp::Register& clk_ctrl = registers[slcr::FPGA0_CLK_CTRL + number * slcr::fclk_stride];
  const clock_tree::Dividers nearest =
      chosen ? *chosen : clock_tree::nearest_dividers(clock.frequency_hz(), plls());
  clk_ctrl = nearest.clk_ctrl();
  fclk.drive(clock, fclk_source_hz(number));
  if (nearest.hertz != clock.frequency_hz()) {
    vp::info(*this, "/markervp/slcr/inexact",
             std::string(clock.name()) + " starts with " + std::to_string(clock.frequency_hz()) +
                 " Hz; the nearest that the dividers give is " + std::to_string(nearest.hertz) +
                 " Hz: it has that once software writes " + clk_ctrl.info().name);
  }
}

void Slcr::drive_uart_ref(unsigned number, vp::Clock& clock) {
  uart_ref_.at(number) = &clock;
  update_uarts();
}

void Slcr::drive_cpu(vp::Clock& clock) {
  cpu_ = &clock;
  cpu_source_hz_ = cpu_source_hz();
  if (!programmed_by_boot) return update_cpu();
  const std::uint32_t divisor =
      clock_tree::nearest_cpu_divisor(clock.frequency_hz(), cpu_source_hz());
  arm_clk_ctrl_.clear_bits(slcr::clk_ctrl::DIVISOR0);
  arm_clk_ctrl_.set_bits(divisor << slcr::clk_ctrl::DIVISOR0_shift);
}

void Slcr::drive_cpu_1x(vp::Clock& clock) {
  cpu_1x_ = &clock;
  update_cpu_1x();
}

void Slcr::drive_spi_ref(vp::Clock& clock) {
  spi_ref_ = &clock;
  update_spi();
}

void Slcr::on_reset(std::uint32_t offset, std::uint32_t bits, std::function<void(bool)> hold) {
  resets_.push_back({offset, bits, std::move(hold), false});
  on_write(offset, [this, offset] { resets_written(offset); });
}

void Slcr::resets_written(std::uint32_t offset) {
  for (Reset& reset : resets_) {
    const bool held = registers[offset].any(reset.bits);
    if (reset.offset != offset || reset.held == held) continue;
    reset.held = held;
    reset.hold(held);
  }
}

// ---- pins

// MIO_PIN_nn.PULLUP is 1 at reset, but for the pins that choose how to boot (UG585, appendix B.28).
void Slcr::on_pull_up(const std::function<void(unsigned pin, bool on)>& change) {
  for (unsigned pin = 0; pin < slcr::mio_pins; ++pin) {
    const vp::Register& control = registers[slcr::MIO_PIN(pin)];
    const auto tell = [change, pin, &control] { change(pin, control.any(slcr::mio_pin::PULLUP)); };
    on_write(slcr::MIO_PIN(pin), tell);
    tell();
  }
}

// ---- the lock

void Slcr::wire() {
  for (const vp::RegisterInfo& info : slcr::registers) {
    vp::Register& target = registers[info.offset];
    target.after_write([this, &target](std::uint32_t word) { written(target, word); });
  }
  registers[slcr::SLCR_LOCK].after_write(
      [this](std::uint32_t word) { lock_written(word, slcr::lock_key, true); });
  registers[slcr::SLCR_UNLOCK].after_write(
      [this](std::uint32_t word) { lock_written(word, slcr::unlock_key, false); });
  registers[slcr::SLCR_LOCKSTA].computed_by([this] { return locked_ ? 1u : 0u; });

  on_write(slcr::SCL, [this] { apply_locks(); });
  on_write(slcr::FPGA_RST_CTRL, [this] { update_fclk_resets(); });
  on_write(slcr::UART_RST_CTRL, [this] { update_uart_resets(); });
  on_write(slcr::LVL_SHFTR_EN, [this] { level_shifters.set(registers[slcr::LVL_SHFTR_EN]); });
  on_write(slcr::PSS_RST_CTRL, [this] {
    if (registers[slcr::PSS_RST_CTRL] != 0) stop("resets the processing system (PSS_RST_CTRL)");
  });
  on_write(slcr::A9_CPU_RST_CTRL, [this] { cpu_reset_written(); });
  on_write(slcr::DDRIOB_DCI_CTRL, [this] { dci_written(); });
}

// ---- the impedances of the DDR buffers

// UG585, DDR IOB Impedance Calibration: RESET is taken from 1 to 0 and back, ENABLE is set, DONE is
// waited for. Decision: the calibration takes no time, since no manual says how long it takes.
void Slcr::dci_written() {
  using namespace slcr::ddriob_dci_ctrl;
  const bool reset = dci_ctrl_.any(RESET);
  dci_was_reset_ = dci_was_reset_ || (dci_reset_ && !reset);
  dci_reset_ = reset;
  const bool calibrated =
      dci_was_reset_ && (dci_ctrl_ & (RESET | ENABLE | UPDATE_CONTROL)) == (RESET | ENABLE);
  registers[slcr::DDRIOB_DCI_STATUS] = calibrated ? dci_calibrated : 0;
}

void Slcr::on_write(std::uint32_t offset, std::function<void()> effect) {
  effects_[offset] = std::move(effect);
}

bool Slcr::is_secure(const vp::Register& target) const {
  const std::uint32_t offset = target.info().offset;
  return offset == slcr::SCL || offset == slcr::PSS_RST_CTRL || offset == slcr::APU_CTRL ||
         offset == slcr::WDT_CLK_SEL;
}

void Slcr::apply_locks() {
  const bool secure_locked = registers[slcr::SCL] != 0;
  for (const vp::RegisterInfo& info : slcr::registers) {
    vp::Register& target = registers[info.offset];
    const bool frozen = locked_ || (secure_locked && is_secure(target));
    target.set_writable(frozen ? 0 : info.writable);
  }
}

void Slcr::lock_written(std::uint32_t word, std::uint32_t key, bool lock) {
  if ((word & 0xFFFF) != key) {
    vp::warn(*this, "/markervp/slcr/key",
             vp::hex(word) + " written to " + (lock ? "SLCR_LOCK" : "SLCR_UNLOCK") +
                 ": no effect; the key is " + vp::hex(key));
    return;
  }
  locked_ = lock;
  apply_locks();
}

void Slcr::written(vp::Register& target, std::uint32_t word) {
  if (target.info().access == vp::Access::read_only) return;  // the bank warns
  if (locked_ ||
      (registers[slcr::SCL] != 0 && is_secure(target) && target.info().offset != slcr::SCL)) {
    vp::warn(*this, "/markervp/slcr/locked",
             vp::hex(word) + " written to " + target.info().name + " is ignored: " +
                 (locked_ ? "the registers are locked; write 0xDF0D to SLCR_UNLOCK first"
                          : "SCL locks it until power-on"));
    return;
  }
  const auto effect = effects_.find(target.info().offset);
  if (effect != effects_.end()) effect->second();
}

}  // namespace ps
