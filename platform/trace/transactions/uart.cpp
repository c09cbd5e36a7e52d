#include <trace/transactions/decoder.h>

#include <vp/error.h>
#include <vp/text.h>
#include <vp/unit.h>

namespace platform::trace {

namespace {

constexpr std::uint64_t second_ps = 1'000'000'000'000;

/// A whole number among the settings that a user gave.
std::uint64_t setting(const BusInterface& bus, const std::string& name, std::uint64_t usual,
                      std::uint64_t least, std::uint64_t most) {
  const auto found = bus.settings.find(name);
  if (found == bus.settings.end()) return usual;
  const auto number = vp::Decimal::parse(found->second);
  const auto whole = number ? number->whole() : std::nullopt;
  if (!whole || *whole < static_cast<vp::Decimal::Whole>(least) ||
      *whole > static_cast<vp::Decimal::Whole>(most)) {
    throw vp::InputError("--as '" + bus.name + "': " + name + "=" + vp::excerpt(found->second) +
                         " is not a whole number from " + std::to_string(least) + " to " +
                         std::to_string(most));
  }
  return static_cast<std::uint64_t>(*whole);
}

enum class Parity : std::uint8_t { none, even, odd };

Parity parity_of(const BusInterface& bus) {
  const auto found = bus.settings.find("parity");
  if (found == bus.settings.end() || found->second == "none") return Parity::none;
  if (found->second == "even") return Parity::even;
  if (found->second == "odd") return Parity::odd;
  throw vp::InputError("--as '" + bus.name + "': parity=" + vp::excerpt(found->second) +
                       " is not none, even or odd");
}

/// A line of a UART: start bit, data with the lowest bit first, parity, stop bit.
class Uart final : public Decoder {
 public:
  explicit Uart(const DecoderContext& context)
      : Decoder(context),
        line_(*role("line")),
        bits_(setting(context.surveyed.bus, "bits", 8, 5, 9)),
        parity_(parity_of(context.surveyed.bus)),
        bit_ps_(context.surveyed.bit_ps) {
    const std::uint64_t baud = setting(context.surveyed.bus, "baud", 0, 1, second_ps / 10);
    if (baud != 0) bit_ps_ = (second_ps + baud / 2) / baud;
  }

  void change(std::uint64_t ps) override {
    advance(ps);
    const bool falls = high_ && replay_.known(line_) && replay_.bits(line_) == 0;
    high_ = !replay_.known(line_) || replay_.bits(line_) != 0;
    if (high_) in_break_ = false;
    if (falls && !in_frame_ && !in_break_ && bit_ps_ != 0) begin(ps);
  }
  void finish(std::uint64_t ps, std::uint64_t /*edges*/) override {
    advance(ps);
    if (!in_frame_) return;
    one_.add_note("open at the end");
    sink_.take(ticket_, std::move(one_));
  }

 private:
  std::uint64_t slots_in_frame() const { return 1 + bits_ + (parity_ == Parity::none ? 0 : 1) + 1; }
  void begin(std::uint64_t ps) {
    in_frame_ = true;
    next_ = 0;
    value_ = 0;
    ones_ = 0;
    one_ = begun("byte", {ps, 0});
    one_.beats = 1;
    ticket_ = sink_.open();
  }
  /// Samples the middles of the bits before `ps`, in which the line had the value `high_`.
  void advance(std::uint64_t ps) {
    while (in_frame_) {
      const std::uint64_t middle = one_.begin_ps + next_ * bit_ps_ + bit_ps_ / 2;
      if (middle >= ps) return;
      sample(next_++);
    }
  }
  void sample(std::uint64_t place) {
    if (place == 0) {
      // A pulse shorter than half a bit is no start bit.
      if (high_) drop("UART_START", "the start bit is shorter than half a bit");
      return;
    }
    if (place <= bits_) {
      value_ |= static_cast<std::uint64_t>(high_) << (place - 1);
      ones_ += high_ ? 1 : 0;
    } else if (place + 1 < slots_in_frame()) {
      const bool odd = (ones_ + (high_ ? 1 : 0)) % 2 != 0;
      if (odd != (parity_ == Parity::odd)) rule("UART_PARITY", place, "the parity is wrong");
    } else {
      stop(place);
    }
  }
  void stop(std::uint64_t place) {
    if (!high_) {
      in_break_ = true;
      const bool is_break = value_ == 0;
      rule(is_break ? "UART_BREAK" : "UART_FRAMING", place,
           is_break ? "the line stays low" : "the stop bit is low");
    }
    one_.end_ps = one_.begin_ps + slots_in_frame() * bit_ps_;
    one_.accepted_ps = one_.begin_ps;
    one_.first_data_ps = one_.last_data_ps = one_.end_ps;
    one_.beats_done = one_.bytes = 1;
    add_data(one_, value_);
    constexpr std::uint64_t blank = 0x20, last = 0x7e;
    if (value_ >= blank && value_ <= last)
      one_.add_note("'" + std::string(1, static_cast<char>(value_)) + "'");
    in_frame_ = false;
    moved({*one_.end_ps, 0}, "byte " + hexadecimal(value_));
    sink_.take(ticket_, std::move(one_));
  }
  void rule(const char* name, std::uint64_t place, const char* detail) {
    report({name, one_.begin_ps + place * bit_ps_ + bit_ps_ / 2, 0, detail}, &one_);
  }
  void drop(const char* name, const char* detail) {
    rule(name, 0, detail);
    in_frame_ = false;
    one_.add_note("not a byte");
    sink_.take(ticket_, std::move(one_));
  }

  Replay::Slot line_;
  std::uint64_t bits_;
  Parity parity_;
  std::uint64_t bit_ps_;
  bool high_ = true, in_frame_ = false, in_break_ = false;
  std::uint64_t next_ = 0, value_ = 0, ones_ = 0;
  TransactionSink::Ticket ticket_ = 0;
  Transaction one_;
};

}  // namespace

std::unique_ptr<Decoder> uart_decoder(const DecoderContext& context) {
  return std::make_unique<Uart>(context);
}

}  // namespace platform::trace
