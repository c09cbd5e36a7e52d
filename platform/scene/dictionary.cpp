#include <scene/dictionary.h>

#include <marker/dictionary.h>

#include <vp/error.h>
#include <string>

namespace platform {

static_assert(dictionary_size == marker::dictionary_size);

const std::array<std::uint16_t, dictionary_size>& dictionary() {
  return marker::dictionary;
}

std::uint16_t marker_word(int id) {
  if (id < 0 || id >= dictionary_size) {
    throw vp::InputError("marker ID " + std::to_string(id) + " is not in DICT_4X4_250: give 0 to " +
                         std::to_string(dictionary_size - 1));
  }
  return marker::dictionary[static_cast<std::size_t>(id)];
}

bool is_black(std::uint16_t word, int row, int column) {
  return ((word >> (15 - (4 * row + column))) & 1) != 0;
}

}  // namespace platform
