#include <devcfg_registers.h>
#include <gem_registers.h>
#include <qspi_registers.h>
#include <sdio_registers.h>
#include <usb_registers.h>

#include <ps/idle/idle_devices.h>

#include <vp/report.h>

namespace ps {

namespace {

vp::RegisterBankOptions idle_options(unsigned address_bits = 12) {
  vp::RegisterBankOptions options;
  options.holes = vp::RegisterBankOptions::Holes::acknowledge;
  options.address_bits = address_bits;
  return options;
}

}  // namespace

// ---- SD

Sdio::Sdio(sc_core::sc_module_name name, vp::ClockScheduler& scheduler)
    : sc_module(name), registers("registers", sdio::registers, idle_options(), &scheduler) {
  vp::Register& clock_reset = registers[sdio::CLOCK_RESET];
  clock_reset.after_write([this, &clock_reset](std::uint32_t word) {
    using namespace sdio::clock_reset;
    if ((word & Resets) != 0) {
      registers[sdio::INT_STATUS] = 0;
      clock_reset.clear_bits(Resets);
    }
    clock_reset.clear_bits(Internal_Stable);
    if (clock_reset.any(Internal_Enable)) clock_reset.set_bits(Internal_Stable);
    update();
  });
  registers[sdio::TRANSFER_COMMAND].after_write([this](std::uint32_t) {
    registers[sdio::INT_STATUS].set_bits(registers[sdio::INT_STATUS_EN] &
                                                 sdio::event::Command_Timeout
                                             ? sdio::event::Command_Timeout | sdio::event::Error
                                             : 0);
    update();
  });
  for (const std::uint32_t offset : {sdio::INT_STATUS, sdio::INT_STATUS_EN, sdio::INT_SIGNAL_EN}) {
    registers[offset].after_write([this](std::uint32_t) { update(); });
  }
}

// The summary of errors is cleared with the last of them.
void Sdio::update() {
  vp::Register& status = registers[sdio::INT_STATUS];
  if (!status.any(sdio::event::Command_Timeout)) status.clear_bits(sdio::event::Error);
  irq = (status & registers[sdio::INT_SIGNAL_EN]) != 0;
}

// ---- Ethernet

Gem::Gem(sc_core::sc_module_name name, vp::ClockScheduler& scheduler)
    : sc_module(name), registers("registers", gem::registers, idle_options(), &scheduler) {
  vp::Register& mask = registers[gem::INTR_MASK];
  registers[gem::INTR_EN].after_write([&mask](std::uint32_t word) { mask.clear_bits(word); });
  registers[gem::INTR_DIS].after_write(
      [&mask](std::uint32_t word) { mask.set_bits(word & gem::intr_all); });
  vp::Register& phy = registers[gem::PHY_MAINT];
  phy.after_write([&phy](std::uint32_t word) {
    constexpr std::uint32_t operation = 3u << 28, read = 2u << 28;
    if ((word & operation) == read) phy.set_bits(0xFFFF);
  });
}

// ---- USB

Usb::Usb(sc_core::sc_module_name name, vp::ClockScheduler& scheduler)
    : sc_module(name), registers("registers", usb::registers, idle_options(), &scheduler) {
  vp::Register& command = registers[usb::USBCMD];
  command.after_write([this, &command](std::uint32_t word) {
    if ((word & usb::usbcmd_RST) == 0) return;
    registers[usb::USBSTS] = 0;
    command.clear_bits(usb::usbcmd_RST | usb::usbcmd_RS);
  });
  vp::Register& ulpi = registers[usb::ULPI_VIEWPORT];
  ulpi.after_write([&ulpi](std::uint32_t) { ulpi.clear_bits(usb::ulpi_wakeup | usb::ulpi_run); });
  for (const std::uint32_t offset : {usb::ENDPTPRIME, usb::ENDPTFLUSH}) {
    vp::Register& r = registers[offset];
    r.after_write([&r](std::uint32_t) { r = 0; });
  }
}

// ---- Quad-SPI

Qspi::Qspi(sc_core::sc_module_name name, vp::ClockScheduler& scheduler)
    : sc_module(name),
      registers("registers", qspi::registers, idle_options(), &scheduler),
      config_(registers[qspi::CONFIG]),
      intr_status_(registers[qspi::INTR_STATUS]),
      intr_mask_(registers[qspi::INTR_MASK]),
      tx_thres_(registers[qspi::TX_THRES]),
      rx_thres_(registers[qspi::RX_THRES]) {
  intr_status_.computed_by([this] { return status(); });
  intr_status_.after_write([this](std::uint32_t) { update(); });
  config_.after_write([this](std::uint32_t word) {
    config_.clear_bits(qspi::config::Man_start_com);
    if (config_.any(qspi::config::Manual_CS)) select(!config_.any(qspi::config::PCS));
    if ((word & qspi::config::Man_start_com) != 0) transfer();
    update();
  });
  registers[qspi::EN].after_write([this](std::uint32_t word) {
    if (word == 0) {
      tx_.clear();
      select(false);
    }
    update();
  });
  registers[qspi::INTR_EN].after_write([this](std::uint32_t word) {
    intr_mask_.set_bits(word & qspi::event::all);
    update();
  });
  registers[qspi::INTR_DIS].after_write([this](std::uint32_t word) {
    intr_mask_.clear_bits(word);
    update();
  });
  registers[qspi::TXD0].after_write([this](std::uint32_t word) { send(word, 4); });
  registers[qspi::TXD1].after_write([this](std::uint32_t word) { send(word, 1); });
  registers[qspi::TXD2].after_write([this](std::uint32_t word) { send(word, 2); });
  registers[qspi::TXD3].after_write([this](std::uint32_t word) { send(word, 3); });
  vp::Register& rx_data = registers[qspi::RX_DATA];
  rx_data.computed_by([this] { return rx_.empty() ? 0u : rx_.front(); });
  rx_data.after_read([this](std::uint32_t) {
    if (!rx_.empty()) rx_.pop_front();
    update();
  });
}

void Qspi::send(std::uint32_t word, unsigned bytes) {
  if (tx_.size() == qspi::fifo_words) {
    vp::warn(*this, "/markervp/qspi/overflow",
             "TXD written while the FIFO is full: the word is lost; look at INTR_STATUS first");
    return;
  }
  tx_.push_back({word, bytes});
  if (!config_.any(qspi::config::Man_start_en)) transfer();
  update();
}

void Qspi::select(bool selected) {
  if (selected == selected_) return;
  selected_ = selected;
  bytes_ = 0;
  if (flash_) flash_->select(selected);
}

// The received bytes of a short word are at its upper end (UG585 12.2.4).
void Qspi::transfer() {
  if (registers[qspi::EN] == 0) return;
  if (!config_.any(qspi::config::Manual_CS)) select(true);
  for (; !tx_.empty(); tx_.pop_front()) {
    const Word& word = tx_.front();
    std::uint32_t reply = 0;
    for (unsigned n = 0; n < word.bytes; ++n) {
      const auto out = static_cast<std::uint8_t>(word.bits >> 8 * n);
      if (bytes_++ == 0) command_ = out;
      constexpr std::uint8_t read_status = 0x05;
      const std::uint8_t absent = command_ == read_status && bytes_ > 1 ? 0x00 : 0xFF;
      const std::uint32_t in = flash_ ? flash_->exchange(out) : absent;
      reply |= in << 8 * (4 - word.bytes + n);
    }
    if (rx_.size() == qspi::fifo_words) {
      intr_status_.set_bits(qspi::event::RX_OVERFLOW);
    } else {
      rx_.push_back(reply);
    }
  }
  if (!config_.any(qspi::config::Manual_CS)) select(false);
}

std::uint32_t Qspi::status() const {
  std::uint32_t bits = intr_status_ & qspi::event::cleared_by_writing;
  if (tx_.size() < tx_thres_) bits |= qspi::event::TX_FIFO_not_full;
  if (tx_.size() == qspi::fifo_words) bits |= qspi::event::TX_FIFO_full;
  if (rx_.size() >= rx_thres_) bits |= qspi::event::RX_FIFO_not_empty;
  if (rx_.size() == qspi::fifo_words) bits |= qspi::event::RX_FIFO_full;
  return bits;
}

void Qspi::update() {
  irq = (status() & intr_mask_) != 0;
}

// ---- configuration of the PL

Devcfg::Devcfg(sc_core::sc_module_name name, vp::Clock& cpu_1x_clk)
    : vp::Clocked(name, cpu_1x_clk),
      registers("registers", devcfg::registers, idle_options(8), &cpu_1x_clk.scheduler()),
      int_sts_(registers[devcfg::INT_STS]),
      int_mask_(registers[devcfg::INT_MASK]) {
  registers[devcfg::DMA_DEST_LEN].after_write([this](std::uint32_t) { start(); });
  for (vp::Register* r : {&int_sts_, &int_mask_}) {
    r->after_write([this](std::uint32_t) { update(); });
  }
}

void Devcfg::start() {
  vp::warn(
      *this, "/markervp/devcfg/bitstream",
      "a transfer to the PL is not modelled: it ends in its time, and the PL keeps its design");
  const std::uint64_t words =
      std::uint64_t{registers[devcfg::DMA_SRC_LEN]} + registers[devcfg::DMA_DEST_LEN];
  const std::uint64_t ps = (words + 1) * devcfg::ns_per_word * 1000;
  done_at_ = clock().cycle() + 1 + ps * (clock().frequency_hz() / 1'000'000) / 1'000'000;
  wake_at(done_at_);
}

void Devcfg::update() {
  irq = (int_sts_ & ~int_mask_) != 0;
}

void Devcfg::edge() {
  sleep();
  if (done_at_ > clock().cycle()) return wake_at(done_at_);
  done_at_ = vp::Clock::never;
  int_sts_.set_bits(devcfg::event::PCFG_DONE | devcfg::event::D_P_DONE | devcfg::event::DMA_DONE);
  update();
}

}  // namespace ps
