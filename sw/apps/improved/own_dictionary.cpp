#include <apps/improved/own_dictionary.h>

#include <algorithm>

namespace improved {
namespace {

/// CodeBook corrects no more than nine cells.
constexpr std::uint64_t most_distance = 20;

/// A word of `cells` × `cells` inside of `more` rings of black cells.
std::uint64_t ringed(std::uint64_t word, std::uint32_t cells, std::uint32_t more) {
  const std::uint32_t side = cells + 2 * more;
  std::uint64_t result = 0;
  for (std::uint32_t row = 0; row < side; ++row) {
    for (std::uint32_t column = 0; column < side; ++column) {
      // Cells before the code wrap to large numbers.
      const std::uint32_t r = row - more, c = column - more;
      const bool is_code = r < cells && c < cells;
      const std::uint64_t black =
          is_code ? word >> (cells * cells - 1 - (r * cells + c)) & 1u : std::uint64_t{1};
      result = result << 1 | black;
    }
  }
  return result;
}

}  // namespace

bool OwnDictionary::open(const marker::Dictionary& known, const void* data, std::uint32_t border) {
  dictionary_ = known;
  if (data != nullptr) {
    const auto* const head = static_cast<const DictionaryData*>(data);
    dictionary_ = {"own", static_cast<std::uint32_t>(head->cells),
                   static_cast<std::uint32_t>(head->size),
                   static_cast<std::uint32_t>(std::min(head->distance, most_distance)),
                   reinterpret_cast<const std::uint64_t*>(head + 1)};
    if (head->border != 0) border = static_cast<std::uint32_t>(head->border);
  }
  if (!fits(dictionary_.cells, border)) return false;
  if (border == 1) return true;
  for (std::uint32_t id = 0; id < dictionary_.size; ++id)
    words_[id] = ringed(dictionary_.words[id], dictionary_.cells, border - 1);
  dictionary_.words = words_.data();
  dictionary_.cells += 2 * (border - 1);
  return true;
}

}  // namespace improved
