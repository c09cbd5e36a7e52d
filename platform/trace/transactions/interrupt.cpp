#include <trace/transactions/decoder.h>

#include <algorithm>
#include <vector>

// Interrupt lines: a record from each rise to the fall. Of a vector each bit is a line.

namespace platform::trace {

namespace {

constexpr unsigned most_lines = 64;

class Interrupt final : public Decoder {
 public:
  explicit Interrupt(const DecoderContext& context) : Decoder(context), line_(*role("line")) {
    lines_.resize(std::min(width(line_), most_lines));
  }

  void change(std::uint64_t ps) override {
    if (!replay_.known(line_)) return;
    for (unsigned bit = 0; bit < lines_.size(); ++bit) {
      Line& line = lines_[bit];
      const bool high = (replay_.bits(line_) >> bit & 1U) != 0;
      if (high && !line.open) {
        line.open = true;
        line.one = begun("interrupt", {ps, 0});
        if (lines_.size() > 1) line.one.id = bit;
        line.ticket = sink_.open();
        moved({ps, 0}, "a rise");
      } else if (!high && line.open) {
        line.open = false;
        line.one.end_ps = ps;
        sink_.take(line.ticket, std::move(line.one));
      }
    }
  }
  void finish(std::uint64_t /*ps*/, std::uint64_t /*edges*/) override {
    for (Line& line : lines_) {
      if (!line.open) continue;
      line.one.add_note("high at the end");
      sink_.take(line.ticket, std::move(line.one));
    }
  }

 private:
  struct Line {
    bool open = false;
    TransactionSink::Ticket ticket = 0;
    Transaction one;
  };
  Replay::Slot line_;
  std::vector<Line> lines_;
};

}  // namespace

std::unique_ptr<Decoder> interrupt_decoder(const DecoderContext& context) {
  return std::make_unique<Interrupt>(context);
}

}  // namespace platform::trace
