#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace vp {

/// The changes of a block of an FST in the order of their instants, and of their nets within an
/// instant. The file has them by net: they are sorted a span of instants at a time, as long a one
/// as keeps the sorting within a processor's cache.
class FstChanges {
 public:
  enum class Form : std::uint8_t { scalar, vector, real, text };
  /// A chain as it is in the file, unpacked.
  struct Chain {
    const char* begin;
    const char* end;
    std::uint32_t net;
    Form form;
    std::uint32_t length;  ///< characters of a value that is written as it is
  };
  struct Change {
    /// Of packed vectors of up to 64 bits `bits`; else `bytes`, where the value begins. A scalar
    /// has neither.
    union {
      std::uint64_t bits;
      const char* bytes;
    };
    std::uint32_t net;
    std::uint16_t instant;  ///< counts from the start of the span
    Form form;
    std::uint8_t head;  ///< as in the file: how it is written, and a scalar's value

    /// In characters, not in bits.
    bool as_written() const { return (head & 1) != 0; }
    /// Of a scalar: 0, 1, or 2 and the place in fst::letters.
    unsigned state() const { return as_written() ? 2 + (head >> 1 & 7u) : head >> 1 & 1u; }
  };
  struct Range {
    const Change* first;
    const Change* last;
    const Change* begin() const { return first; }
    const Change* end() const { return last; }
  };

  /// A packed vector is `bits` in its Change. Others would cost a miss of the cache each.
  static constexpr std::uint32_t widest_bits = 64;

  /// What a text says.
  static std::string_view text(const Change& change);

  /// A block begins. `instants`: how many times it has.
  void begin(std::size_t instants);
  /// Chains come by net; their bytes stay where they are until the next begin(). False: its first
  /// change is damaged.
  bool add(const Chain& chain);
  /// The changes of an instant. Instants are asked for from front to back. None: a chain that
  /// changes in the span that begins here is damaged.
  std::optional<Range> at(std::size_t instant) {
    if (instant >= end_ && !fill(instant)) return std::nullopt;
    const std::size_t place = instant - first_;
    return Range{sorted_.data() + starts_[place], sorted_.data() + starts_[place + 1]};
  }

 private:
  static constexpr std::size_t longest_span = std::size_t{1} << 16;
  /// Changes that are sorted at once: some of each chain, so that coming back to it pays.
  static constexpr std::size_t fewest_sorted = std::size_t{1} << 15;
  static constexpr std::size_t most_sorted = std::size_t{1} << 18;
  static constexpr std::size_t sorted_of_chain = 4;
  static constexpr std::size_t first_span = std::size_t{1} << 8;
  static constexpr std::uint32_t never = std::numeric_limits<std::uint32_t>::max();

  /// Where the reading of a chain is: behind the head of the change that is due.
  struct Position {
    const char* next;
    std::uint64_t head;
    std::uint32_t due;  ///< instant; `never` behind the last change
  };
  enum class Outcome : std::uint8_t { whole, too_many, corrupt };

  bool fill(std::size_t first);
  Outcome collect(std::size_t first, std::size_t end);
  template <Form form>
  Outcome collect_chain(std::size_t place, std::size_t first, std::size_t end);
  template <Form form>
  bool read_head(const Chain& chain, Position& position) const;
  void sort(std::size_t instants);

  std::size_t instants_ = 0;
  std::size_t span_ = first_span;
  std::size_t limit_ = fewest_sorted;  ///< of changes in a span of several instants
  std::size_t first_ = 0, end_ = 0;    ///< of the span that is sorted
  std::vector<Chain> chains_;
  std::vector<Position> positions_;  ///< by chain
  std::vector<std::uint32_t> due_;   ///< by chain: the instant of its position, to look at quickly
  std::vector<std::pair<std::uint32_t, Position>> before_;  ///< of the chains read in this span
  std::vector<Change> collected_, sorted_;
  std::vector<std::uint32_t> starts_;  ///< by instant of the span, in `sorted_`
};

}  // namespace vp
