#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace vp {

/// Room for many pieces of bytes that are thrown away together, and used again: not set to zero,
/// and not given back to the system in between.
class ByteArena {
 public:
  /// Stays where it is until clear().
  char* take(std::size_t size) {
    if (size > largest_piece) {
      large_.emplace_back(new char[size]);
      return large_.back().get();
    }
    if (size > chunk_size - used_) {
      if (current_ == chunks_.size()) chunks_.emplace_back(new char[chunk_size]);
      used_ = 0;
      ++current_;
    }
    char* const piece = chunks_[current_ - 1].get() + used_;
    used_ += size;
    return piece;
  }
  void clear() {
    large_.clear();
    current_ = 0;
    used_ = chunk_size;
  }

 private:
  static constexpr std::size_t chunk_size = 1 << 20;
  /// A larger one has memory of its own, so that little is left over at the end of a chunk.
  static constexpr std::size_t largest_piece = chunk_size / 4;

  std::vector<std::unique_ptr<char[]>> chunks_, large_;
  std::size_t current_ = 0;        ///< chunks in use
  std::size_t used_ = chunk_size;  ///< of the last of them
};

}  // namespace vp
