#include <xilinx/axi_fifo_mm_s/axi_fifo_mm_s.h>

#include <string>

#include <vp/report.h>
#include <xilinx/common/axi_lite_ip.h>

namespace xilinx {

namespace {

using namespace axi_fifo_mm_s;

constexpr std::uint32_t bytes_per_word = 4;
constexpr std::uint32_t reserved_words = 4;  // of each FIFO (PG080)
constexpr std::uint32_t no_id = 0, reset_id = 1;

std::uint32_t words_of(std::uint32_t bytes) {
  return (bytes + bytes_per_word - 1) / bytes_per_word;
}

}  // namespace

AxiFifoMmS::AxiFifoMmS(sc_core::sc_module_name name, vp::Clock& s_axi_aclk,
                       const AxiFifoMmSBuild& build)
    : Clocked(name, s_axi_aclk),
      Ip(&s_axi_aclk),
      use_tx_data("use_tx_data", build.use_tx_data, vp::Source::published,
                  "build option Enable Transmit Data (PG080)"),
      use_rx_data("use_rx_data", build.use_rx_data, vp::Source::published,
                  "build option Enable Receive Data (PG080)"),
      tx_fifo_depth("tx_fifo_depth", build.tx_fifo_depth, vp::Unit::none, {512, 131'072},
                    vp::Source::published, "build option Transmit FIFO Depth (PG080)"),
      rx_fifo_depth("rx_fifo_depth", build.rx_fifo_depth, vp::Unit::none, {512, 131'072},
                    vp::Source::published, "build option Receive FIFO Depth (PG080)"),
      has_tkeep("has_tkeep", build.has_tkeep, vp::Source::published,
                "build option Enable TKEEP (PG080)"),
      s_axi("s_axi", axi_fifo_mm_s::registers, axi_lite_options(axi_fifo_mm_s::address_bits),
            &s_axi_aclk.scheduler()),
      isr_(s_axi[ISR]),
      ier_(s_axi[IER]) {
  wire();
}

// The guide's table has about 500 LUT and 700 FF for both directions; one of 512 words is half a
// RAMB36.
vp::IpEstimate AxiFifoMmS::own_estimate() const {
  const bool both = use_tx_data && use_rx_data;
  const std::uint32_t words = (use_tx_data ? tx_fifo_depth : 0) + (use_rx_data ? rx_fifo_depth : 0);
  vp::IpEstimate e =
      axi_estimate("axi_fifo_mm_s", both ? 500 : 300, both ? 700 : 400, words / 1024.0);
  e.active_clocks = [this] { return clocks_per_access * accesses(s_axi); };
  return e;
}

void AxiFifoMmS::wire() {
  if (!use_tx_data)
    for (const std::uint32_t offset : {TDFR, TDFV, TDFD, TLR, TDR}) s_axi[offset].remove();
  if (!use_rx_data)
    for (const std::uint32_t offset : {RDFR, RDFO, RDFD, RLR, RDR}) s_axi[offset].remove();
  s_axi[TDFV].set_reset_value(use_tx_data ? tx_fifo_depth - reserved_words : 0);
  for (vp::Register* r : {&isr_, &ier_}) r->after_write([this](std::uint32_t) { update(); });
  const auto on_key = [this](std::uint32_t offset, bool sends, bool receives) {
    s_axi[offset].after_write([this, sends, receives](std::uint32_t word) {
      if (word != reset_key) return;
      if (sends) reset_sending();
      if (receives) reset_receiving();
    });
  };
  on_key(TDFR, true, false);
  on_key(RDFR, false, true);
  on_key(SRR, true, true);
  s_axi[TDFV].computed_by([this] {
    const std::size_t used = written_.size() + leaving_.size() + reserved_words;
    return used >= tx_fifo_depth ? 0u : static_cast<std::uint32_t>(tx_fifo_depth - used) & ~1u;
  });
  s_axi[TDFD].after_write([this](std::uint32_t word) {
    if (written_.size() + leaving_.size() + reserved_words >= tx_fifo_depth)
      return raise(event::TPOE, "TDFD written while the FIFO is full; look at TDFV first");
    written_.push_back(word);
  });
  s_axi[TLR].after_write([this](std::uint32_t bytes) { send_packet(bytes); });
  s_axi[RDFO].computed_by([this] { return static_cast<std::uint32_t>(received_.size()); });
  vp::Register& data = s_axi[RDFD];
  data.computed_by([this] { return received_.empty() ? 0u : received_.front(); });
  data.after_read([this](std::uint32_t) { take_word(); });
  vp::Register& length = s_axi[RLR];
  length.computed_by([this] { return lengths_.empty() ? 0u : lengths_.front(); });
  length.after_read([this](std::uint32_t) { take_length(); });
}

void AxiFifoMmS::raise(std::uint32_t events, const char* warning) {
  isr_.set_bits(events);
  if (warning) {
    vp::warn(*this, "/markervp/axi_fifo_mm_s/misuse",
             std::string(warning) + " (SLVERR on the chip, a data abort)");
  }
  update();
}

// The core counts the words: if they are not those of the length, nothing is sent.
void AxiFifoMmS::send_packet(std::uint32_t bytes) {
  if (words_of(bytes) != written_.size() || bytes == 0) {
    written_.clear();
    vp::warn(*this, "/markervp/axi_fifo_mm_s/length",
             "TLR does not agree with the words written to TDFD: nothing is sent (ISR.TSE)");
    return raise(event::TSE);
  }
  const std::uint32_t rest = has_tkeep ? bytes % bytes_per_word : 0;
  while (!written_.empty()) {
    const bool last = written_.size() == 1;
    const auto keep = static_cast<std::uint8_t>(last && rest != 0 ? (1u << rest) - 1 : 0xF);
    leaving_.push_back({written_.front(), last, keep});
    written_.pop_front();
  }
  if (!awake()) wake();
}

void AxiFifoMmS::take_word() {
  if (received_.empty())
    return raise(event::RPUE, "RDFD read while no packet is there; look at RDFO first");
  if (readable_ == 0) raise(event::RPORE, "RDFD read before RLR, or beyond its length");
  if (readable_ > 0) --readable_;
  received_.pop_front();
  if (!awake()) wake();
}

void AxiFifoMmS::take_length() {
  if (lengths_.empty())
    return raise(event::RPURE, "RLR read while no packet is there; look at RDFO first");
  readable_ = words_of(lengths_.front());
  lengths_.pop_front();
}

void AxiFifoMmS::reset_sending() {
  written_.clear();
  leaving_.clear();
  raise(event::TRC);
}

void AxiFifoMmS::reset_receiving() {
  received_.clear();
  arriving_.clear();
  lengths_.clear();
  arriving_bytes_ = readable_ = 0;
  raise(event::RRC);
  if (!awake()) wake();  // a stream that waited for room
}

void AxiFifoMmS::before_end_of_elaboration() {
  Clocked::before_end_of_elaboration();
  if (axi_str_rxd.bound()) wake_on(axi_str_rxd.tvalid);
  if (s_axi_aresetn.bound()) s_axi_aresetn.signal()->attach(*this, reset_id);
}

void AxiFifoMmS::on_change(vp::SignalBase& signal, std::uint32_t id) {
  if (id == no_id) return Clocked::on_change(signal, id);
  s_axi.hold_in_reset(!s_axi_aresetn);
  reset_sending();
  reset_receiving();
}

void AxiFifoMmS::edge() {
  bool idle = true;
  if (axi_str_txd.bound()) {
    if (axi_str_txd.accepted() && axi_str_txd.tlast.get()) raise(event::TC);
    if (axi_str_txd.free()) {
      if (leaving_.empty()) {
        axi_str_txd.withdraw();
      } else {
        const Beat beat = leaving_.front();
        leaving_.pop_front();
        axi_str_txd.offer(beat.data, beat.last, beat.keep);
        idle = false;
      }
    } else {
      idle = false;
    }
  }
  if (axi_str_rxd.bound()) {
    if (axi_str_rxd.sample()) {
      arriving_.push_back(axi_str_rxd.tdata);
      arriving_bytes_ +=
          has_tkeep ? static_cast<std::uint32_t>(__builtin_popcount(axi_str_rxd.tkeep.read()))
                    : bytes_per_word;
      idle = false;
      if (axi_str_rxd.tlast.read()) {
        received_.insert(received_.end(), arriving_.begin(), arriving_.end());
        lengths_.push_back(arriving_bytes_);
        arriving_.clear();
        arriving_bytes_ = 0;
        raise(event::RC);
      }
    }
    const bool has_room = received_.size() + arriving_.size() + reserved_words < rx_fifo_depth;
    axi_str_rxd.tready = has_room;
    if (axi_str_rxd.tvalid.read() && has_room) idle = false;
  }
  if (idle) sleep();
}

void AxiFifoMmS::update() {
  interrupt = (isr_ & ier_) != 0;
}

}  // namespace xilinx
