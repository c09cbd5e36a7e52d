#include <ps_i2c_registers.h>

#include <ps/i2c/i2c.h>
#include <vp/report.h>

namespace ps {

namespace {

// Periods of SCL.
constexpr std::uint64_t start_periods = 1, byte_periods = 9;

vp::RegisterBankOptions i2c_options() {
  vp::RegisterBankOptions options;
  options.holes = vp::RegisterBankOptions::Holes::acknowledge;
  options.address_bits = 12;
  return options;
}

}  // namespace

I2c::I2c(sc_core::sc_module_name name, vp::Clock& cpu_1x_clk)
    : vp::Clocked(name, cpu_1x_clk),
      registers("registers", ps_i2c::registers, i2c_options(), &cpu_1x_clk.scheduler()),
      cr_(registers[ps_i2c::CR]),
      addr_(registers[ps_i2c::ADDR]),
      isr_(registers[ps_i2c::ISR]),
      trans_size_(registers[ps_i2c::TRANS_SIZE]),
      slv_pause_(registers[ps_i2c::SLV_PAUSE]),
      imr_(registers[ps_i2c::IMR]) {
  wire();
}

void I2c::wire() {
  cr_.after_write([this](std::uint32_t word) { control_written(word); });
  registers[ps_i2c::SR].computed_by([this] { return status(); });
  addr_.after_write([this](std::uint32_t) { address_written(); });
  vp::Register& data = registers[ps_i2c::DATA];
  data.computed_by([this] { return fifo_.empty() ? 0u : std::uint32_t{fifo_.front()}; });
  data.after_write([this](std::uint32_t word) { data_written(word); });
  data.after_read([this](std::uint32_t) { data_read(); });
  isr_.after_write([this](std::uint32_t) { update(); });
  trans_size_.computed_by([this] {
    const bool receives = cr_.any(ps_i2c::cr::RW);
    return receives ? trans_size_.value() : static_cast<std::uint32_t>(fifo_.size());
  });
  trans_size_.after_write([this](std::uint32_t) { size_written(); });
  registers[ps_i2c::IER].after_write([this](std::uint32_t word) {
    imr_.clear_bits(word);
    update();
  });
  registers[ps_i2c::IDR].after_write([this](std::uint32_t word) {
    imr_.set_bits(word & ps_i2c::event::all);
    update();
  });
}

void I2c::hold_in_reset(bool hold) {
  registers.hold_in_reset(hold);
  if (!hold) return;
  bus.stop();
  state_ = State::idle;
  fifo_.clear();
  overflow_ = false;
  done_at_ = vp::Clock::never;
  update();
}

// ---- what software does

void I2c::control_written(std::uint32_t word) {
  if ((word & ps_i2c::cr::CLR_FIFO) != 0) {
    cr_.clear_bits(ps_i2c::cr::CLR_FIFO);
    fifo_.clear();
    overflow_ = false;
    if (!(cr_.any(ps_i2c::cr::MS) && cr_.any(ps_i2c::cr::RW))) trans_size_ = 0;
  }
  const bool held = state_ == State::held_sending || state_ == State::held_receiving;
  if (held && !cr_.any(ps_i2c::cr::HOLD)) finish();
  if (monitors_ && state_ == State::address && !cr_.any(ps_i2c::cr::SLVMON)) finish();
  update();
}

// Each write is a start; with the bus held it is a repeated one.
void I2c::address_written() {
  if (!cr_.any(ps_i2c::cr::MS)) return;  // its own address, as a slave
  const bool free =
      state_ == State::idle || state_ == State::held_sending || state_ == State::held_receiving;
  if (!free) {
    vp::warn(*this, "/markervp/i2c/busy",
             "ADDR written during a transfer: ignored; wait for ISR.COMP or SR.BA = 0 first");
    return;
  }
  start_transfer();
  update();
}

void I2c::start_transfer() {
  reads_ = cr_.any(ps_i2c::cr::RW);
  monitors_ = cr_.any(ps_i2c::cr::SLVMON);
  take(State::address, start_periods + byte_periods);
}

void I2c::data_written(std::uint32_t word) {
  if (fifo_.size() == ps_i2c::fifo_depth) {
    raise(ps_i2c::event::TX_OVF);
    vp::warn(*this, "/markervp/i2c/overflow",
             "DATA written while the FIFO is full: the byte is lost; write 16 − TRANS_SIZE bytes");
    return update();
  }
  fifo_.push_back(static_cast<std::uint8_t>(word));
  if (state_ == State::held_sending) send_next();
  update();
}

void I2c::data_read() {
  if (fifo_.empty()) {
    raise(ps_i2c::event::RX_UNF);
    return update();
  }
  fifo_.pop_front();
  if (state_ == State::full) receive_next();
  update();
}

void I2c::size_written() {
  if (state_ == State::held_receiving && trans_size_ != 0) receive_next();
  update();
}

// ---- the bus

std::uint64_t I2c::scl_cycles() const {
  const std::uint64_t a = (cr_ & ps_i2c::cr::DIV_A) >> ps_i2c::cr::DIV_A_shift;
  const std::uint64_t b = (cr_ & ps_i2c::cr::DIV_B) >> ps_i2c::cr::DIV_B_shift;
  return ps_i2c::scl_divisor * (a + 1) * (b + 1);
}

void I2c::take(State state, std::uint64_t scl_periods) {
  state_ = state;
  done_at_ = clock().cycle() + scl_periods * scl_cycles();
}

void I2c::rest(State held) {
  state_ = held;
  done_at_ = vp::Clock::never;
}

void I2c::finish() {
  bus.stop();
  rest(State::idle);
}

// COMP does not come: drivers see an absent device by NACK.
void I2c::refused() {
  raise(ps_i2c::event::NACK);
  if (cr_.any(ps_i2c::cr::HOLD)) {
    rest(State::held_sending);
  } else {
    finish();
  }
}

void I2c::address_sent() {
  const bool answers = bus.start(addr_, reads_);
  if (cr_.any(ps_i2c::cr::SLVMON)) {
    bus.stop();
    if (!answers) return take(State::address, byte_periods * (slv_pause_ + 1) + start_periods);
    cr_.clear_bits(ps_i2c::cr::SLVMON);
    raise(ps_i2c::event::SLV_RDY);
    return rest(State::idle);
  }
  if (!answers) return refused();
  if (reads_) {
    receive_next();
  } else {
    send_next();
  }
}

void I2c::send_next() {
  if (!fifo_.empty()) {
    shifted_ = fifo_.front();
    return take(State::sending, byte_periods);
  }
  raise(ps_i2c::event::COMP);
  if (cr_.any(ps_i2c::cr::HOLD)) {
    rest(State::held_sending);
  } else {
    finish();
  }
}

// A byte leaves the FIFO when it was acknowledged: until then TRANS_SIZE counts it.
void I2c::byte_sent() {
  if (!bus.write(shifted_)) return refused();
  if (!fifo_.empty()) fifo_.pop_front();
  if (fifo_.size() == ps_i2c::fifo_depth - ps_i2c::data_level) raise(ps_i2c::event::DATA);
  send_next();
}

// With HOLD a full FIFO stretches SCL; without it the byte is lost.
void I2c::receive_next() {
  if (trans_size_ == 0) {
    raise(ps_i2c::event::COMP);
    if (cr_.any(ps_i2c::cr::HOLD)) return rest(State::held_receiving);
    return finish();
  }
  if (fifo_.size() == ps_i2c::fifo_depth && cr_.any(ps_i2c::cr::HOLD)) return rest(State::full);
  take(State::receiving, byte_periods);
}

void I2c::byte_received() {
  const std::uint8_t byte = bus.read();
  trans_size_ = trans_size_ - 1;
  if (fifo_.size() == ps_i2c::fifo_depth) {
    overflow_ = true;
    raise(ps_i2c::event::RX_OVF);
  } else {
    fifo_.push_back(byte);
  }
  if (fifo_.size() == ps_i2c::data_level || trans_size_ == 0) raise(ps_i2c::event::DATA);
  receive_next();
}

void I2c::edge() {
  sleep();
  if (done_at_ <= clock().cycle()) {
    done_at_ = vp::Clock::never;
    if (state_ == State::address) {
      address_sent();
    } else if (state_ == State::sending) {
      byte_sent();
    } else if (state_ == State::receiving) {
      byte_received();
    }
  }
  update();
}

// ---- status and interrupt

std::uint32_t I2c::status() const {
  const bool receives = cr_.any(ps_i2c::cr::RW);
  std::uint32_t bits = 0;
  if (!fifo_.empty()) bits |= receives ? ps_i2c::sr::RXDV : ps_i2c::sr::TXDV;
  if (overflow_) bits |= ps_i2c::sr::RXOVF;
  if (state_ != State::idle) bits |= ps_i2c::sr::BA;
  return bits;
}

void I2c::raise(std::uint32_t events) {
  isr_.set_bits(events);
}

void I2c::update() {
  irq = (isr_ & ~imr_) != 0;
  busy = state_ != State::idle;
  wake_at(done_at_);
}

}  // namespace ps
