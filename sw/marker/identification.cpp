#include <marker/identification.h>
#include <marker/work.h>

namespace marker {
namespace {

constexpr std::uint32_t inner_cells = 4;
constexpr std::uint32_t border_cells = cells_per_side * cells_per_side - inner_cells * inner_cells;

bool is_black(const CellCounts& cells, std::uint32_t row, std::uint32_t column) {
  return 2 * cells.dark[row][column] > cells.samples_per_cell;
}

bool has_black_border(const CellCounts& cells) {
  const std::uint32_t last = cells_per_side - 1;
  for (std::uint32_t i = 0; i < cells_per_side; ++i) {
    if (!is_black(cells, 0, i) || !is_black(cells, last, i) || !is_black(cells, i, 0) ||
        !is_black(cells, i, last)) {
      return false;
    }
  }
  return true;
}

Code read_code(const CellCounts& cells) {
  Code code = 0;
  for (std::uint32_t row = 1; row <= inner_cells; ++row) {
    for (std::uint32_t column = 1; column <= inner_cells; ++column) {
      code = static_cast<Code>(code << 1 | (is_black(cells, row, column) ? 1 : 0));
    }
  }
  return code;
}

/// True and `id` set if the dictionary has this word.
bool look_up(Code code, std::uint16_t& id) {
  const Code* const known = dictionary.data();
  for (std::uint32_t i = 0; i < dictionary_size; ++i) {
    if (code == known[i]) {
      id = static_cast<std::uint16_t>(i);
      work(Work::dictionary_compares, i + 1);
      return true;
    }
  }
  work(Work::dictionary_compares, dictionary_size);
  return false;
}

}  // namespace

Identification identify(const CellCounts& cells) {
  const FunctionScope scope(Function::identification);
  Identification result{};
  work(Work::cells, border_cells);
  result.border = has_black_border(cells);
  if (!result.border) return result;

  work(Work::cells, inner_cells * inner_cells);
  result.code = read_code(cells);
  // Turned clockwise t times until upright: the marker itself is turned 4 - t quarters.
  Code turned = result.code;
  for (unsigned turns = 0; turns < 4; ++turns) {
    if (look_up(turned, result.id)) {
      result.found = true;
      result.rotation = static_cast<std::uint8_t>((4 - turns) % 4);
      return result;
    }
    turned = rotate_clockwise(turned);
    work(Work::rotations, 1);
  }
  return result;
}

}  // namespace marker
