// Clocks and resets of the SLCR.
#include <slcr_registers.h>

#include <ps/slcr/slcr.h>
#include <vp/clock.h>
#include <vp/clock_scheduler.h>
#include <vp/error.h>
#include <vp/report.h>

namespace ps {

namespace {

constexpr double ps_per_second = 1e12;

void follow(vp::Clock* clock, std::uint64_t hertz) {
  if (clock && clock->frequency_hz() != hertz) clock->set_frequency(hertz);
}

}  // namespace

void Slcr::wire_clocks() {
  registers[slcr::PLL_STATUS].computed_by([this] { return pll_status(); });
  for (Pll& pll : pll_) on_write(pll.ctrl.info().offset, [this, &pll] { pll_written(pll); });
  on_write(slcr::ARM_CLK_CTRL, [this] { update_cpu(); });
  on_write(slcr::UART_CLK_CTRL, [this] { update_uarts(); });
  for (unsigned n = 0; n < slcr::fclk_count; ++n) {
    const std::uint32_t at = n * slcr::fclk_stride;
    on_write(slcr::FPGA0_CLK_CTRL + at, [this, n] { fclk_[n].divide(fclk_source_hz(n)); });
    on_write(slcr::FPGA0_THR_CTRL + at, [this, n] { fclk_[n].throttle_written(); });
    on_write(slcr::FPGA0_THR_CNT + at, [this, n] { fclk_[n].throttle_written(); });
  }
}

// A new feedback divider takes effect with a reset (UG585 25.10.4: bypass, reset, wait for lock).
void Slcr::pll_written(Pll& pll) {
  const bool off = pll.ctrl.any(slcr::pll_ctrl::PLL_RESET | slcr::pll_ctrl::PLL_PWRDWN);
  if (pll.off && !off) {
    pll.feedback = clock_tree::pll_feedback(pll.ctrl);
    const double lock_ps = clock_tree::pll_lock_cycles(pll.cfg) * ps_per_second / ps_clk;
    pll.locked_at_ps = scheduler_.now_ps() + static_cast<std::uint64_t>(lock_ps + 0.5);
  }
  pll.off = off;
  follow_plls();
}

double Slcr::output_hz(const Pll& pll) const {
  if (pll.ctrl.any(slcr::pll_ctrl::PLL_BYPASS_FORCE)) return ps_clk;
  return pll.off ? 0.0 : ps_clk * pll.feedback;
}

clock_tree::PllOutputs Slcr::plls() const {
  return {output_hz(pll_[arm]), output_hz(pll_[ddr]), output_hz(pll_[io])};
}

std::uint32_t Slcr::pll_status() const {
  std::uint32_t status = 0;
  for (unsigned n = 0; n < pll_count; ++n) {
    const Pll& pll = pll_[n];
    const bool locked = !pll.off && scheduler_.now_ps() >= pll.locked_at_ps;
    const bool stable = locked || pll.ctrl.any(slcr::pll_ctrl::PLL_BYPASS_FORCE);
    if (locked) status |= slcr::pll_status::LOCK << n;
    if (stable) status |= slcr::pll_status::STABLE << n;
  }
  return status;
}

double Slcr::peripheral_source_hz(std::uint32_t select) const {
  if (select == slcr::peripheral_source::arm_pll) return output_hz(pll_[arm]);
  if (select == slcr::peripheral_source::ddr_pll) return output_hz(pll_[ddr]);
  return output_hz(pll_[io]);
}

double Slcr::cpu_source_hz() const {
  const std::uint32_t select = clock_tree::source(arm_clk_ctrl_);
  if (select == slcr::cpu_source::ddr_pll) return output_hz(pll_[ddr]);
  if (select == slcr::cpu_source::io_pll) return output_hz(pll_[io]);
  return output_hz(pll_[arm]);
}

double Slcr::fclk_source_hz(unsigned number) const {
  return peripheral_source_hz(fclk_[number].source());
}

std::uint64_t Slcr::programmed_fclk_hz(unsigned number) const {
  return fclk_.at(number).programmed_hz(fclk_source_hz(number));
}

void Slcr::follow_plls() {
  for (unsigned n = 0; n < slcr::fclk_count; ++n) fclk_[n].follow(fclk_source_hz(n));
  update_uarts();
  if (cpu_source_hz() != cpu_source_hz_) update_cpu();
}

void Slcr::update_uarts() {
  const std::uint64_t hertz =
      clock_tree::divided_hz(peripheral_source_hz(clock_tree::source(uart_clk_ctrl_)),
                             clock_tree::divisor0(uart_clk_ctrl_));
  for (unsigned n = 0; n < uart_ref_.size(); ++n) {
    const bool active = uart_clk_ctrl_.any(slcr::uart_clk_ctrl::CLKACT0 << n);
    follow(uart_ref_[n], active ? hertz : 0);
  }
}

void Slcr::update_cpu() {
  const std::uint32_t divisor = clock_tree::divisor0(arm_clk_ctrl_);
  const std::uint64_t hertz = clock_tree::divided_hz(cpu_source_hz(), divisor);
  if (!cpu_) return;
  if (hertz == 0 || !arm_clk_ctrl_.any(slcr::arm_clk_ctrl::CPU_6OR4XCLKACT)) {
    stop("stops the clock of its own processor");
  }
  if (divisor == 1 || divisor == 3) {
    vp::warn(*this, "/markervp/slcr/cpu_divisor",
             "ARM_CLK_CTRL.DIVISOR is " + std::to_string(divisor) +
                 ": 1 and 3 are not allowed while a PLL is the source");
  }
  cpu_source_hz_ = cpu_source_hz();
  follow(cpu_, hertz);
}

Slcr::CpuClocks Slcr::cpu_clocks() const {
  const double fastest = cpu_source_hz();
  const std::uint32_t divisor = clock_tree::divisor0(arm_clk_ctrl_);
  return {clock_tree::divided_hz(fastest, divisor), clock_tree::divided_hz(fastest, divisor, 2),
          clock_tree::divided_hz(fastest, divisor, ratio_621() ? 3 : 2),
          clock_tree::divided_hz(fastest, divisor, ratio_621() ? 6 : 4)};
}

void Slcr::update_fclk_resets() {
  const vp::Register& reset = registers[slcr::FPGA_RST_CTRL];
  fclk_reset0_n = !reset.any(slcr::fpga_rst_ctrl::FPGA0_OUT_RST);
  fclk_reset1_n = !reset.any(slcr::fpga_rst_ctrl::FPGA0_OUT_RST << 1);
  fclk_reset2_n = !reset.any(slcr::fpga_rst_ctrl::FPGA0_OUT_RST << 2);
  fclk_reset3_n = !reset.any(slcr::fpga_rst_ctrl::FPGA0_OUT_RST << 3);
}

void Slcr::update_uart_resets() {
  constexpr std::uint32_t of_uart_0 =
      slcr::uart_rst_ctrl::UART0_CPU1X_RST | slcr::uart_rst_ctrl::UART0_REF_RST;
  const vp::Register& reset = registers[slcr::UART_RST_CTRL];
  uart0_rst = reset.any(of_uart_0);
  uart1_rst = reset.any(of_uart_0 << 1);
}

void Slcr::cpu_reset_written() {
  const vp::Register& reset = registers[slcr::A9_CPU_RST_CTRL];
  if (reset.any(slcr::a9_cpu_rst_ctrl::A9_RST0)) stop("resets its own processor");
  if (reset.any(slcr::a9_cpu_rst_ctrl::A9_CLKSTOP0)) stop("stops the clock of its own processor");
}

// There is no boot code to go on with.
void Slcr::stop(const std::string& what) const {
  throw vp::ProtocolError("the program " + what + " through " + name() +
                          ": on the chip it ends here, and so does the run");
}

}  // namespace ps
