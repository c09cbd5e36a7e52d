#include <uart_registers.h>

#include <ps/uart/uart.h>
#include <vp/report.h>
#include <vp/text.h>
#include <algorithm>

namespace ps {

namespace {

constexpr std::uint32_t prescaler = 8;  // MR.CLKS

vp::RegisterBankOptions uart_options() {
  vp::RegisterBankOptions options;
  options.holes = vp::RegisterBankOptions::Holes::acknowledge;
  options.address_bits = 12;
  return options;
}

}  // namespace

Uart::Uart(sc_core::sc_module_name name, vp::Clock& uart_ref_clk)
    : vp::Clocked(name, uart_ref_clk),
      enabled(
          "enabled", true, vp::Source::decision,
          "as Vivado enables it for a board: false leaves it out of xparameters.h, and what comes "
          "behind it has its number"),
      registers("registers", uart::registers, uart_options(), &uart_ref_clk.scheduler()),
      cr_(registers[uart::CR]),
      mr_(registers[uart::MR]),
      imr_(registers[uart::IMR]),
      isr_(registers[uart::ISR]),
      baudgen_(registers[uart::BAUDGEN]),
      rxtout_(registers[uart::RXTOUT]),
      rxwm_(registers[uart::RXWM]),
      baud_div_(registers[uart::BAUD_DIV]),
      flow_delay_(registers[uart::FLOW_DELAY]),
      tx_fifo_level_(registers[uart::TX_FIFO_LEVEL]),
      accepted_baud_div_(baud_div_) {
  wire();
}

void Uart::wire() {
  cr_.after_write([this](std::uint32_t word) { control_written(word); });
  registers[uart::IER].after_write([this](std::uint32_t word) {
    imr_.set_bits(word & uart::event::all);
    update();
  });
  registers[uart::IDR].after_write([this](std::uint32_t word) {
    imr_.clear_bits(word & uart::event::all);
    update();
  });
  isr_.after_write([this](std::uint32_t) { update(); });
  registers[uart::SR].computed_by([this] { return status(); });
  vp::Register& fifo = registers[uart::FIFO];
  fifo.computed_by([this] { return rx_fifo_.empty() ? 0u : std::uint32_t{rx_fifo_.front()}; });
  fifo.after_read([this](std::uint32_t) { fifo_read(); });
  fifo.after_write([this](std::uint32_t word) { fifo_written(word); });
  baudgen_.after_write([this](std::uint32_t) { update(); });
  baud_div_.after_write([this](std::uint32_t word) {
    if ((word & 0xFF) >= uart::smallest_baud_div) accepted_baud_div_ = baud_div_;
    baud_div_ = accepted_baud_div_;
  });
  vp::Register& modem_status = registers[uart::MODEMSR];
  registers[uart::MODEMCR].after_write([&modem_status](std::uint32_t word) {
    modem_status = (word & uart::modemcr::FCM) != 0 ? uart::modemsr::FCMS : 0;
  });
}

void Uart::end_of_elaboration() {
  Clocked::end_of_elaboration();
  if (rst.bound()) rst.signal()->attach(*this);
}

void Uart::on_change(vp::SignalBase&, std::uint32_t) {
  if (rst) reset();
  registers.hold_in_reset(rst);
}

void Uart::reset() {
  registers.reset();
  accepted_baud_div_ = baud_div_;
  tx_fifo_.clear();
  rx_fifo_.clear();
  line_.clear();
  tx_ = rx_ = {};
  timeout_at_ = vp::Clock::never;
  update();
}

// ---- what software does

void Uart::control_written(std::uint32_t word) {
  if ((word & uart::cr::TXRES) != 0) {
    tx_fifo_.clear();
    tx_ = {};
  }
  if ((word & uart::cr::RXRES) != 0) rx_fifo_.clear();
  if ((word & (uart::cr::TORST | uart::cr::RXRES)) != 0) restart_timeout();
  cr_.clear_bits(uart::cr::TXRES | uart::cr::RXRES | uart::cr::TORST);
  update();
}

void Uart::fifo_written(std::uint32_t word) {
  if (mode() == uart::mr::CHMODE_remote_loopback) {
    vp::warn(*this, "/markervp/uart/remote_loopback",
             vp::hex(word) + " written to FIFO in remote loopback mode: it is not sent");
    return;
  }
  put(static_cast<std::uint8_t>(word));
  update();
}

void Uart::fifo_read() {
  if (rx_fifo_.empty()) {
    vp::warn(*this, "/markervp/uart/read_empty",
             "FIFO read, but the receive FIFO is empty: look at SR.REMPTY first");
    return;
  }
  rx_fifo_.pop_front();
  if (rx_fifo_.empty()) raise(uart::event::REMPTY);
  update();
}

// ---- the line

std::uint32_t Uart::mode() const {
  return mr_ & uart::mr::CHMODE;
}

bool Uart::transmitter_on() const {
  return cr_.any(uart::cr::TXEN) && !cr_.any(uart::cr::TXDIS);
}

bool Uart::receiver_on() const {
  return cr_.any(uart::cr::RXEN) && !cr_.any(uart::cr::RXDIS);
}

std::uint64_t Uart::cycles_per_bit() const {
  const std::uint64_t divisor = std::uint64_t{baudgen_} * (baud_div_ + 1u);
  return divisor * (mr_.any(uart::mr::CLKS) ? prescaler : 1);
}

// Start bit, data, parity, stop bits, in halves of a bit.
std::uint64_t Uart::half_bits() const {
  const std::uint32_t length = (mr_ & uart::mr::CHRL) >> uart::mr::CHRL_shift;
  const std::uint32_t data = length < 2 ? 8 : 9 - length;
  const std::uint32_t parity = mr_.any(uart::mr::PAR_none) ? 0 : 1;
  const std::uint32_t stop = (mr_ & uart::mr::NBSTOP) >> uart::mr::NBSTOP_shift;
  return 2 * (1 + data + parity) + 2 + std::min(stop, 2u);
}

std::uint64_t Uart::frame_cycles() const {
  return cycles_per_bit() * half_bits() / 2;
}

void Uart::receive(std::string_view bytes) {
  for (const char c : bytes) line_.push_back(static_cast<std::uint8_t>(c));
  update();
}

void Uart::put(std::uint8_t byte) {
  if (tx_fifo_.size() == uart::fifo_depth) {
    ++lost;
    raise(uart::event::TOVR);
    vp::warn(*this, "/markervp/uart/overflow",
             "FIFO written while it is full: the byte is lost; look at SR.TFUL first");
    return;
  }
  tx_fifo_.push_back(byte);
  const std::size_t fill = tx_fifo_.size();
  if (fill == tx_fifo_level_) raise(uart::event::TTRIG);
  if (fill == uart::fifo_depth - 1) raise(uart::event::TNFUL);
  if (fill == uart::fifo_depth) raise(uart::event::TFUL);
}

void Uart::take(std::uint8_t byte) {
  if (!receiver_on() || rx_fifo_.size() == uart::fifo_depth) {
    ++lost;
    if (receiver_on()) raise(uart::event::ROVR);
    return;
  }
  ++received;
  rx_fifo_.push_back(byte);
  if (rx_fifo_.size() == rxwm_) raise(uart::event::RTRIG);
  if (rx_fifo_.size() == uart::fifo_depth) raise(uart::event::RFUL);
}

void Uart::end_of_transmission() {
  tx_.done_at = vp::Clock::never;
  if (mode() == uart::mr::CHMODE_local_loopback) return take(tx_.byte);
  ++transmitted;
  const char text = static_cast<char>(tx_.byte);
  console.write(&text, 1);
  if (on_transmit) on_transmit(tx_.byte);
}

void Uart::end_of_reception() {
  rx_.done_at = vp::Clock::never;
  const std::uint32_t now = mode();
  if (now == uart::mr::CHMODE_normal || now == uart::mr::CHMODE_echo) take(rx_.byte);
  if (now == uart::mr::CHMODE_echo || now == uart::mr::CHMODE_remote_loopback) put(rx_.byte);
}

void Uart::start_shifters() {
  const std::uint64_t length = frame_cycles();
  if (length == 0) return;
  const std::uint64_t now = clock().cycle();
  if (!tx_.busy() && !tx_fifo_.empty() && transmitter_on()) {
    tx_ = {tx_fifo_.front(), now + length};
    tx_fifo_.pop_front();
    if (tx_fifo_.empty()) raise(uart::event::TEMPTY);
    if (mode() == uart::mr::CHMODE_local_loopback) restart_timeout();  // the receiver sees it begin
  }
  if (!rx_.busy() && !line_.empty()) {
    rx_ = {line_.front(), now + length};
    line_.pop_front();
    restart_timeout();
  }
}

// A counter of 4 × RXTOUT + 3 bits starts again with each start bit (UG585 19.2.6).
void Uart::restart_timeout() {
  timeout_at_ =
      rxtout_ == 0 ? vp::Clock::never : clock().cycle() + (4ull * rxtout_ + 3) * cycles_per_bit();
}

// ---- status and interrupt

void Uart::raise(std::uint32_t events) {
  isr_.set_bits(events);
}

std::uint32_t Uart::status() const {
  std::uint32_t bits = 0;
  const auto show = [&bits](std::uint32_t bit, bool on) { bits |= on ? bit : 0; };
  const std::size_t rx = rx_fifo_.size(), tx = tx_fifo_.size();
  show(uart::sr::RTRIG, rxwm_ != 0 && rx >= rxwm_);
  show(uart::sr::REMPTY, rx == 0);
  show(uart::sr::RFUL, rx == uart::fifo_depth);
  show(uart::sr::TEMPTY, tx == 0);
  show(uart::sr::TFUL, tx == uart::fifo_depth);
  show(uart::sr::RACTIVE, rx_.busy());
  show(uart::sr::TACTIVE, tx_.busy());
  show(uart::sr::FDELT, flow_delay_ >= 4 && rx >= flow_delay_);
  show(uart::sr::TTRIG, tx_fifo_level_ != 0 && tx >= tx_fifo_level_);
  show(uart::sr::TNFUL, tx == uart::fifo_depth - 1);
  return bits;
}

void Uart::update() {
  start_shifters();
  irq = (isr_ & imr_) != 0;
  wake_at(std::min({tx_.done_at, rx_.done_at, timeout_at_}));
}

void Uart::edge() {
  const std::uint64_t now = clock().cycle();
  if (tx_.done_at <= now) end_of_transmission();
  if (rx_.done_at <= now) end_of_reception();
  if (timeout_at_ <= now) {
    timeout_at_ = vp::Clock::never;
    if (receiver_on()) raise(uart::event::TIMEOUT);
  }
  update();
  sleep();
}

}  // namespace ps
