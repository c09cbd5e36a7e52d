#include <slcr_registers.h>

#include <ps/slcr/clock_tree.h>
#include <ps/slcr/fclk.h>
#include <vp/clock.h>
#include <vp/clock_scheduler.h>
#include <algorithm>

namespace ps {

namespace {

constexpr std::uint32_t thr_ctrl_offset = slcr::FPGA0_THR_CTRL - slcr::FPGA0_CLK_CTRL;
constexpr std::uint32_t thr_cnt_offset = slcr::FPGA0_THR_CNT - slcr::FPGA0_CLK_CTRL;
constexpr std::uint32_t thr_sta_offset = slcr::FPGA0_THR_STA - slcr::FPGA0_CLK_CTRL;

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

}  // namespace ps
