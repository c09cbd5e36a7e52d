// Clocks and resets of the SLCR.
#include <slcr_registers.h>

#include <ps/slcr/slcr.h>
#include <vp/clock.h>
#include <vp/clock_scheduler.h>
#include <vp/error.h>
#include <vp/report.h>

#include <algorithm>

namespace ps::clock_tree {

namespace {

constexpr std::uint32_t largest_divisor = 63;

/// UG585 table 25-6, by the largest feedback divider of a row.
struct LoopFilter {
  std::uint32_t to, charge_pump, resistor, lock_count;
};
constexpr std::uint32_t largest_feedback = 66;
constexpr LoopFilter loop_filters[] = {
    {13, 2, 6, 750},  {14, 2, 6, 700},  {15, 2, 6, 650},  {16, 2, 10, 625},
    {17, 2, 10, 575}, {18, 2, 10, 550}, {19, 2, 10, 525}, {20, 2, 12, 500},
    {21, 2, 12, 475}, {22, 2, 12, 450}, {23, 2, 12, 425}, {25, 2, 12, 400},
    {26, 2, 12, 375}, {28, 2, 12, 350}, {30, 2, 12, 325}, {33, 2, 2, 300},
    {36, 2, 2, 275},  {40, 2, 2, 250},  {47, 3, 12, 250}, {largest_feedback, 2, 4, 250}};

std::uint64_t distance(std::uint64_t a, std::uint64_t b) {
  return a > b ? a - b : b - a;
}

}  // namespace

std::uint32_t pll_feedback(std::uint32_t pll_ctrl) {
  return (pll_ctrl & slcr::pll_ctrl::PLL_FDIV) >> slcr::pll_ctrl::PLL_FDIV_shift;
}
std::uint32_t pll_lock_cycles(std::uint32_t pll_cfg) {
  return (pll_cfg & slcr::pll_cfg::LOCK_CNT) >> slcr::pll_cfg::LOCK_CNT_shift;
}
std::uint32_t pll_ctrl_of(std::uint32_t feedback) {
  return feedback << slcr::pll_ctrl::PLL_FDIV_shift | slcr::pll_ctrl::PLL_BYPASS_QUAL;
}
std::uint32_t pll_cfg_of(std::uint32_t feedback) {
  constexpr std::uint32_t res_shift = 4, cp_shift = 8;
  for (const LoopFilter& row : loop_filters) {
    if (feedback > row.to) continue;
    return row.lock_count << slcr::pll_cfg::LOCK_CNT_shift | row.charge_pump << cp_shift |
           row.resistor << res_shift;
  }
  return pll_cfg_of(largest_feedback);
}
std::uint32_t source(std::uint32_t clk_ctrl) {
  return (clk_ctrl & slcr::clk_ctrl::SRCSEL) >> slcr::clk_ctrl::SRCSEL_shift;
}
std::uint32_t divisor0(std::uint32_t clk_ctrl) {
  return (clk_ctrl & slcr::clk_ctrl::DIVISOR0) >> slcr::clk_ctrl::DIVISOR0_shift;
}
std::uint32_t divisor1(std::uint32_t clk_ctrl) {
  return (clk_ctrl & slcr::clk_ctrl::DIVISOR1) >> slcr::clk_ctrl::DIVISOR1_shift;
}

std::uint64_t divided_hz(double source_hz, std::uint32_t divisor0, std::uint32_t divisor1) {
  const std::uint32_t divisor =
      std::max<std::uint32_t>(divisor0, 1) * std::max<std::uint32_t>(divisor1, 1);
  return static_cast<std::uint64_t>(source_hz / divisor + 0.5);
}

std::uint32_t Dividers::clk_ctrl() const {
  return source << slcr::clk_ctrl::SRCSEL_shift | divisor0 << slcr::clk_ctrl::DIVISOR0_shift |
         divisor1 << slcr::clk_ctrl::DIVISOR1_shift;
}

Dividers nearest_dividers(std::uint64_t hertz, const PllOutputs& plls) {
  const struct {
    std::uint32_t select;
    double hertz;
  } sources[] = {{slcr::peripheral_source::io_pll, plls.io},
                 {slcr::peripheral_source::arm_pll, plls.arm},
                 {slcr::peripheral_source::ddr_pll, plls.ddr}};
  Dividers best{slcr::peripheral_source::io_pll, 1, 1, divided_hz(plls.io, 1)};
  for (const auto& source : sources) {
    // By growing difference of the divisors, so that the first of equals is the one wanted.
    for (std::uint32_t difference = 0; difference < largest_divisor; ++difference) {
      for (std::uint32_t small = 1; small + difference <= largest_divisor; ++small) {
        const std::uint64_t given = divided_hz(source.hertz, small + difference, small);
        if (distance(given, hertz) < distance(best.hertz, hertz)) {
          best = {source.select, small + difference, small, given};
        }
      }
    }
  }
  return best;
}

std::uint32_t nearest_cpu_divisor(std::uint64_t hertz, double source_hz) {
  std::uint32_t best = 2;
  for (std::uint32_t divisor = 4; divisor <= largest_divisor; ++divisor) {
    if (distance(divided_hz(source_hz, divisor), hertz) <
        distance(divided_hz(source_hz, best), hertz)) {
      best = divisor;
    }
  }
  return best;
}

}  // namespace ps::clock_tree

namespace ps {

namespace {

constexpr std::uint32_t thr_ctrl_offset = slcr::FPGA0_THR_CTRL - slcr::FPGA0_CLK_CTRL;
constexpr std::uint32_t thr_cnt_offset = slcr::FPGA0_THR_CNT - slcr::FPGA0_CLK_CTRL;
constexpr std::uint32_t thr_sta_offset = slcr::FPGA0_THR_STA - slcr::FPGA0_CLK_CTRL;

constexpr double ps_per_second = 1e12;

void follow(vp::Clock* clock, std::uint64_t hertz) {
  if (clock && clock->frequency_hz() != hertz) clock->set_frequency(hertz);
}

}  // namespace

Fclk::Fclk(sc_core::sc_module_name name, vp::RegisterBank& bank, std::uint32_t offset)
    : sc_module(name),
      clk_ctrl_(bank[offset]),
      thr_ctrl_(bank[offset + thr_ctrl_offset]),
      thr_cnt_(bank[offset + thr_cnt_offset]) {
  bank[offset + thr_sta_offset].computed_by([this] { return status(); });
  SC_HAS_PROCESS(Fclk);
  SC_METHOD(end_of_pulses);
  sensitive << last_pulse_;
  dont_initialize();
}

void Fclk::drive(vp::Clock& clock, double source_hz) {
  clock_ = &clock;
  source_hz_ = source_hz;
  hertz_ = clock.frequency_hz();
}

std::uint32_t Fclk::source() const {
  return clock_tree::source(clk_ctrl_);
}

std::uint64_t Fclk::programmed_hz(double source_hz) const {
  return clock_tree::divided_hz(source_hz, clock_tree::divisor0(clk_ctrl_),
                                clock_tree::divisor1(clk_ctrl_));
}

void Fclk::follow(double source_hz) {
  if (source_hz != source_hz_) divide(source_hz);
}

void Fclk::divide(double source_hz) {
  source_hz_ = source_hz;
  hertz_ = programmed_hz(source_hz);
  apply();
}

bool Fclk::throttled() const {
  return (thr_cnt_ & slcr::thr::LAST_CNT) != 0;
}

void Fclk::throttle_written() {
  const bool start = thr_ctrl_.any(slcr::thr_ctrl::CPU_START);
  if (throttled() && !throttled_ && clock_) first_cycle_ = clock_->cycle();
  throttled_ = throttled();
  if (!throttled_) {
    pulsing_ = false;
    last_pulse_.cancel();
  } else if (start && !started_) {
    start_pulses();
  }
  started_ = start;
  apply();
}

// The first pulse is the next edge.
void Fclk::start_pulses() {
  if (!clock_ || hertz_ == 0) return;
  if (clock_->frequency_hz() != hertz_) clock_->set_frequency(hertz_);
  pulsing_ = true;
  first_cycle_ = clock_->cycle();
  const std::uint64_t last = clock_->time_of(first_cycle_ + (thr_cnt_ & slcr::thr::LAST_CNT));
  last_pulse_.cancel();
  last_pulse_.notify(vp::from_ps(last - vp::to_ps(sc_core::sc_time_stamp())));
  clock_->scheduler().forget_horizon();  // the program that wrote this may be ahead of SystemC
}

void Fclk::end_of_pulses() {
  pulsing_ = false;
  apply();
}

void Fclk::apply() {
  if (!clock_) return;
  const std::uint64_t hertz = throttled() && !pulsing_ ? 0 : hertz_;
  if (clock_->frequency_hz() != hertz) clock_->set_frequency(hertz);
}

std::uint32_t Fclk::status() const {
  if (!throttled()) return slcr::thr::RUNNING;
  const std::uint64_t given = clock_ ? clock_->cycle() - first_cycle_ : 0;
  const auto shown = static_cast<std::uint32_t>(std::min<std::uint64_t>(given, 0xFFFF));
  return shown | (pulsing_ ? slcr::thr::RUNNING : 0);
}

void Slcr::wire_clocks() {
  registers[slcr::PLL_STATUS].computed_by([this] { return pll_status(); });
  for (Pll& pll : pll_) on_write(pll.ctrl.info().offset, [this, &pll] { pll_written(pll); });
  on_write(slcr::ARM_CLK_CTRL, [this] { update_cpu(); });
  on_write(slcr::UART_CLK_CTRL, [this] { update_uarts(); });
  on_write(slcr::SPI_CLK_CTRL, [this] { update_spi(); });
  on_write(slcr::CLK_621_TRUE, [this] { update_cpu_1x(); });
  for (unsigned n = 0; n < slcr::fclk_count; ++n) {
    const std::uint32_t at = n * slcr::fclk_stride;
    on_write(slcr::FPGA0_CLK_CTRL + at, [this, n] { fclk_written(n); });
    on_write(slcr::FPGA0_THR_CTRL + at, [this, n] { fclk_[n].throttle_written(); });
    on_write(slcr::FPGA0_THR_CNT + at, [this, n] { fclk_[n].throttle_written(); });
  }
}

void Slcr::fclk_written(unsigned number) {
  const double source_hz = fclk_source_hz(number);
  Fclk& fclk = fclk_[number];
  fclk.divide(source_hz);
  if (!fclk.driven()) return;
  const std::uint64_t hertz = fclk.programmed_hz(source_hz);
  const std::string clock = "FCLK_CLK" + std::to_string(number);
  if (hertz > highest_fclk_hz_) {
    vp::warn(*this, "/markervp/slcr/fclk_too_fast",
             clock + " is set to " + std::to_string(hertz) +
                 " Hz, more than the chip gives to the PL (" + std::to_string(highest_fclk_hz_) +
                 " Hz): divide by more");
  } else if (hertz == 0) {
    vp::warn(*this, "/markervp/slcr/fclk_without_source",
             clock + " has a PLL as its source that is off: the clock is stopped");
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
  update_spi();
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
  update_cpu_1x();
}

void Slcr::update_cpu_1x() {
  if (cpu_) follow(cpu_1x_, cpu_->frequency_hz() / (ratio_621() ? 6 : 4));
}

void Slcr::update_spi() {
  const vp::Register& control = registers[slcr::SPI_CLK_CTRL];
  constexpr std::uint32_t both = slcr::uart_clk_ctrl::CLKACT0 | slcr::uart_clk_ctrl::CLKACT0 << 1;
  const std::uint64_t hertz = clock_tree::divided_hz(
      peripheral_source_hz(clock_tree::source(control)), clock_tree::divisor0(control));
  follow(spi_ref_, control.any(both) ? hertz : 0);
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
