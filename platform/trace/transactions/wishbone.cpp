#include <deque>

#include <trace/transactions/axi_burst.h>
#include <trace/transactions/decoder.h>

// Wishbone. With STALL it is pipelined: a request passes on each clock without STALL, and answers
// come in order. Without it an access lasts until its answer.

namespace platform::trace {

namespace {

class Wishbone final : public Decoder {
 public:
  explicit Wishbone(const DecoderContext& context)
      : Decoder(context),
        cycle_(*role("cyc")),
        strobe_(*role("stb")),
        ack_(*role("ack")),
        write_(role("we")),
        error_(role("err")),
        retry_(role("rty")),
        address_(role("adr")),
        select_(role("sel")),
        stall_(role("stall")),
        write_data_(role("writedata")),
        read_data_(role("readdata")) {}

  bool busy() const override { return busy_; }
  void edge(const SampleEdge& edge) override {
    const bool cycle = high(cycle_);
    busy_ = cycle && (high(strobe_) || high(ack_));
    if (!cycle) {
      for (Open& open : open_) close(open, "CYC fell at cycle " + std::to_string(edge.cycle));
      open_.clear();
      offered_ = false;
      return;
    }
    request(edge);
    answer(edge);
  }
  void finish(std::uint64_t /*ps*/, std::uint64_t edges) override {
    if (!open_.empty()) {
      Open& oldest = open_.front();
      Wait wait;
      wait.interface = place_;
      wait.state = oldest.accepted ? Wait::State::starved : Wait::State::wants;
      wait.channel = "WB";
      wait.what = std::string(oldest.accepted || !stall_ ? "ACK for " : "STALL to fall for ") +
                  named(oldest.transaction);
      wait.since_ps = oldest.transaction.accepted_ps.value_or(oldest.transaction.begin_ps);
      wait.clocks = edges - oldest.transaction.begin_cycle;
      waits_.push_back(wait);
    }
    for (Open& open : open_) close(open, "no answer: open at the end");
    open_.clear();
  }
  std::vector<Wait> waits() const override { return waits_; }

 private:
  struct Open {
    Transaction transaction;
    TransactionSink::Ticket ticket = 0;
    bool accepted = false;
  };

  static std::string named(const Transaction& one) {
    return std::string("the ") + one.operation + " of " + hexadecimal(one.address.value_or(0));
  }
  void request(const SampleEdge& edge) {
    if (!high(strobe_)) {
      if (offered_) {
        report({"WISHBONE_STB_STABLE", edge.ps, edge.cycle, "STB falls before it was answered"},
               &open_.back().transaction);
        close(open_.back(), "withdrawn");
        open_.pop_back();
        offered_ = false;
      }
      return;
    }
    if (!offered_) begin(edge);
    if (high(stall_)) {
      ++open_.back().transaction.request_wait;
      return;
    }
    Open& open = open_.back();
    if (!open.accepted) open.transaction.accepted_ps = edge.ps;
    open.accepted = true;
    offered_ = !stall_;  // pipelined: the next clock offers the next request
  }
  void begin(const SampleEdge& edge) {
    if (open_.size() == most_open) {
      close(open_.front(), "given up: " + std::to_string(most_open) + " later ones are open");
      open_.pop_front();
    }
    Open open;
    open.ticket = sink_.open();
    open.transaction = begun(high(write_) ? "write" : "read", edge);
    Transaction& one = open.transaction;
    one.address = number(address_);
    one.beats = 1;
    one.outstanding = open_.size();
    const bool writes = high(write_);
    const auto data = writes ? write_data_ : read_data_;
    if (data) one.size = (width(*data) + 7) / 8;
    one.bytes = one.size.value_or(0);
    if (select_) {
      one.strobe = shown(*select_);
      one.bytes = axi_strobe(digits(*select_), {0, width(*select_)}).bytes;
    }
    if (writes && write_data_) add_data(one, *write_data_);
    open_.push_back(std::move(open));
    offered_ = true;
  }
  void answer(const SampleEdge& edge) {
    const char* response = high(error_)   ? "ERR"
                           : high(retry_) ? "RTY"
                           : high(ack_)   ? "ACK"
                                          : nullptr;
    if (!response) {
      if (!stall_ && offered_) ++open_.back().transaction.response_wait;
      return;
    }
    if (open_.empty() || !open_.front().accepted) {
      report({"WISHBONE_ACK", edge.ps, edge.cycle, std::string(response) + " without a request"});
      return;
    }
    Open& open = open_.front();
    Transaction& one = open.transaction;
    if (one.operation[0] == 'r' && read_data_) add_data(one, *read_data_);
    one.beats_done = 1;
    one.response = response;
    one.first_data_ps = one.last_data_ps = one.end_ps = edge.ps;
    one.end_cycle = edge.cycle;
    moved(edge, named(one));
    close(open, "");
    open_.pop_front();
    if (!stall_) offered_ = false;
  }
  void close(Open& open, const std::string& note) {
    if (!note.empty()) open.transaction.add_note(note);
    sink_.take(open.ticket, std::move(open.transaction));
  }

  Replay::Slot cycle_, strobe_, ack_;
  std::optional<Replay::Slot> write_, error_, retry_, address_, select_, stall_, write_data_,
      read_data_;
  bool offered_ = false;  ///< the last of open_ still holds STB
  bool busy_ = false;
  std::deque<Open> open_;
  std::vector<Wait> waits_;
};

}  // namespace

std::unique_ptr<Decoder> wishbone_decoder(const DecoderContext& context) {
  return std::make_unique<Wishbone>(context);
}

}  // namespace platform::trace
