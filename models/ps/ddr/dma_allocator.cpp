#include <ps/ddr/dma_allocator.h>
#include <algorithm>

namespace ps {

namespace {

std::uint64_t round_up(std::uint64_t value, std::uint64_t power_of_two) {
  return (value + power_of_two - 1) & ~(power_of_two - 1);
}

}  // namespace

std::optional<std::uint32_t> DmaAllocator::allocate(std::size_t size, std::size_t alignment) {
  if (alignment == 0 || (alignment & (alignment - 1)) != 0) return std::nullopt;
  const std::uint64_t range = end_ - first_;
  if (size > range || alignment > range) return std::nullopt;
  const std::uint64_t start = round_up(next_, std::max<std::uint64_t>(alignment, cache_line));
  // An empty buffer has an address of its own, too.
  const std::uint64_t end = start + round_up(std::max<std::uint64_t>(size, 1), cache_line);
  if (end > end_) return std::nullopt;
  next_ = end;
  return static_cast<std::uint32_t>(start);
}

}  // namespace ps
