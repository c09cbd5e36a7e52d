#include <xilinx/axi_uartlite/axi_uartlite.h>

#include <algorithm>

#include <vp/report.h>
#include <xilinx/common/axi_lite_ip.h>

namespace xilinx {

namespace {

using namespace axi_uartlite;

}  // namespace

AxiUartlite::AxiUartlite(sc_core::sc_module_name name, vp::Clock& s_axi_aclk,
                         const AxiUartliteBuild& build)
    : Clocked(name, s_axi_aclk),
      Ip(&s_axi_aclk),
      baudrate("baudrate", build.baudrate, vp::Unit::none, {110, 921'600}, vp::Source::published,
               "build option Baud Rate (PG142)"),
      data_bits("data_bits", build.data_bits, vp::Unit::none, {5, 8}, vp::Source::published,
                "build option Data Bits (PG142)"),
      use_parity("use_parity", build.use_parity, vp::Source::published,
                 "build option Parity (PG142)"),
      odd_parity("odd_parity", build.odd_parity, vp::Source::published,
                 "build option Parity (PG142): odd, else even"),
      s_axi("s_axi", axi_uartlite::registers, axi_lite_options(axi_uartlite::address_bits),
            &s_axi_aclk.scheduler()) {
  wire();
}

// A public report has 103 LUT and 110 FF (7a100t).
vp::IpEstimate AxiUartlite::own_estimate() const {
  vp::IpEstimate e = axi_estimate("axi_uartlite", 103, 110, 0);
  e.active_clocks = [this] { return clocks_per_access * accesses(s_axi); };
  return e;
}

void AxiUartlite::wire() {
  vp::Register& rx_fifo = s_axi[RX_FIFO];
  rx_fifo.computed_by([this] { return rx_.empty() ? 0u : std::uint32_t{rx_.front()}; });
  rx_fifo.after_read([this](std::uint32_t) {
    if (rx_.empty()) {
      vp::warn(*this, "/markervp/axi_uartlite/read_empty",
               "RX_FIFO read while it is empty: SLVERR on the chip, a data abort; look at STAT_REG "
               "bit 0 first");
      return;
    }
    rx_.pop_front();
    if (!rx_.empty()) pulse();
    update();
  });
  s_axi[TX_FIFO].after_write([this](std::uint32_t word) {
    if (tx_.size() == fifo_depth) {
      vp::warn(*this, "/markervp/axi_uartlite/overflow",
               "TX_FIFO written while it is full: SLVERR on the chip, a data abort; look at "
               "STAT_REG bit 3 first");
      return;
    }
    tx_.push_back(static_cast<std::uint8_t>(word));
    update();
  });
  vp::Register& stat_reg = s_axi[STAT_REG];
  stat_reg.computed_by([this] { return status(); });
  stat_reg.after_read([this](std::uint32_t) { overrun_ = false; });
  s_axi[CTRL_REG].after_write([this](std::uint32_t word) {
    if ((word & ctrl::Rst_Tx_FIFO) != 0) {
      tx_.clear();
      sent_at_ = vp::Clock::never;
    }
    if ((word & ctrl::Rst_Rx_FIFO) != 0) rx_.clear();
    enabled_ = (word & ctrl::Enable_Intr) != 0;
    update();
  });
}

void AxiUartlite::before_end_of_elaboration() {
  Clocked::before_end_of_elaboration();
  if (s_axi_aresetn.bound()) s_axi_aresetn.signal()->attach(*this);
}

void AxiUartlite::on_change(vp::SignalBase&, std::uint32_t) {
  s_axi.hold_in_reset(!s_axi_aresetn);
  tx_.clear();
  rx_.clear();
  enabled_ = overrun_ = false;
  sent_at_ = received_at_ = vp::Clock::never;
  update();
}

// Start bit, data, parity, stop bit; the divider counts sixteenths of a bit.
std::uint64_t AxiUartlite::character_clocks() const {
  const std::uint64_t sixteenth =
      std::max<std::uint64_t>(1, (clock().frequency_hz() + 8ull * baudrate) / (16ull * baudrate));
  return 16 * sixteenth * (2 + data_bits + (use_parity ? 1 : 0));
}

bool AxiUartlite::understands(const AxiUartlite& other) const {
  return baudrate.get() == other.baudrate.get() && data_bits.get() == other.data_bits.get() &&
         use_parity.get() == other.use_parity.get() &&
         (!use_parity.get() || odd_parity.get() == other.odd_parity.get());
}

void AxiUartlite::receive(std::string_view bytes) {
  for (const char c : bytes) line_.push_back(static_cast<std::uint8_t>(c));
  update();
}

void AxiUartlite::pulse() {
  if (!enabled_) return;
  interrupt = true;
  pulse_end_ = clock().cycle() + 1;
}

void AxiUartlite::edge() {
  sleep();
  const std::uint64_t now = clock().cycle();
  if (pulse_end_ <= now) {
    pulse_end_ = vp::Clock::never;
    interrupt = false;
  }
  if (sent_at_ <= now) {
    sent_at_ = vp::Clock::never;
    if (on_transmit) on_transmit(leaving_);
    if (receiver_) receiver_->take(leaving_);
  }
  if (received_at_ <= now) {
    received_at_ = vp::Clock::never;
    const std::uint8_t byte = line_.front();
    line_.pop_front();
    take(byte);
  }
  update();
}

// Its last bit is there.
void AxiUartlite::take(std::uint8_t byte) {
  if (rx_.size() == fifo_depth) {
    overrun_ = true;
  } else {
    rx_.push_back(byte);
    if (rx_.size() == 1) pulse();
  }
  update();
}

std::uint32_t AxiUartlite::status() const {
  std::uint32_t bits = 0;
  if (!rx_.empty()) bits |= stat::Rx_FIFO_Valid_Data;
  if (rx_.size() == fifo_depth) bits |= stat::Rx_FIFO_Full;
  if (tx_.empty()) bits |= stat::Tx_FIFO_Empty;
  if (tx_.size() == fifo_depth) bits |= stat::Tx_FIFO_Full;
  if (enabled_) bits |= stat::Intr_Enabled;
  if (overrun_) bits |= stat::Overrun_Error;
  return bits;
}

void AxiUartlite::update() {
  const std::uint64_t now = clock().cycle();
  if (sent_at_ == vp::Clock::never && !tx_.empty()) {
    leaving_ = tx_.front();
    tx_.pop_front();
    sent_at_ = now + character_clocks();
    if (tx_.empty()) pulse();
  }
  if (received_at_ == vp::Clock::never && !line_.empty()) received_at_ = now + character_clocks();
  wake_at(std::min({sent_at_, received_at_, pulse_end_}));
}

}  // namespace xilinx
