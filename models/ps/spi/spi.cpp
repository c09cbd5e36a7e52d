#include <ps_spi_registers.h>

#include <ps/spi/spi.h>

#include <vp/report.h>

#include <string>
#include <utility>

namespace ps {

namespace {

constexpr std::uint8_t nothing = 0xFF;  // the pull-up of MISO

vp::RegisterBankOptions spi_options() {
  vp::RegisterBankOptions options;
  options.holes = vp::RegisterBankOptions::Holes::acknowledge;
  options.address_bits = 12;
  return options;
}

}  // namespace

Spi::Spi(sc_core::sc_module_name name, vp::Clock& spi_ref_clk)
    : vp::Clocked(name, spi_ref_clk),
      registers("registers", ps_spi::registers, spi_options(), &spi_ref_clk.scheduler()),
      cr_(registers[ps_spi::CR]),
      isr_(registers[ps_spi::ISR]),
      imr_(registers[ps_spi::IMR]),
      enable_(registers[ps_spi::ENABLE]),
      tx_thres_(registers[ps_spi::TX_THRES]),
      rx_thres_(registers[ps_spi::RX_THRES]) {
  wire();
}

void Spi::wire() {
  isr_.computed_by([this] { return status(); });
  isr_.after_write([this](std::uint32_t) { update(); });
  cr_.after_write([this](std::uint32_t word) { control_written(word); });
  enable_.after_write([this](std::uint32_t) { enable_written(); });
  registers[ps_spi::IER].after_write([this](std::uint32_t word) {
    imr_.set_bits(word & ps_spi::event::all);
    update();
  });
  registers[ps_spi::IDR].after_write([this](std::uint32_t word) {
    imr_.clear_bits(word);
    update();
  });
  registers[ps_spi::TXD].after_write([this](std::uint32_t word) { send(word); });
  vp::Register& rxd = registers[ps_spi::RXD];
  rxd.computed_by([this] { return rx_.empty() ? 0u : std::uint32_t{rx_.front()}; });
  rxd.after_read([this](std::uint32_t) { receive(); });
  for (vp::Register* r : {&tx_thres_, &rx_thres_}) {
    r->after_write([this](std::uint32_t) { update(); });
  }
}

void Spi::attach(unsigned slave, std::shared_ptr<board::SpiDevice> device) {
  devices_.at(slave) = std::move(device);
}

void Spi::hold_in_reset(bool hold) {
  registers.hold_in_reset(hold);
  if (!hold) return;
  tx_.clear();
  rx_.clear();
  started_ = false;
  done_at_ = vp::Clock::never;
  select(none);
  update();
}

// ---- what software does

void Spi::control_written(std::uint32_t word) {
  cr_.clear_bits(ps_spi::cr::MANSTRT);
  if ((word & ps_spi::cr::MANSTRT) != 0) started_ = true;
  if (enable_ != 0 && cr_.any(ps_spi::cr::SSFORCE)) select(chosen());
  update();
}

// Assumed: what was not sent yet is dropped, since no driver does it.
void Spi::enable_written() {
  if (enable_ == 0) {
    tx_.clear();
    started_ = false;
    done_at_ = vp::Clock::never;
    select(none);
  } else if (cr_.any(ps_spi::cr::SSFORCE)) {
    select(chosen());
  }
  update();
}

void Spi::send(std::uint32_t word) {
  if (tx_.size() == ps_spi::fifo_depth) {
    vp::warn(*this, "/markervp/spi/overflow",
             "TXD written while the FIFO is full: the byte is lost; look at ISR.TXFULL first");
    return;
  }
  tx_.push_back(static_cast<std::uint8_t>(word));
  update();
}

void Spi::receive() {
  if (!rx_.empty()) rx_.pop_front();
  update();
}

// ---- the bus

unsigned Spi::chosen() const {
  const std::uint32_t selects = (cr_ & ps_spi::cr::SSCTRL) >> ps_spi::cr::SSCTRL_shift;
  for (unsigned slave = 0; slave < slave_count; ++slave) {
    if ((selects >> slave & 1) == 0) return slave;
  }
  return none;
}

void Spi::select(unsigned slave) {
  if (slave == selected_) return;
  if (selected_ != none && devices_[selected_]) devices_[selected_]->select(false);
  selected_ = slave;
  ss_n = static_cast<std::uint8_t>(slave == none ? 7 : 7 & ~(1u << slave));
  if (slave == none) return;
  if (devices_[slave]) {
    devices_[slave]->select(true);
  } else if (!std::exchange(warned_, true)) {
    vp::warn(*this, "/markervp/spi/no_device",
             "slave " + std::to_string(slave) +
                 " is selected, but no device is attached: bytes read 0xFF");
  }
}

void Spi::start() {
  const bool may_run =
      enable_ != 0 && cr_.any(ps_spi::cr::MSTREN) && (started_ || !cr_.any(ps_spi::cr::MANSTRTEN));
  if (done_at_ != vp::Clock::never || !may_run || tx_.empty()) return;
  if (!cr_.any(ps_spi::cr::SSFORCE)) select(chosen());
  const std::uint64_t divisor = std::uint64_t{2}
                                << ((cr_ & ps_spi::cr::PRESC) >> ps_spi::cr::PRESC_shift);
  done_at_ = clock().cycle() + 8 * divisor;
}

// A byte leaves the FIFO when its reply has come: TXOW then means that all replies are there.
void Spi::exchange() {
  const bool has_device = selected_ != none && devices_[selected_];
  const std::uint8_t reply = has_device ? devices_[selected_]->exchange(tx_.front()) : nothing;
  tx_.pop_front();
  if (rx_.size() == ps_spi::fifo_depth) {
    isr_.set_bits(ps_spi::event::RXOVR);
  } else {
    rx_.push_back(reply);
  }
  if (!tx_.empty()) return;
  started_ = false;
  if (!cr_.any(ps_spi::cr::SSFORCE)) select(none);
}

void Spi::edge() {
  sleep();
  if (done_at_ <= clock().cycle()) {
    done_at_ = vp::Clock::never;
    exchange();
  }
  update();
}

// ---- status and interrupt

std::uint32_t Spi::status() const {
  std::uint32_t bits = isr_ & ps_spi::event::cleared_by_writing;
  if (tx_.size() < tx_thres_) bits |= ps_spi::event::TXOW;
  if (tx_.size() == ps_spi::fifo_depth) bits |= ps_spi::event::TXFULL;
  if (rx_.size() >= rx_thres_) bits |= ps_spi::event::RXNEMPTY;
  if (rx_.size() == ps_spi::fifo_depth) bits |= ps_spi::event::RXFULL;
  return bits;
}

void Spi::update() {
  start();
  irq = (status() & imr_) != 0;
  wake_at(done_at_);
}

}  // namespace ps
