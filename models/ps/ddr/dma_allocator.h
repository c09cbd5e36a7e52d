#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

namespace ps {

/// Hands out memory for DMA buffers from one range of bus addresses, front to back; nothing is
/// given back one by one.
class DmaAllocator {
 public:
  /// The CPU's cache line: buffers share none, so that cache maintenance of one cannot touch
  /// another.
  static constexpr std::uint32_t cache_line = 32;

  /// The range [first, end).
  DmaAllocator(std::uint64_t first, std::uint64_t end) : first_(first), end_(end), next_(first) {}

  /// Bus address of `size` bytes, aligned to `alignment` (a power of two; at least a cache line).
  /// Empty if the range is used up or the alignment is no power of two.
  std::optional<std::uint32_t> allocate(std::size_t size, std::size_t alignment);
  /// All of it is free again.
  void reset() { next_ = first_; }

  std::uint64_t first() const { return first_; }
  std::uint64_t end() const { return end_; }
  std::uint64_t used() const { return next_ - first_; }

 private:
  std::uint64_t first_;
  std::uint64_t end_;
  std::uint64_t next_;
};

}  // namespace ps
