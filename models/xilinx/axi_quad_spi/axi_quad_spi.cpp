#include <xilinx/axi_quad_spi/axi_quad_spi.h>

#include <string>
#include <utility>

#include <vp/error.h>
#include <vp/report.h>
#include <xilinx/common/axi_lite_ip.h>

namespace xilinx {

namespace {

using namespace axi_quad_spi;

constexpr unsigned bits_per_byte = 8;

std::uint32_t mask_of(unsigned bits) {
  return 0xFFFF'FFFF >> (32 - bits);
}

/// The lowest bit becomes the highest one.
std::uint32_t reversed(std::uint32_t word, unsigned bits) {
  std::uint32_t result = 0;
  for (unsigned bit = 0; bit < bits; ++bit) result = result << 1 | (word >> bit & 1);
  return result;
}

}  // namespace

AxiQuadSpi::AxiQuadSpi(sc_core::sc_module_name name, vp::Clock& s_axi_aclk,
                       const AxiQuadSpiBuild& build, vp::Clock* ext_spi_clk)
    : Clocked(name, s_axi_aclk),
      Ip(&s_axi_aclk),
      sck_ratio("sck_ratio", build.sck_ratio, vp::Unit::none, {2, 2048}, vp::Source::published,
                "build option Frequency Ratio (PG153)"),
      num_ss_bits("num_ss_bits", build.num_ss_bits, vp::Unit::none, {1, 32}, vp::Source::published,
                  "build option No. of Slaves (PG153)"),
      fifo_depth("fifo_depth", build.fifo_depth, vp::Unit::none, {16, 256}, vp::Source::published,
                 "build option FIFO Depth (PG153)"),
      num_transfer_bits("num_transfer_bits", build.num_transfer_bits, vp::Unit::none, {8, 32},
                        vp::Source::published, "build option Transaction Width (PG153): 8, 16, 32"),
      s_axi("s_axi", axi_quad_spi::registers, axi_lite_options(axi_quad_spi::address_bits),
            &s_axi_aclk.scheduler()),
      ext_spi_clk_(ext_spi_clk ? *ext_spi_clk : s_axi_aclk),
      gie_(s_axi[DGIER]),
      isr_(s_axi[IPISR]),
      ier_(s_axi[IPIER]),
      cr_(s_axi[SPICR]),
      ssr_(s_axi[SPISSR]),
      devices_(num_ss_bits) {
  const std::uint32_t slaves = num_ss_bits == 32 ? 0xFFFFFFFF : (1u << num_ss_bits) - 1;
  if (num_transfer_bits != 8 && num_transfer_bits != 16 && num_transfer_bits != 32)
    throw vp::InputError(std::string(num_transfer_bits.name()) + " is " + num_transfer_bits.text() +
                         ": it must be 8, 16 or 32");
  ssr_.set_writable(slaves);
  ssr_.set_reset_value(slaves);
  wire();
}

// A public report of the standard mode with a FIFO of 16 has 440 LUT and 655 FF.
vp::IpEstimate AxiQuadSpi::own_estimate() const {
  vp::IpEstimate e = axi_estimate("axi_quad_spi", 440, 655, fifo_depth > 16 ? 1 : 0);
  e.active_clocks = [this] { return clocks_per_access * accesses(s_axi); };
  return e;
}

void AxiQuadSpi::wire() {
  for (vp::Register* r : {&gie_, &isr_, &ier_}) {
    r->after_write([this](std::uint32_t) { update(); });
  }
  s_axi[SRR].after_write([this](std::uint32_t word) {
    if (word == reset_key) reset();
  });
  cr_.after_write([this](std::uint32_t word) { control_written(word); });
  s_axi[SPISR].computed_by([this] { return status(); });
  ssr_.after_write([this](std::uint32_t) {
    if (cr_.any(spicr::Manual_SS)) select();
    update();
  });
  s_axi[SPI_DTR].after_write([this](std::uint32_t word) {
    if (tx_.size() == fifo_depth) {
      vp::warn(*this, "/markervp/axi_quad_spi/overflow",
               "SPI_DTR written while it is full: SLVERR on the chip, a data abort; look at SPISR "
               "bit 3 first");
      return;
    }
    tx_.push_back(word & mask_of(num_transfer_bits));
    update();
  });
  vp::Register& drr = s_axi[SPI_DRR];
  drr.computed_by([this] { return rx_.empty() ? 0u : rx_.front(); });
  drr.after_read([this](std::uint32_t) {
    if (rx_.empty()) {
      vp::warn(
          *this, "/markervp/axi_quad_spi/read_empty",
          "SPI_DRR read while it is empty: SLVERR on the chip, a data abort; look at SPISR bit "
          "0 first");
      return;
    }
    rx_.pop_front();
    update();
  });
  const auto less_one = [](const std::deque<std::uint32_t>& fifo) {
    return fifo.empty() ? 0u : static_cast<std::uint32_t>(fifo.size() - 1);
  };
  s_axi[TX_OCY].computed_by([this, less_one] { return less_one(tx_); });
  s_axi[RX_OCY].computed_by([this, less_one] { return less_one(rx_); });
}

void AxiQuadSpi::attach(unsigned slave, std::shared_ptr<board::SpiDevice> device) {
  devices_.at(slave) = std::move(device);
}

void AxiQuadSpi::control_written(std::uint32_t word) {
  if ((word & spicr::TX_Reset) != 0) {
    tx_.clear();
    done_at_ = vp::Clock::never;
  }
  if ((word & spicr::RX_Reset) != 0) rx_.clear();
  cr_.clear_bits(spicr::TX_Reset | spicr::RX_Reset);
  update();
}

void AxiQuadSpi::reset() {
  s_axi.reset();
  tx_.clear();
  rx_.clear();
  done_at_ = vp::Clock::never;
  select();
  update();
}

void AxiQuadSpi::before_end_of_elaboration() {
  Clocked::before_end_of_elaboration();
  if (s_axi_aresetn.bound()) s_axi_aresetn.signal()->attach(*this);
}

void AxiQuadSpi::on_change(vp::SignalBase&, std::uint32_t) {
  reset();
  s_axi.hold_in_reset(!s_axi_aresetn);
}

// With automatic selects the slave is selected while words pass.
void AxiQuadSpi::select() {
  const bool shown = cr_.any(spicr::Manual_SS) || done_at_ != vp::Clock::never;
  const std::uint32_t wanted = shown ? ~ssr_ & ssr_.reset_value() : 0;
  for (unsigned n = 0; n < devices_.size(); ++n) {
    const bool now = (wanted >> n & 1) != 0, before = (selected_ >> n & 1) != 0;
    if (now != before && devices_[n]) devices_[n]->select(now);
  }
  selected_ = wanted;
}

/// A word out, and the one that comes back meanwhile.
std::uint32_t AxiQuadSpi::exchange(std::uint32_t word) {
  if (cr_.any(spicr::LOOP)) return word;
  const unsigned bits = num_transfer_bits;
  const bool is_reversed = cr_.any(spicr::LSB_First);
  const std::uint32_t sent = is_reversed ? reversed(word, bits) : word;
  std::uint32_t reply = 0;
  for (unsigned left = bits; left != 0; left -= bits_per_byte) {
    const auto byte = static_cast<std::uint8_t>(sent >> (left - bits_per_byte));
    reply = reply << bits_per_byte | exchange_byte(byte);
  }
  return is_reversed ? reversed(reply, bits) : reply;
}

std::uint8_t AxiQuadSpi::exchange_byte(std::uint8_t byte) {
  std::uint8_t reply = 0xFF;
  for (unsigned n = 0; n < devices_.size(); ++n) {
    if ((selected_ >> n & 1) != 0 && devices_[n]) reply &= devices_[n]->exchange(byte);
  }
  return reply;
}

void AxiQuadSpi::edge() {
  sleep();
  if (done_at_ <= clock().cycle()) {
    const std::uint32_t reply = exchange(tx_.front());
    done_at_ = vp::Clock::never;
    tx_.pop_front();
    isr_.set_bits(event::DRR_Not_Empty);
    if (rx_.size() == fifo_depth) {
      isr_.set_bits(event::DRR_Overrun);
    } else {
      rx_.push_back(reply);
    }
    if (rx_.size() == fifo_depth) isr_.set_bits(event::DRR_Full);
    if (tx_.size() == fifo_depth / 2) isr_.set_bits(event::TX_Half_Empty);
    if (tx_.empty()) {
      isr_.set_bits(event::DTR_Empty);
      if (!cr_.any(spicr::Manual_SS)) select();
    }
  }
  update();
}

std::uint32_t AxiQuadSpi::status() const {
  std::uint32_t bits = spisr::Slave_Mode_Select;
  if (rx_.empty()) bits |= spisr::RX_Empty;
  if (rx_.size() == fifo_depth) bits |= spisr::RX_Full;
  if (tx_.empty()) bits |= spisr::TX_Empty;
  if (tx_.size() == fifo_depth) bits |= spisr::TX_Full;
  return bits;
}

/// Clocks of the registers until a word has passed, rounded up.
std::uint64_t AxiQuadSpi::word_clocks() const {
  const std::uint64_t on_line = std::uint64_t{num_transfer_bits} * sck_ratio;
  const std::uint64_t line_hz = ext_spi_clk_.frequency_hz();
  if (line_hz == 0) return vp::Clock::never - clock().cycle();  // the clock is stopped
  return (on_line * clock().frequency_hz() + line_hz - 1) / line_hz;
}

void AxiQuadSpi::update() {
  constexpr std::uint32_t running = spicr::SPE | spicr::Master;
  const bool may_run = (cr_ & (running | spicr::Inhibit)) == running;
  if (may_run && done_at_ == vp::Clock::never && !tx_.empty()) {
    done_at_ = clock().cycle() + word_clocks();
    select();
  }
  ip2intc_irpt = gie_.any(dgier_GIE) && (isr_ & ier_) != 0;
  wake_at(done_at_);
}

}  // namespace xilinx
