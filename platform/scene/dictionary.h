#pragma once

#include <array>
#include <cstdint>

namespace platform {

/// Markers in ArUco's DICT_4X4_250.
constexpr int dictionary_size = 250;

/// The words of DICT_4X4_250, by ID: 4x4 cells row by row, the top left one in bit 15; 1 = black as
/// in the thesis (OpenCV has 1 = white).
const std::array<std::uint16_t, dictionary_size>& dictionary();

/// The word of one marker. Throws vp::InputError if `id` is not 0 to 249.
std::uint16_t marker_word(int id);

/// Colour of one of the 4x4 cells, row and column 0 to 3 from the top left.
bool is_black(std::uint16_t word, int row, int column);

}  // namespace platform
