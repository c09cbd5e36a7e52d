#include <trace/transactions/decoder.h>

#include <vp/error.h>
#include <vp/text.h>

// SPI: a transfer lasts as long as the chip is selected. CPOL is the clock's level when it begins;
// CPHA follows from which edges data change behind, unless the user gives the mode.

namespace platform::trace {

namespace {

class Spi final : public Decoder {
 public:
  explicit Spi(const DecoderContext& context)
      : Decoder(context),
        clock_(*role("sclk")),
        mosi_(role("mosi")),
        miso_(role("miso")),
        select_(role("cs")) {
    read_settings(context.surveyed.bus);
  }

  void change(std::uint64_t ps) override {
    const bool selected = is_selected();
    const bool clock = replay_.known(clock_) && replay_.bits(clock_) != 0;
    if (selected && !open_) begin(ps, clock);
    // The deselecting edge samples nothing.
    if (selected && open_ && clock != clock_high_ && replay_.known(clock_)) {
      const bool leading = clock != idle_high_;
      if (leading != second_edge_) sample(ps);
    }
    clock_high_ = clock;
    if (!selected && open_) end(ps);
  }
  void finish(std::uint64_t /*ps*/, std::uint64_t /*edges*/) override {
    if (!open_) return;
    one_.add_note(select_ ? "still selected: open at the end" : "no chip select in the trace");
    if (!select_) one_.end_ps = last_ps_;
    close();
  }

 private:
  void read_settings(const BusInterface& bus) {
    const auto choice = [&](const char* name, std::initializer_list<const char*> choices) {
      const auto found = bus.settings.find(name);
      if (found == bus.settings.end()) return std::string();
      std::vector<std::string> all(choices.begin(), choices.end());
      for (const std::string& one : all) {
        if (found->second == one) return one;
      }
      throw vp::InputError("--as '" + bus.name + "': " + name + "=" + vp::excerpt(found->second) +
                           " is not " + vp::one_of(all));
    };
    const std::string mode = choice("mode", {"0", "1", "2", "3"});
    if (!mode.empty()) mode_ = static_cast<unsigned>(mode[0] - '0');
    lowest_first_ = choice("order", {"msb", "lsb"}) == "lsb";
    selected_high_ = choice("select", {"low", "high"}) == "high";
    const std::string bits = choice("bits", {"4", "8", "12", "16", "24", "32"});
    if (!bits.empty()) word_bits_ = static_cast<unsigned>(std::stoul(bits));
  }
  bool is_selected() const {
    if (!select_) return true;
    return replay_.known(*select_) && (replay_.bits(*select_) != 0) == selected_high_;
  }
  void begin(std::uint64_t ps, bool clock) {
    open_ = true;
    clock_high_ = idle_high_ = mode_ ? *mode_ >= 2 : clock;
    // Data that change behind the first edge of a pulse are sampled on the second.
    second_edge_ =
        mode_ ? (*mode_ & 1U) != 0 : surveyed().data_after_high.value_or(idle_high_) != idle_high_;
    one_ = begun("transfer", {ps, 0});
    ticket_ = sink_.open();
    bits_ = 0;
    out_ = in_ = 0;
    last_ps_ = ps;
  }
  void shift(std::uint64_t& word, std::optional<Replay::Slot> slot) const {
    const bool high = slot && replay_.was_known(*slot) && replay_.bits_before(*slot) != 0;
    if (lowest_first_) {
      word |= static_cast<std::uint64_t>(high) << bits_;
    } else {
      word = word << 1U | static_cast<std::uint64_t>(high);
    }
  }
  void sample(std::uint64_t ps) {
    shift(out_, mosi_);
    shift(in_, miso_);
    last_ps_ = ps;
    if (++bits_ < word_bits_) return;
    ++one_.beats;
    one_.beats_done = one_.beats;
    one_.bytes += (word_bits_ + 7) / 8;
    if (!one_.first_data_ps) one_.first_data_ps = ps;
    one_.last_data_ps = ps;
    if (mosi_) add_data(one_, out_);
    if (miso_) add_data(one_, in_);
    moved({ps, 0}, "word " + hexadecimal(out_));
    bits_ = 0;
    out_ = in_ = 0;
  }
  void end(std::uint64_t ps) {
    if (bits_ != 0) {
      report({"SPI_WORD", ps, 0,
              "deselected behind " + std::to_string(bits_) + " of " + std::to_string(word_bits_) +
                  " bits"},
             &one_);
    }
    one_.end_ps = ps;
    close();
  }
  void close() {
    const unsigned mode = (idle_high_ ? 2U : 0U) + (second_edge_ ? 1U : 0U);
    one_.size = (word_bits_ + 7) / 8;
    one_.add_note("mode " + std::to_string(mode));
    open_ = false;
    sink_.take(ticket_, std::move(one_));
  }

  Replay::Slot clock_;
  std::optional<Replay::Slot> mosi_, miso_, select_;
  std::optional<unsigned> mode_;
  bool lowest_first_ = false, selected_high_ = false;
  unsigned word_bits_ = 8;
  bool open_ = false, clock_high_ = false, idle_high_ = false, second_edge_ = false;
  unsigned bits_ = 0;
  std::uint64_t out_ = 0, in_ = 0, last_ps_ = 0;
  TransactionSink::Ticket ticket_ = 0;
  Transaction one_;
};

}  // namespace

std::unique_ptr<Decoder> spi_decoder(const DecoderContext& context) {
  return std::make_unique<Spi>(context);
}

}  // namespace platform::trace
