#include <trace/transactions/decoder.h>

#include <array>

// APB: an access begins with PSEL and ends with PSEL, PENABLE and PREADY. Without PREADY a
// peripheral is always ready.

namespace platform::trace {

namespace {

class Apb final : public Decoder {
 public:
  explicit Apb(const DecoderContext& context)
      : Decoder(context),
        select_(*role("psel")),
        enable_(*role("penable")),
        ready_(role("pready")),
        write_(role("pwrite")),
        address_(role("paddr")),
        write_data_(role("pwdata")),
        read_data_(role("prdata")),
        error_(role("pslverr")),
        strobe_(role("pstrb")) {
    for (std::size_t i = 0; i < kept_.size(); ++i) kept_[i].slot = role(kept_[i].name);
  }

  bool busy() const override { return open_; }
  void edge(const SampleEdge& edge) override {
    if (!high(select_)) {
      if (open_) {
        rule("APB_PSEL_STABLE", edge, "PSEL falls before PREADY came");
        close("withdrawn");
      }
      return;
    }
    const bool enabled = high(enable_);
    if (!open_) {
      begin(edge);
      if (enabled) rule("APB_SETUP", edge, "PENABLE is high in the first clock of an access");
    } else {
      check_kept(edge);
      if (!enabled && enabled_)
        rule("APB_PENABLE_STABLE", edge, "PENABLE falls before PREADY came");
    }
    enabled_ = enabled;
    if (!enabled) return;
    if (!one_.accepted_ps) one_.accepted_ps = edge.ps;
    if (high(ready_, true)) {
      end(edge);
    } else {
      ++one_.response_wait;
    }
  }
  void finish(std::uint64_t /*ps*/, std::uint64_t edges) override {
    if (!open_) return;
    Wait wait;
    wait.interface = place_;
    wait.state = Wait::State::wants;
    wait.channel = "P";
    wait.for_manager = !one_.accepted_ps.has_value();
    wait.what = wait.for_manager ? "PENABLE"
                                 : "PREADY for " + std::string("the ") + one_.operation + " of " +
                                       hexadecimal(one_.address.value_or(0));
    wait.since_ps = one_.accepted_ps.value_or(one_.begin_ps);
    wait.clocks = edges - one_.begin_cycle;
    waits_.push_back(wait);
    close("open at the end");
  }
  std::vector<Wait> waits() const override { return waits_; }

 private:
  struct Kept {
    const char *name, *rule;
    std::optional<Replay::Slot> slot;
    std::string digits;
  };

  void rule(const std::string& name, const SampleEdge& edge, const std::string& detail) {
    report({name, edge.ps, edge.cycle, detail}, &one_);
  }
  void begin(const SampleEdge& edge) {
    one_ = begun(high(write_) ? "write" : "read", edge);
    open_ = true;
    enabled_ = false;
    ticket_ = sink_.open();
    one_.address = number(address_);
    one_.beats = 1;
    const std::uint64_t selects = number(select_).value_or(0);
    if (width(select_) > 1) {
      std::uint64_t bit = 0;
      while (bit < 63 && (selects >> bit & 1U) == 0) ++bit;
      one_.id = bit;
      if ((selects & (selects - 1)) != 0)
        rule("APB_PSEL_ONE", edge, "several bits of PSEL are set");
    }
    const auto data = high(write_) ? write_data_ : read_data_;
    if (data) one_.size = (width(*data) + 7) / 8;
    for (Kept& kept : kept_) kept.digits = kept.slot ? digits(*kept.slot) : "";
  }
  void check_kept(const SampleEdge& edge) {
    for (Kept& kept : kept_) {
      if (!kept.slot || digits(*kept.slot) == kept.digits) continue;
      // Of a read the data to write do not count.
      if (kept.slot == write_data_ && one_.operation[0] == 'r') continue;
      rule(kept.rule, edge,
           std::string("changes from ") + kept.digits + " to " + digits(*kept.slot) +
               " during an access");
      kept.digits = digits(*kept.slot);
    }
  }
  void end(const SampleEdge& edge) {
    const bool writes = one_.operation[0] == 'w';
    const auto data = writes ? write_data_ : read_data_;
    if (data) add_data(one_, *data);
    if (writes && strobe_) one_.strobe = shown(*strobe_);
    one_.bytes = one_.size.value_or(0);
    one_.beats_done = 1;
    one_.first_data_ps = one_.last_data_ps = one_.end_ps = edge.ps;
    one_.end_cycle = edge.cycle;
    one_.response = high(error_) ? "SLVERR" : "OKAY";
    moved(edge,
          std::string("the ") + one_.operation + " of " + hexadecimal(one_.address.value_or(0)));
    close("");
  }
  void close(const std::string& note) {
    if (!note.empty()) one_.add_note(note);
    open_ = false;
    sink_.take(ticket_, std::move(one_));
  }

  Replay::Slot select_, enable_;
  std::optional<Replay::Slot> ready_, write_, address_, write_data_, read_data_, error_, strobe_;
  std::array<Kept, 4> kept_ = {{{"paddr", "APB_PADDR_STABLE", {}, {}},
                                {"pwrite", "APB_PWRITE_STABLE", {}, {}},
                                {"pwdata", "APB_PWDATA_STABLE", {}, {}},
                                {"pstrb", "APB_PSTRB_STABLE", {}, {}}}};
  bool open_ = false, enabled_ = false;
  TransactionSink::Ticket ticket_ = 0;
  Transaction one_;
  std::vector<Wait> waits_;
};

}  // namespace

std::unique_ptr<Decoder> apb_decoder(const DecoderContext& context) {
  return std::make_unique<Apb>(context);
}

}  // namespace platform::trace
