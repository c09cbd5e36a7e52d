#pragma once

#include <marker/code_book.h>

#include <array>
#include <cstdint>

namespace improved {

/// A dictionary that the user brings, as hal_option_data() has it; its words follow.
struct DictionaryData {
  std::uint64_t cells, size, distance;
  std::uint64_t border;  ///< width of the markers' border, cells; 0: not known
};

/// A dictionary of markers with any border, and of the user's own.
///
/// The border that the detector knows is one cell wide. What is more of it counts as cells of the
/// code, which are black in each word: the detector then reads and measures them as any other.
class OwnDictionary {
 public:
  /// Words of `data`, DictionaryData and what follows it, or of `known` if that is null, inside of
  /// a border of `border` cells unless `data` says another. False: codes of these cells do not fit
  /// a border so wide (fits()).
  bool open(const marker::Dictionary& known, const void* data, std::uint32_t border);

  const marker::Dictionary& get() const { return dictionary_; }

  static constexpr bool fits(std::uint32_t cells, std::uint32_t border) {
    return cells + 2 * (border - 1) <= marker::max_code_cells;
  }

 private:
  marker::Dictionary dictionary_{};
  std::array<std::uint64_t, marker::max_dictionary_size> words_{};
};

}  // namespace improved
