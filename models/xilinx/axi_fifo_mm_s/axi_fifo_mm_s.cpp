#include <xilinx/axi_fifo_mm_s/axi_fifo_mm_s.h>

#include <string>

#include <vp/report.h>
#include <xilinx/common/estimate.h>

namespace xilinx {

namespace {

using namespace axi_fifo_mm_s;

constexpr std::uint32_t bytes_per_word = 4;
constexpr std::uint32_t reserved_words = 4;  // of each FIFO (PG080)
constexpr std::uint32_t no_id = 0, reset_id = 1;

vp::RegisterBankOptions fifo_options() {
  vp::RegisterBankOptions options;
  options.holes = vp::RegisterBankOptions::Holes::acknowledge;
  options.byte_enables = vp::RegisterBankOptions::ByteEnables::ignore;
  options.address_bits = axi_fifo_mm_s::address_bits;
  return options;
}

std::uint32_t words_of(std::uint32_t bytes) {
  return (bytes + bytes_per_word - 1) / bytes_per_word;
}

}  // namespace

AxiFifoMmS::AxiFifoMmS(sc_core::sc_module_name name, vp::Clock& s_axi_aclk,
                       const AxiFifoMmSBuild& build)
    : Clocked(name, s_axi_aclk),
      Ip(&s_axi_aclk),
      fifo_depth("fifo_depth", build.fifo_depth, vp::Unit::none, {512, 131'072},
                 vp::Source::published, "build option FIFO depth, each direction (PG080)"),
      s_axi("s_axi", axi_fifo_mm_s::registers, fifo_options(), &s_axi_aclk.scheduler()),
      isr_(s_axi[ISR]),
      ier_(s_axi[IER]) {
  wire();
}

// The guide's table has about 500 LUT and 700 FF; each direction of 512 words is half a RAMB36.
vp::IpEstimate AxiFifoMmS::own_estimate() const {
  vp::IpEstimate e = axi_estimate("axi_fifo_mm_s", 500, 700, fifo_depth / 512);
  e.active_clocks = [this] { return clocks_per_access * accesses(s_axi); };
  return e;
}

void AxiFifoMmS::wire() {
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
    return used >= fifo_depth ? 0u : static_cast<std::uint32_t>(fifo_depth - used) & ~1u;
  });
  s_axi[TDFD].after_write([this](std::uint32_t word) {
    if (written_.size() + leaving_.size() + reserved_words >= fifo_depth)
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
  const std::uint32_t rest = bytes % bytes_per_word;
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
      arriving_bytes_ += static_cast<std::uint32_t>(__builtin_popcount(axi_str_rxd.tkeep.read()));
      idle = false;
      if (axi_str_rxd.tlast.read()) {
        received_.insert(received_.end(), arriving_.begin(), arriving_.end());
        lengths_.push_back(arriving_bytes_);
        arriving_.clear();
        arriving_bytes_ = 0;
        raise(event::RC);
      }
    }
    const bool has_room = received_.size() + arriving_.size() + reserved_words < fifo_depth;
    axi_str_rxd.tready = has_room;
    if (axi_str_rxd.tvalid.read() && has_room) idle = false;
  }
  if (idle) sleep();
}

void AxiFifoMmS::update() {
  interrupt = (isr_ & ier_) != 0;
}

}  // namespace xilinx
