#pragma once

#include <cstdint>

namespace xilinx {

/// Block memories of 36 kbit that a simple dual-port RAM of `depth` words of `width` bits takes in
/// the 7 series, in halves (a block is two of 18 kbit): the fewest over the aspect ratios of UG473
/// (32K × 1, 16K × 2, 8K × 4, 4K × 9, 2K × 18, 1K × 36, 512 × 72), as the Block Memory Generator's
/// minimum-area choice. `parity` false: the ninth bits are not used, as where the two ports differ
/// in width.
double block_ram_36(std::uint64_t depth, std::uint32_t width, bool parity = true);

}  // namespace xilinx
