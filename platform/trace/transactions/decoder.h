#pragma once

#include <trace/tools.h>
#include <trace/transactions/survey.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace platform::trace {

/// A sampling edge: its time, and its number from 0.
struct SampleEdge {
  std::uint64_t ps = 0;
  std::uint64_t cycle = 0;
};

/// Takes what decoders find.
class TransactionSink {
 public:
  using Ticket = std::uint64_t;
  virtual ~TransactionSink() = default;
  /// A transaction begins. Each ticket is redeemed with take(), in any order.
  virtual Ticket open() = 0;
  virtual void take(Ticket ticket, Transaction transaction) = 0;
  /// A rule was broken, in a transaction or outside of any.
  virtual void broken(std::uint32_t interface, const Violation& violation) = 0;
};

/// How transactions are decoded.
struct DecodeOptions {
  std::size_t data_beats = 1;  ///< whose data are kept
  std::uint64_t max_wait = 0;  ///< clocks of VALID without READY that are reported; 0: any
};

/// What a decoder works with. All outlives it.
struct DecoderContext {
  const SurveyedInterface& surveyed;
  std::uint32_t place;  ///< of the bus among all
  Replay& replay;
  TransactionSink& sink;
  const DecodeOptions& options;
};

/// Transactions of a bus that are kept open, if it never answers; older ones are given up.
constexpr std::size_t most_open = 4096;
constexpr unsigned bits_per_byte = 8;

/// "0x6000".
std::string hexadecimal(std::uint64_t value);
/// Gives a transaction that no trace showed the data of a beat, as decoders do.
void add_word(Transaction& to, std::uint32_t word);
/// Digits of a vector as "0xf0", with x where one of four is unknown.
std::string bits_as_hexadecimal(const std::string& digits);

/// Finds the transactions of one bus.
class Decoder {
 public:
  explicit Decoder(const DecoderContext& context);
  virtual ~Decoder() = default;
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;

  /// A sampling edge: the values before the present instant count. Not called for edges that see
  /// what the one before saw, unless busy().
  virtual void edge(const SampleEdge& /*edge*/) {}
  /// The next edge matters even if nothing changes: a handshake on each is a beat on each.
  virtual bool busy() const { return false; }
  /// A signal of a bus without a clock changed in this instant.
  virtual void change(std::uint64_t /*ps*/) {}
  /// The trace is over. `edges`: of the clock in all.
  virtual void finish(std::uint64_t /*ps*/, std::uint64_t /*edges*/) {}
  /// What waits at the end, after finish().
  virtual std::vector<Wait> waits() const { return {}; }

  /// The last thing that moved, and when.
  const std::optional<SampleEdge>& moved() const { return moved_; }
  const std::string& moved_what() const { return moved_what_; }
  const std::vector<Replay::Slot>& slots() const { return slots_; }

 protected:
  /// Follows a role; none if the bus has not got it.
  std::optional<Replay::Slot> role(const std::string& name);
  /// Follows the reset, if there is one; in_reset() speaks of it.
  void follow_reset();
  bool in_reset() const {
    return reset_ && replay_.was_known(*reset_) &&
           (replay_.bits_before(*reset_) == 0) == surveyed_.bus.reset_low;
  }
  bool high(std::optional<Replay::Slot> slot, bool missing = false) const {
    return slot ? replay_.was_known(*slot) && replay_.bits_before(*slot) != 0 : missing;
  }
  std::optional<std::uint64_t> number(std::optional<Replay::Slot> slot) const {
    if (!slot || !replay_.was_known(*slot)) return std::nullopt;
    return replay_.bits_before(*slot);
  }
  const std::string& digits(Replay::Slot slot) const { return replay_.text_before(slot); }
  unsigned width(Replay::Slot slot) const { return replay_.width(slot); }
  /// "0xf00", with x where digits are unknown.
  std::string shown(Replay::Slot slot) const {
    return bits_as_hexadecimal(vp::full_digits(digits(slot), width(slot)));
  }
  /// Adds a beat's value to data and hash.
  void add_data(Transaction& to, Replay::Slot slot) const;
  void add_data(Transaction& to, std::uint64_t value) const;

  Transaction begun(const char* operation, const SampleEdge& edge) const;
  /// Of the transaction, or of none.
  void report(Violation violation, Transaction* of = nullptr) {
    sink_.broken(place_, violation);
    if (of) of->violations.push_back(std::move(violation));
  }
  void moved(const SampleEdge& edge, std::string what) {
    moved_ = edge;
    moved_what_ = std::move(what);
  }
  const SurveyedInterface& surveyed() const { return surveyed_; }

  Replay& replay_;
  TransactionSink& sink_;
  const DecodeOptions& options_;
  std::uint32_t place_;

 private:
  const SurveyedInterface& surveyed_;
  std::vector<Replay::Slot> slots_;
  std::optional<Replay::Slot> reset_;
  std::optional<SampleEdge> moved_;
  std::string moved_what_;
};

std::unique_ptr<Decoder> axi_read_decoder(const DecoderContext& context);
std::unique_ptr<Decoder> axi_write_decoder(const DecoderContext& context);
std::unique_ptr<Decoder> stream_decoder(const DecoderContext& context);
std::unique_ptr<Decoder> apb_decoder(const DecoderContext& context);
std::unique_ptr<Decoder> wishbone_decoder(const DecoderContext& context);
std::unique_ptr<Decoder> uart_decoder(const DecoderContext& context);
std::unique_ptr<Decoder> i2c_decoder(const DecoderContext& context);
std::unique_ptr<Decoder> spi_decoder(const DecoderContext& context);
std::unique_ptr<Decoder> interrupt_decoder(const DecoderContext& context);

}  // namespace platform::trace
