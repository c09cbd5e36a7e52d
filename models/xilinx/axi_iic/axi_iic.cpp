#include <xilinx/axi_iic/axi_iic.h>

#include <xilinx/common/axi_lite_ip.h>

namespace xilinx {

namespace {

using namespace axi_iic;

// Periods of SCL.
constexpr std::uint64_t start_periods = 1, byte_periods = 9, stop_periods = 1;

std::uint32_t less_one(std::size_t count) {
  return count == 0 ? 0 : static_cast<std::uint32_t>(count - 1);
}

}  // namespace

AxiIic::AxiIic(sc_core::sc_module_name name, vp::Clock& s_axi_aclk, const AxiIicBuild& build)
    : Clocked(name, s_axi_aclk),
      Ip(&s_axi_aclk),
      iic_freq("iic_freq", build.iic_freq, vp::Unit::frequency, {1'000, 1'000'000},
               vp::Source::published, "build option SCL Clock Frequency (PG090)"),
      gpo_width("gpo_width", build.gpo_width, vp::Unit::none, {1, 8}, vp::Source::published,
                "build option General Purpose Output Width (PG090)"),
      s_axi("s_axi", axi_iic::registers, axi_lite_options(axi_iic::address_bits),
            &s_axi_aclk.scheduler()),
      gpo("gpo", gpo_width),
      gie_(s_axi[GIE]),
      isr_(s_axi[ISR]),
      ier_(s_axi[IER]),
      cr_(s_axi[CR]),
      pirq_(s_axi[RX_FIFO_PIRQ]) {
  s_axi[GPO].set_reset_value(build.gpo_default & ((1u << gpo_width) - 1));
  wire();
  gpo = static_cast<std::uint8_t>(s_axi[GPO].value());
}

// A public report has 398 LUT and 363 FF (7z020).
vp::IpEstimate AxiIic::own_estimate() const {
  vp::IpEstimate e = axi_estimate("axi_iic", 398, 363, 0);
  e.active_clocks = [this] { return clocks_per_access * accesses(s_axi); };
  return e;
}

void AxiIic::wire() {
  for (vp::Register* r : {&gie_, &isr_, &ier_, &pirq_}) {
    r->after_write([this](std::uint32_t) { update(); });
  }
  s_axi[SOFTR].after_write([this](std::uint32_t word) {
    if (word == reset_key) reset();
  });
  cr_.after_write([this](std::uint32_t) { control_written(); });
  s_axi[SR].computed_by([this] { return status(); });
  s_axi[TX_FIFO].after_write([this](std::uint32_t word) {
    if (tx_.size() < fifo_depth) tx_.push_back(word & 0x3FF);
    update();
  });
  vp::Register& rx_fifo = s_axi[RX_FIFO];
  rx_fifo.computed_by([this] { return rx_.empty() ? 0u : std::uint32_t{rx_.front()}; });
  rx_fifo.after_read([this](std::uint32_t) {
    if (!rx_.empty()) rx_.pop_front();
    isr_.clear_bits(event::rx_full);
    update();
  });
  s_axi[TX_FIFO_OCY].computed_by([this] { return less_one(tx_.size()); });
  s_axi[RX_FIFO_OCY].computed_by([this] { return less_one(rx_.size()); });
  vp::Register& outputs = s_axi[GPO];
  outputs.set_writable((1u << gpo_width) - 1);
  outputs.after_write(
      [this, &outputs](std::uint32_t) { gpo = static_cast<std::uint8_t>(outputs.value()); });
}

void AxiIic::reset() {
  bus.stop();
  s_axi.reset();
  tx_.clear();
  rx_.clear();
  state_ = State::idle;
  busy_ = dynamic_ = wants_stop_ = false;
  to_come_ = 0;
  done_at_ = vp::Clock::never;
  gpo = static_cast<std::uint8_t>(s_axi[GPO].value());
  update();
}

void AxiIic::before_end_of_elaboration() {
  Clocked::before_end_of_elaboration();
  if (s_axi_aresetn.bound()) s_axi_aresetn.signal()->attach(*this);
}

void AxiIic::on_change(vp::SignalBase&, std::uint32_t) {
  reset();
  s_axi.hold_in_reset(!s_axi_aresetn);
}

// MSMS going low is a stop after the byte under way, or after the next one while SCL waits for it.
void AxiIic::control_written() {
  if (cr_.any(cr::TX_FIFO_Reset)) tx_.clear();
  if (busy_ && !dynamic_ && !cr_.any(cr::MSMS)) wants_stop_ = true;
  update();
}

std::uint64_t AxiIic::periods(std::uint64_t scl) const {
  return scl * (clock().frequency_hz() / iic_freq);
}

void AxiIic::take(State state, std::uint64_t scl_periods) {
  state_ = state;
  done_at_ = clock().cycle() + periods(scl_periods);
}

// What comes next, from rest or where the bus waited.
void AxiIic::proceed() {
  if (!cr_.any(cr::EN) || (state_ != State::idle && state_ != State::waiting)) return;
  const bool has_start = !tx_.empty() && (tx_.front() & tx_word::Start) != 0;
  if (has_start) {
    dynamic_ = true;
    return begin(tx_.front());
  }
  if (!busy_) {
    if (cr_.any(cr::MSMS) && !tx_.empty() && !wants_stop_) {
      dynamic_ = false;
      begin(tx_.front());
    }
    return;
  }
  if (!dynamic_ && cr_.any(cr::RSTA) && !tx_.empty()) {
    cr_.clear_bits(cr::RSTA);
    return begin(tx_.front());
  }
  if (reads_) {
    if (wants_stop_ && !dynamic_) return stop();
    if (rx_.size() <= pirq_) take(State::receiving, byte_periods);
    return;
  }
  if (!tx_.empty()) {
    word_ = tx_.front();
    tx_.pop_front();
    take(State::sending, byte_periods);
  }
}

void AxiIic::begin(std::uint32_t word) {
  tx_.pop_front();
  word_ = word;
  busy_ = true;
  if (dynamic_) cr_.set_bits(cr::MSMS);
  take(State::address, start_periods + byte_periods);
}

void AxiIic::address_sent() {
  reads_ = (word_ & 1) != 0;
  if (!bus.start(word_ >> 1 & 0x7F, reads_)) {
    isr_.set_bits(event::tx_error);
    return stop();
  }
  to_come_ = 0;
  wants_stop_ = !dynamic_ && !cr_.any(cr::MSMS);
  if (reads_ && dynamic_ && !tx_.empty()) {  // the second word says how many, and that it stops
    to_come_ = tx_.front() & 0xFF;
    wants_stop_ = (tx_.front() & tx_word::Stop) != 0;
    tx_.pop_front();
  }
  state_ = State::waiting;
}

void AxiIic::byte_sent() {
  if (!bus.write(static_cast<std::uint8_t>(word_))) {
    isr_.set_bits(event::tx_error);
    return stop();
  }
  state_ = State::waiting;
  if ((word_ & tx_word::Stop) != 0 || (wants_stop_ && tx_.empty())) stop();
}

// The last byte is not acknowledged, which the core's own error flag shows, too.
void AxiIic::byte_received() {
  rx_.push_back(bus.read());
  state_ = State::waiting;
  if (dynamic_) {
    if (to_come_ > 0 && --to_come_ == 0) {
      isr_.set_bits(event::tx_error);
      if (wants_stop_) stop();
    }
  } else if (cr_.any(cr::TXAK)) {
    isr_.set_bits(event::tx_error);
    if (wants_stop_ || !cr_.any(cr::MSMS)) stop();
  }
}

void AxiIic::stop() {
  bus.stop();
  if (dynamic_) cr_.clear_bits(cr::MSMS);
  take(State::stopping, stop_periods);
}

void AxiIic::edge() {
  sleep();
  if (done_at_ <= clock().cycle()) {
    done_at_ = vp::Clock::never;
    const State done = state_;
    if (done == State::address) address_sent();
    if (done == State::sending) byte_sent();
    if (done == State::receiving) byte_received();
    if (done == State::stopping) {
      state_ = State::idle;
      busy_ = wants_stop_ = dynamic_ = false;
    }
  }
  update();
}

std::uint32_t AxiIic::status() const {
  std::uint32_t bits = 0;
  if (busy_) bits |= sr::BB;
  if (tx_.size() == fifo_depth) bits |= sr::TX_FIFO_Full;
  if (rx_.size() == fifo_depth) bits |= sr::RX_FIFO_Full;
  if (rx_.empty()) bits |= sr::RX_FIFO_Empty;
  if (tx_.empty()) bits |= sr::TX_FIFO_Empty;
  return bits;
}

// All events are levels: a bit comes back while its cause lasts.
void AxiIic::update() {
  proceed();
  const bool wants_byte = busy_ && state_ == State::waiting && !reads_ && tx_.empty();
  std::uint32_t events = event::not_addressed;
  if (wants_byte) events |= event::tx_empty;
  if (rx_.size() == pirq_ + 1) events |= event::rx_full;
  if (!busy_) events |= event::not_busy;
  if (tx_.size() <= fifo_depth / 2) events |= event::tx_half_empty;
  isr_.set_bits(events);
  iic2intc_irpt = gie_.any(gie_Enable) && (isr_ & ier_) != 0;
  wake_at(done_at_);
}

}  // namespace xilinx
