#pragma once

#include <cstddef>
#include <cstdint>

namespace pl {

/// Packs 32 pixels a word, the first in bit 0: 1 if a pixel is not above `threshold`. Reads and
/// writes nothing beyond the `words` words.
void pack_dark(const std::uint8_t* pixels, std::size_t words, std::uint8_t threshold,
               std::uint32_t* binary);

}  // namespace pl
