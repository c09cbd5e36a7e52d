#include <ttc_registers.h>

#include <ps/ttc/ttc.h>

#include <vp/report.h>

#include <algorithm>
#include <string>
#include <utility>

namespace ps {

namespace {

vp::RegisterBankOptions ttc_options() {
  vp::RegisterBankOptions options;
  options.holes = vp::RegisterBankOptions::Holes::acknowledge;
  options.address_bits = 12;
  return options;
}

std::string numbered(const char* name, unsigned number) {
  return name + std::to_string(number);
}

}  // namespace

TtcCounter::TtcCounter(vp::RegisterBank& bank, unsigned number, const vp::Clock& clock)
    : irq(numbered("irq", number).c_str()),
      wave(numbered("wave", number).c_str()),
      clk_ctrl(bank[ttc::CLK_CTRL_1 + number * ttc::counter_stride]),
      cnt_ctrl(bank[ttc::CNT_CTRL_1 + number * ttc::counter_stride]),
      cnt_val(bank[ttc::CNT_VAL_1 + number * ttc::counter_stride]),
      interval(bank[ttc::INTERVAL_CNT_1 + number * ttc::counter_stride]),
      match_1(bank[ttc::MATCH_1_CNT_1 + number * ttc::counter_stride]),
      match_2(bank[ttc::MATCH_2_CNT_1 + number * ttc::counter_stride]),
      match_3(bank[ttc::MATCH_3_CNT_1 + number * ttc::counter_stride]),
      status(bank[ttc::INT_STS_1 + number * ttc::counter_stride]),
      enable(bank[ttc::INT_EN_1 + number * ttc::counter_stride]),
      clock_(clock),
      running_cnt_ctrl_(cnt_ctrl) {}

bool TtcCounter::running() const {
  return (running_cnt_ctrl_ & ttc::cnt_ctrl::DIS) == 0 &&
         (running_clk_ctrl_ & ttc::clk_ctrl::Source) == 0;
}

std::uint64_t TtcCounter::cycles_per_count() const {
  if ((running_clk_ctrl_ & ttc::clk_ctrl::Prescale_En) == 0) return 1;
  return std::uint64_t{2} << ((running_clk_ctrl_ & ttc::clk_ctrl::Prescale) >>
                              ttc::clk_ctrl::Prescale_shift);
}

std::uint32_t TtcCounter::top() const {
  return (running_cnt_ctrl_ & ttc::cnt_ctrl::INT) != 0 ? interval.value() : 0xFFFFu;
}

// From base_. A counter above its interval runs on to its natural end first.
std::uint64_t TtcCounter::counts_to(std::uint32_t target) const {
  const std::uint64_t period = std::uint64_t{top()} + 1;
  const bool above = base_ > top();
  if (target > top() && !above) return never;
  if ((running_cnt_ctrl_ & ttc::cnt_ctrl::DEC) != 0) {
    if (target < base_) return base_ - target;
    if (target > top()) return never;
    return above ? base_ + period - target : (base_ + period - target - 1) % period + 1;
  }
  if (above)
    return target > base_ ? target - base_ : target <= top() ? 0x1'0000 - base_ + target : never;
  return (target + period - base_ - 1) % period + 1;
}

std::uint32_t TtcCounter::after(std::uint64_t counts) const {
  const std::uint64_t period = std::uint64_t{top()} + 1;
  const bool down = (running_cnt_ctrl_ & ttc::cnt_ctrl::DEC) != 0;
  const std::uint64_t to_wrap = down ? base_ + 1ull : (base_ > top() ? 0x1'0000 : period) - base_;
  if (counts < to_wrap) return static_cast<std::uint32_t>(down ? base_ - counts : base_ + counts);
  const std::uint64_t beyond = (counts - to_wrap) % period;
  return static_cast<std::uint32_t>(down ? top() - beyond : beyond);
}

std::uint32_t TtcCounter::value() const {
  return running() ? after((clock_.cycle() - origin_) / cycles_per_count()) : base_;
}

std::uint32_t TtcCounter::events_within(std::uint64_t counts) const {
  const bool down = (running_cnt_ctrl_ & ttc::cnt_ctrl::DEC) != 0;
  const bool is_interval = (running_cnt_ctrl_ & ttc::cnt_ctrl::INT) != 0;
  std::uint32_t events = 0;
  if (counts_to(down ? top() : 0) <= counts) {
    events |= is_interval ? ttc::event::Interval : ttc::event::Overflow;
  }
  if ((running_cnt_ctrl_ & ttc::cnt_ctrl::Match) != 0) {
    if (counts_to(match_1) <= counts) events |= ttc::event::Match_1;
    if (counts_to(match_2) <= counts) events |= ttc::event::Match_2;
    if (counts_to(match_3) <= counts) events |= ttc::event::Match_3;
  }
  return events;
}

// Between match 1 and the end of the period it is high, or low with Wave_pol.
void TtcCounter::show_wave(std::uint64_t counts) {
  if ((running_cnt_ctrl_ & ttc::cnt_ctrl::Wave_en) != 0) return;
  const std::uint32_t now = after(counts);
  const bool down = (running_cnt_ctrl_ & ttc::cnt_ctrl::DEC) != 0;
  const bool past_match = down ? now <= match_1 : now >= match_1;
  wave = past_match != ((running_cnt_ctrl_ & ttc::cnt_ctrl::Wave_pol) != 0);
}

void TtcCounter::advance() {
  if (!running()) {
    origin_ = clock_.cycle();
    return;
  }
  const std::uint64_t counts = (clock_.cycle() - origin_) / cycles_per_count();
  status.set_bits(events_within(counts));
  show_wave(counts);
  base_ = after(counts);
  origin_ += counts * cycles_per_count();
  update_irq();
}

// An event whose flag is set changes nothing: only those that interrupt, or make the waveform.
std::uint64_t TtcCounter::next_event() const {
  if (!running()) return vp::Clock::never;
  const bool down = (running_cnt_ctrl_ & ttc::cnt_ctrl::DEC) != 0;
  const bool is_interval = (running_cnt_ctrl_ & ttc::cnt_ctrl::INT) != 0;
  const bool matches = (running_cnt_ctrl_ & ttc::cnt_ctrl::Match) != 0;
  const bool draws = (running_cnt_ctrl_ & ttc::cnt_ctrl::Wave_en) == 0;
  const std::uint32_t wanted = enable & ~status;
  std::uint64_t counts = never;
  const auto consider = [&](bool is_wanted, std::uint32_t target) {
    if (is_wanted) counts = std::min(counts, counts_to(target));
  };
  const std::uint32_t wrap = is_interval ? ttc::event::Interval : ttc::event::Overflow;
  consider(draws || (wanted & wrap) != 0, down ? top() : 0);
  consider(draws || (matches && (wanted & ttc::event::Match_1) != 0), match_1);
  consider(matches && (wanted & ttc::event::Match_2) != 0, match_2);
  consider(matches && (wanted & ttc::event::Match_3) != 0, match_3);
  return counts == never ? vp::Clock::never : origin_ + counts * cycles_per_count();
}

void TtcCounter::clk_ctrl_written() {
  running_clk_ctrl_ = clk_ctrl;
  origin_ = clock_.cycle();
}

void TtcCounter::cnt_ctrl_written() {
  const bool restarts = cnt_ctrl.any(ttc::cnt_ctrl::RST);
  cnt_ctrl.clear_bits(ttc::cnt_ctrl::RST);
  const bool was_running = running();
  running_cnt_ctrl_ = cnt_ctrl;
  if (restarts) base_ = cnt_ctrl.any(ttc::cnt_ctrl::DEC) ? top() : 0;
  if (restarts || !was_running) origin_ = clock_.cycle();
  show_wave(0);
}

void TtcCounter::status_read() {
  status = 0;
  update_irq();
}

void TtcCounter::update_irq() {
  irq = (status & enable) != 0;
}

void TtcCounter::reset() {
  running_clk_ctrl_ = clk_ctrl;
  running_cnt_ctrl_ = cnt_ctrl;
  base_ = 0;
  origin_ = clock_.cycle();
  update_irq();
}

Ttc::Ttc(sc_core::sc_module_name name, vp::Clock& cpu_1x_clk)
    : vp::Clocked(name, cpu_1x_clk),
      registers("registers", ttc::registers, ttc_options(), &cpu_1x_clk.scheduler()) {
  for (unsigned n = 0; n < ttc::counter_count; ++n)
    counters_.emplace_back(registers, n, cpu_1x_clk);
  for (TtcCounter& counter : counters_) wire(counter);
  registers.before_access([this] {
    for (TtcCounter& counter : counters_) counter.advance();
  });
}

void Ttc::wire(TtcCounter& counter) {
  counter.cnt_val.computed_by([&counter] { return counter.value(); });
  counter.clk_ctrl.after_write([this, &counter](std::uint32_t) {
    counter.clk_ctrl_written();
    refuse_what_is_missing(counter);
    update();
  });
  counter.cnt_ctrl.after_write([this, &counter](std::uint32_t) {
    counter.cnt_ctrl_written();
    update();
  });
  for (vp::Register* r :
       {&counter.interval, &counter.match_1, &counter.match_2, &counter.match_3}) {
    r->after_write([this](std::uint32_t) { update(); });
  }
  counter.enable.after_write([this, &counter](std::uint32_t) {
    counter.update_irq();
    update();
  });
  counter.status.after_read([this, &counter](std::uint32_t) {
    counter.status_read();
    update();
  });
}

void Ttc::refuse_what_is_missing(const TtcCounter& counter) {
  if (!counter.clk_ctrl.any(ttc::clk_ctrl::Source)) return;
  vp::warn(*this, "/markervp/ttc/external_clock",
           std::string(counter.clk_ctrl.info().name) +
               " selects an external clock, which is not modelled: the counter does not run");
}

void Ttc::update() {
  std::uint64_t next = vp::Clock::never;
  for (const TtcCounter& counter : counters_) next = std::min(next, counter.next_event());
  wake_at(next);
}

void Ttc::edge() {
  sleep();
  for (TtcCounter& counter : counters_) counter.advance();
  update();
}

}  // namespace ps
