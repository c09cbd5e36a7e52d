#include <xilinx/bram/block_ram.h>

#include <algorithm>
#include <limits>

namespace xilinx {

namespace {

struct AspectRatio {
  std::uint64_t depth;
  std::uint32_t width;   ///< with the parity bits
  std::uint32_t powers;  ///< without
};

/// Of a block of 36 kbit (UG473 table 1-7); a block of 18 kbit is half as deep.
constexpr AspectRatio ratios[] = {{32768, 1, 1},  {16384, 2, 2},  {8192, 4, 4}, {4096, 9, 8},
                                  {2048, 18, 16}, {1024, 36, 32}, {512, 72, 64}};

double blocks_of(const AspectRatio& ratio, std::uint64_t depth, std::uint32_t width, bool parity) {
  const std::uint32_t each = parity ? ratio.width : ratio.powers;
  const std::uint64_t columns = (width + each - 1) / each;
  const std::uint64_t rest = depth % ratio.depth;
  const double last_row = rest == 0 ? 0 : rest <= ratio.depth / 2 ? 0.5 : 1;
  return static_cast<double>(columns) * (static_cast<double>(depth / ratio.depth) + last_row);
}

}  // namespace

double block_ram_36(std::uint64_t depth, std::uint32_t width, bool parity) {
  double fewest = std::numeric_limits<double>::max();
  for (const AspectRatio& ratio : ratios) {
    fewest = std::min(fewest, blocks_of(ratio, depth, width, parity));
  }
  return fewest;
}

}  // namespace xilinx
