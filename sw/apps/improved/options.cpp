#include <apps/improved/options.h>

namespace improved {
namespace {

enum class Option : std::uint32_t {
#define IMPROVED_ENUMERATOR(name, ...) name,
  IMPROVED_OPTIONS(IMPROVED_ENUMERATOR)
#undef IMPROVED_ENUMERATOR
      count
};

double value(Option option) {
  return hal_option(static_cast<std::uint32_t>(option));
}

std::uint32_t whole(Option option) {
  return static_cast<std::uint32_t>(value(option));
}

bool is_on(Option option) {
  return value(option) >= 0.5;
}

marker::Board read_board() {
  marker::Board board;
  const double side = value(Option::marker_side);
  const std::uint32_t columns = whole(Option::board_columns), rows = whole(Option::board_rows);
  board.kind = static_cast<marker::Board::Kind>(whole(Option::board));
  board.marker_side = side;
  board.grid = {columns, rows, side, value(Option::board_gap), whole(Option::board_first_id)};
  board.charuco = {columns, rows, value(Option::board_square), side,
                   is_on(Option::board_white_first)};
  return board;
}

const void* data_of(Option option) {
  std::size_t bytes = 0;
  return hal_option_data(static_cast<std::uint32_t>(option), &bytes);
}

}  // namespace

const hal_option_info option_table[] = {
#define IMPROVED_ROW(name, unit, default_value, minimum, maximum, documentation) \
  {#name, unit, default_value, minimum, maximum, documentation},
    IMPROVED_OPTIONS(IMPROVED_ROW)
#undef IMPROVED_ROW
};

const std::uint32_t option_count = static_cast<std::uint32_t>(Option::count);

Options read_options() {
  Options options{};
  options.dictionary = &marker::dictionaries[whole(Option::dictionary)];
  options.own_dictionary = data_of(Option::dictionary_file);
  options.border = whole(Option::border_bits);
  options.detector.minimum_side = whole(Option::minimum_side);
  options.detector.detection.white_border = whole(Option::white_border);
  options.detector.detection.fit.minimum_contrast = value(Option::minimum_contrast);
  options.detector.detection.fit.crossings = whole(Option::crossings);
  options.detector.board = read_board();
  options.optics = {static_cast<ResponseChoice>(whole(Option::response)),
                    value(Option::response_exponent), static_cast<Tries>(whole(Option::tries))};
  options.overlap = is_on(Option::overlap);
  options.second_core = is_on(Option::second_core);
  options.pose_filter = is_on(Option::pose_filter);
  options.filter = {value(Option::filter_acceleration), value(Option::filter_turn_acceleration)};
  options.timeout = value(Option::timeout);
  return options;
}

}  // namespace improved
