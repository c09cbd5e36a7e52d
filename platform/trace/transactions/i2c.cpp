#include <trace/transactions/decoder.h>

// I2C: START and STOP are edges of SDA while SCL is high; bits count where SCL rises, the ninth is
// the acknowledgement. An undriven line (z, H) is high.

namespace platform::trace {

namespace {

/// Of a first byte that begins an address of ten bits: 11110xx.
constexpr std::uint64_t ten_bits = 0xf0, ten_bits_mask = 0xf8;

class I2c final : public Decoder {
 public:
  explicit I2c(const DecoderContext& context)
      : Decoder(context), clock_(*role("scl")), data_(*role("sda")) {}

  void change(std::uint64_t ps) override {
    const bool clock = is_high(clock_), data = is_high(data_);
    if (clock && clock_high_) {
      if (data_high_ && !data) start(ps);
      if (!data_high_ && data) stop(ps);
    } else if (clock && !clock_high_ && open_) {
      bit(ps, data);
    }
    clock_high_ = clock;
    data_high_ = data;
  }
  void finish(std::uint64_t /*ps*/, std::uint64_t /*edges*/) override {
    if (!open_) return;
    one_.add_note("no STOP: open at the end");
    close();
  }

 private:
  bool is_high(Replay::Slot slot) const {
    const std::string& text = replay_.text(slot);
    return text != "0" && text != "l";
  }
  void start(std::uint64_t ps) {
    if (open_) {
      check_whole(ps, "START");
      one_.end_ps = ps;
      one_.add_note("repeated START");
      close();
    }
    open_ = true;
    one_ = begun("transfer", {ps, 0});
    ticket_ = sink_.open();
    bits_ = 0;
    byte_ = 0;
    place_in_transfer_ = 0;
    wide_ = false;
  }
  void stop(std::uint64_t ps) {
    if (!open_) return;
    check_whole(ps, "STOP");
    one_.end_ps = ps;
    moved({ps, 0}, "STOP");
    close();
  }
  /// The rise of SCL before STOP or START is no bit.
  void check_whole(std::uint64_t ps, const char* what) {
    if (bits_ > 1) {
      report({"I2C_BYTE", ps, 0,
              std::string(what) + " behind bit " + std::to_string(bits_ - 1) + " of a byte"},
             &one_);
    }
  }
  void bit(std::uint64_t ps, bool data) {
    if (bits_ < bits_per_byte) {
      byte_ = byte_ << 1U | static_cast<std::uint64_t>(data);
      ++bits_;
      return;
    }
    byte(ps, !data);
    bits_ = 0;
    byte_ = 0;
  }
  void byte(std::uint64_t ps, bool acknowledged) {
    const std::uint64_t place = place_in_transfer_++;
    moved({ps, 0}, "byte " + hexadecimal(byte_));
    if (place == 0) {
      one_.operation = (byte_ & 1U) != 0 ? "read" : "write";
      one_.address = byte_ >> 1U;
      one_.accepted_ps = ps;
      one_.response = acknowledged ? "ACK" : "NACK";
      wide_ = (byte_ & ten_bits_mask) == ten_bits && (byte_ & 1U) == 0;
      wide_high_ = byte_ >> 1U & 3U;
      return;
    }
    if (place == 1 && wide_) {
      one_.address = wide_high_ << bits_per_byte | byte_;
      one_.add_note("address of 10 bits");
      if (!acknowledged) one_.response = "NACK";
      return;
    }
    ++one_.beats;
    one_.beats_done = one_.bytes = one_.beats;
    if (!one_.first_data_ps) one_.first_data_ps = ps;
    one_.last_data_ps = ps;
    add_data(one_, byte_);
    // A reader does not acknowledge the last byte.
    if (!acknowledged && one_.operation[0] == 'w') one_.response = "NACK";
  }
  void close() {
    open_ = false;
    sink_.take(ticket_, std::move(one_));
  }

  Replay::Slot clock_, data_;
  bool clock_high_ = false, data_high_ = false, open_ = false, wide_ = false;
  unsigned bits_ = 0;
  std::uint64_t byte_ = 0, place_in_transfer_ = 0, wide_high_ = 0;
  TransactionSink::Ticket ticket_ = 0;
  Transaction one_;
};

}  // namespace

std::unique_ptr<Decoder> i2c_decoder(const DecoderContext& context) {
  return std::make_unique<I2c>(context);
}

}  // namespace platform::trace
