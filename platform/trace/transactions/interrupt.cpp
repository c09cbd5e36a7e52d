#include <trace/transactions/decoder.h>

#include <algorithm>
#include <vector>

#include <vp/error.h>
#include <vp/text.h>

// Interrupt lines: a record from the time a line becomes active until it is not. Of a vector each
// bit is a line.

namespace platform::trace {

namespace {

constexpr unsigned most_lines = 64;

class Interrupt final : public Decoder {
 public:
  explicit Interrupt(const DecoderContext& context) : Decoder(context), line_(*role("line")) {
    lines_.resize(std::min(width(line_), most_lines));
    const auto& settings = context.surveyed.bus.settings;
    const auto active = settings.find("active");
    active_low_ = active != settings.end() && active->second == "low";
    if (active != settings.end() && !active_low_ && active->second != "high") {
      throw vp::InputError("--as '" + context.surveyed.bus.name +
                           "': active=" + vp::excerpt(active->second) + " is not low or high");
    }
  }

  void change(std::uint64_t ps) override {
    if (!replay_.known(line_)) return;
    for (unsigned bit = 0; bit < lines_.size(); ++bit) {
      Line& line = lines_[bit];
      const bool active = ((replay_.bits(line_) >> bit & 1U) == 0) == active_low_;
      if (active && !line.open) {
        line.open = true;
        line.one = begun("interrupt", {ps, 0});
        if (lines_.size() > 1) line.one.id = bit;
        line.ticket = sink_.open();
        moved({ps, 0}, "an interrupt");
      } else if (!active && line.open) {
        line.open = false;
        line.one.end_ps = ps;
        sink_.take(line.ticket, std::move(line.one));
      }
    }
  }
  void finish(std::uint64_t /*ps*/, std::uint64_t /*edges*/) override {
    for (Line& line : lines_) {
      if (!line.open) continue;
      line.one.add_note("active at the end");
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
  bool active_low_ = false;
  std::vector<Line> lines_;
};

}  // namespace

std::unique_ptr<Decoder> interrupt_decoder(const DecoderContext& context) {
  return std::make_unique<Interrupt>(context);
}

}  // namespace platform::trace
