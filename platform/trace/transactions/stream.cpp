#include <vp/text.h>
#include <algorithm>
#include <map>

#include <trace/transactions/axi_burst.h>
#include <trace/transactions/handshake.h>

// AXI4-Stream: packets up to TLAST, of each TID and TDEST. Without TLAST each beat is a packet.

namespace platform::trace {

namespace {

class Stream final : public Decoder {
 public:
  explicit Stream(const DecoderContext& context)
      : Decoder(context),
        data_(role("tdata")),
        keep_(role("tkeep")),
        strobe_(role("tstrb")),
        last_(role("tlast")),
        id_(role("tid")),
        dest_(role("tdest")),
        channel_(replay_, "AXI4STREAM_", "T", true, *role("tvalid"), role("tready"), payload()) {
    follow_reset();
    if (data_) beat_bytes_ = std::max(1U, width(*data_) / bits_per_byte);
  }

  bool busy() const override { return channel_.beat(); }
  void edge(const SampleEdge& edge) override {
    const bool resets = in_reset();
    if (resets && !was_reset_) {
      close_all("reset at cycle " + std::to_string(edge.cycle));
      channel_.reset();
    }
    const bool after_reset = was_reset_ && !resets;
    was_reset_ = resets;
    if (resets) return;
    channel_.sample(edge, after_reset, options_.max_wait);
    Open* packet = channel_.valid() ? packet_of(edge) : nullptr;
    for (Violation& violation : channel_.broken())
      report(std::move(violation), packet ? &packet->transaction : nullptr);
    channel_.broken().clear();
    if (channel_.beat()) beat(*packet, edge);
  }
  void finish(std::uint64_t /*ps*/, std::uint64_t edges) override {
    if (channel_.valid() && !channel_.beat()) {
      Wait wait;
      wait.interface = place_;
      wait.channel = "T";
      wait.what = "TREADY";
      wait.since_ps = channel_.offered().ps;
      wait.clocks = edges - channel_.offered().cycle;
      wait.idle_since_cycle = channel_.ready_low_since();
      waits_.push_back(wait);
    }
    close_all(last_ ? "no TLAST: open at the end" : "not accepted: open at the end");
  }
  std::vector<Wait> waits() const override { return waits_; }

 private:
  struct Open {
    Transaction transaction;
    TransactionSink::Ticket ticket = 0;
  };
  using Key = std::pair<std::uint64_t, std::uint64_t>;

  std::vector<Handshake::Payload> payload() {
    std::vector<Handshake::Payload> signals;
    for (const char* name : {"DATA", "KEEP", "STRB", "LAST", "ID", "DEST", "USER"}) {
      if (const auto slot = role("t" + vp::lower(name))) signals.push_back({name, *slot});
    }
    return signals;
  }
  Key key() const { return {number(id_).value_or(0), number(dest_).value_or(0)}; }
  /// The packet that the offered beat belongs to; without an open one the beat begins it.
  Open* packet_of(const SampleEdge& /*edge*/) {
    const auto found = open_.find(key());
    if (found != open_.end()) return &found->second;
    if (open_.size() == most_open) {
      Open& oldest = open_.begin()->second;
      oldest.transaction.add_note("given up: " + std::to_string(most_open) + " packets are open");
      sink_.take(oldest.ticket, std::move(oldest.transaction));
      open_.erase(open_.begin());
    }
    Open packet;
    packet.transaction = begun("packet", channel_.offered());
    packet.transaction.id = number(id_);
    packet.transaction.address = number(dest_);
    packet.transaction.outstanding = open_.size();
    if (data_) packet.transaction.size = beat_bytes_;
    packet.ticket = sink_.open();
    return &open_.emplace(key(), std::move(packet)).first->second;
  }
  void beat(Open& packet, const SampleEdge& edge) {
    Transaction& one = packet.transaction;
    ++one.beats;
    one.beats_done = one.beats;
    if (!one.accepted_ps) {
      one.accepted_ps = one.first_data_ps = edge.ps;
      one.request_wait = channel_.waited(edge);
    }
    one.last_data_ps = edge.ps;
    one.data_wait += channel_.waited(edge);
    if (data_) add_data(one, *data_);
    note_bytes(one, edge);
    moved(edge, "a beat");
    if (last_ && !high(last_)) return;
    one.end_ps = edge.ps;
    one.end_cycle = edge.cycle;
    sink_.take(packet.ticket, std::move(one));
    open_.erase(key());
  }
  void note_bytes(Transaction& one, const SampleEdge& edge) {
    if (!keep_) {
      one.bytes += data_ ? beat_bytes_ : 0;
      return;
    }
    const std::string keep = vp::full_digits(digits(*keep_), width(*keep_));
    one.bytes += axi_strobe(keep, {0, keep.size()}).bytes;
    const std::string shown = bits_as_hexadecimal(keep);
    one.strobe = one.beats == 1 || one.strobe == shown ? shown : "mixed";
    if (!strobe_) return;
    const std::string strobe = vp::full_digits(digits(*strobe_), width(*strobe_));
    for (std::size_t i = 0; i < std::min(keep.size(), strobe.size()); ++i) {
      if (strobe[strobe.size() - 1 - i] != '1' || keep[keep.size() - 1 - i] != '0') continue;
      report({"AXI4STREAM_ERRM_TKEEP_TSTRB", edge.ps, edge.cycle,
              "TSTRB on byte " + std::to_string(i) + ", which TKEEP leaves out"},
             &one);
      break;
    }
  }
  void close_all(const std::string& why) {
    for (auto& [key, packet] : open_) {
      packet.transaction.add_note(why);
      sink_.take(packet.ticket, std::move(packet.transaction));
    }
    open_.clear();
  }

  std::optional<Replay::Slot> data_, keep_, strobe_, last_, id_, dest_;
  Handshake channel_;
  unsigned beat_bytes_ = 1;
  bool was_reset_ = false;
  std::map<Key, Open> open_;
  std::vector<Wait> waits_;
};

}  // namespace

std::unique_ptr<Decoder> stream_decoder(const DecoderContext& context) {
  return std::make_unique<Stream>(context);
}

}  // namespace platform::trace
