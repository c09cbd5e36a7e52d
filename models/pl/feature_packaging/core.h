#pragma once

#include <cstdint>
#include <vector>

namespace pl {

/// A buffer of feature words of fixed depth, oldest first.
class FeatureBuffer {
 public:
  explicit FeatureBuffer(std::uint32_t depth) : words_(depth) {}

  bool has_room(std::uint32_t words) const { return count_ + words <= words_.size(); }
  std::uint32_t count() const { return count_; }

  /// Only while has_room(1).
  void push(std::uint32_t word) {
    words_[(first_ + count_) % words_.size()] = word;
    ++count_;
  }
  /// Only while count() is not 0.
  std::uint32_t pop() {
    const std::uint32_t word = words_[first_];
    first_ = first_ + 1 == words_.size() ? 0 : first_ + 1;
    --count_;
    return word;
  }
  void clear() { first_ = count_ = 0; }

 private:
  std::vector<std::uint32_t> words_;
  std::uint32_t first_ = 0, count_ = 0;
};

}  // namespace pl
