#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace pl {

/// A row of bits in which set and clear ones are found 64 at a time.
class BitRow {
 public:
  explicit BitRow(std::uint32_t size) : words_((size + 63) / 64) {}

  std::uint32_t capacity() const { return static_cast<std::uint32_t>(words_.size()) * 64; }
  bool operator[](std::uint32_t i) const { return words_[i / 64] >> i % 64 & 1; }
  void set(std::uint32_t i) { words_[i / 64] |= std::uint64_t{1} << i % 64; }
  void reset(std::uint32_t i) { words_[i / 64] &= ~(std::uint64_t{1} << i % 64); }
  void clear() { std::fill(words_.begin(), words_.end(), 0); }

  /// Takes over `count` words of 32 bits each, the first in the lowest bits; the rest is cleared.
  void load(const std::uint32_t* source, std::uint32_t count) {
    for (std::uint64_t& word : words_) {
      word = 0;
      if (count > 0) word = *source++, --count;
      if (count > 0) word |= std::uint64_t{*source++} << 32, --count;
    }
  }

  /// The first set bit from `from` on, or capacity().
  std::uint32_t next_set(std::uint32_t from) const { return next<false>(from); }
  /// The first clear bit from `from` on, or capacity().
  std::uint32_t next_clear(std::uint32_t from) const { return next<true>(from); }

  std::uint32_t count() const {
    std::uint32_t sum = 0;
    for (std::uint64_t word : words_) sum += static_cast<std::uint32_t>(__builtin_popcountll(word));
    return sum;
  }

 private:
  template <bool inverted>
  std::uint32_t next(std::uint32_t from) const {
    const auto at = [this](std::uint32_t i) { return inverted ? ~words_[i] : words_[i]; };
    std::uint32_t i = from / 64;
    if (from >= capacity()) return capacity();
    std::uint64_t word = at(i) & ~std::uint64_t{0} << from % 64;
    while (word == 0) {
      if (++i == words_.size()) return capacity();
      word = at(i);
    }
    return i * 64 + static_cast<std::uint32_t>(__builtin_ctzll(word));
  }

  std::vector<std::uint64_t> words_;
};

}  // namespace pl
