#include <marker/identification.h>

#include <marker/work.h>

namespace marker {

namespace {

/// The pixel nearest to a point of pixel indices. White outside; NaN compares false and is white
/// too.
bool is_dark_at(const BinaryImage& image, Point point) {
  const double x = point.x + 0.5;
  const double y = point.y + 0.5;
  if (!(x >= 0 && x < image.width && y >= 0 && y < image.height)) return false;
  return image.is_dark(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
}

std::uint32_t count_dark(const BinaryImage& image, const Homography& homography, std::uint32_t left,
                         std::uint32_t top, std::uint32_t side) {
  std::uint32_t dark = 0;
  for (std::uint32_t j = top; j < top + side; ++j) {
    for (std::uint32_t i = left; i < left + side; ++i) {
      Point point{};
      if (transform(homography, {i + 0.5, j + 0.5}, point) && is_dark_at(image, point)) ++dark;
    }
  }
  return dark;
}

}  // namespace

std::uint32_t canonical_width(double wanted) {
  if (!(wanted > min_canonical_width)) return min_canonical_width;
  if (wanted >= max_canonical_width) return max_canonical_width;
  return (static_cast<std::uint32_t>(wanted) + cells_per_side / 2) / cells_per_side *
         cells_per_side;
}

Homography make_homography(const Quad& c, double width) {
  work(Work::homographies, 1);
  const double u1 = c[0].x, v1 = c[0].y, u2 = c[1].x, v2 = c[1].y;
  const double u3 = c[2].x, v3 = c[2].y, u4 = c[3].x, v4 = c[3].y;
  const double d =
      width * (u2 * v3 - u3 * v2 - u2 * v4 + u4 * v2 + u3 * v4 - u4 * v3);  // all of D.1 to D.6
  if (!(d > 0 || d < 0)) return {0, 0, u1, 0, 0, v1, 0, 0, false};

  Homography h{};
  h.h1 = (u1 * u3 * v2 - u2 * u3 * v1 - u1 * u4 * v2 + u2 * u4 * v1 - u1 * u3 * v4 + u1 * u4 * v3 +
          u2 * u3 * v4 - u2 * u4 * v3) /
         d;
  h.h2 = (-u1 * u2 * v3 + u2 * u3 * v1 + u1 * u2 * v4 - u1 * u4 * v2 + u1 * u4 * v3 - u3 * u4 * v1 -
          u2 * u3 * v4 + u3 * u4 * v2) /
         d;
  h.u1 = u1;
  h.h4 = (u1 * v2 * v3 - u2 * v1 * v3 - u1 * v2 * v4 + u2 * v1 * v4 - u3 * v1 * v4 + u4 * v1 * v3 +
          u3 * v2 * v4 - u4 * v2 * v3) /
         d;
  h.h5 = (-u1 * v2 * v3 + u3 * v1 * v2 + u2 * v1 * v4 - u4 * v1 * v2 + u1 * v3 * v4 - u3 * v1 * v4 -
          u2 * v3 * v4 + u4 * v2 * v3) /
         d;
  h.v1 = v1;
  h.h7 = (u1 * v3 - u3 * v1 - u1 * v4 - u2 * v3 + u3 * v2 + u4 * v1 + u2 * v4 - u4 * v2) / d;
  h.h8 = (-u1 * v2 + u2 * v1 + u1 * v4 - u2 * v3 + u3 * v2 - u4 * v1 - u3 * v4 + u4 * v3) / d;
  h.valid = true;
  return h;
}

bool transform(const Homography& h, Point canonical, Point& image) {
  const double w = h.h7 * canonical.x + h.h8 * canonical.y + 1;
  if (!(w > 0)) return false;
  image.x = (h.h1 * canonical.x + h.h2 * canonical.y + h.u1) / w;
  image.y = (h.h4 * canonical.x + h.h5 * canonical.y + h.v1) / w;
  return true;
}

void rectify(const BinaryImage& image, const Homography& homography, std::uint32_t width,
             CellCounts& cells) {
  const FunctionScope scope(Function::rectification);
  const std::uint32_t cell = width / cells_per_side;
  const std::uint32_t side = cell - 2;
  cells.samples_per_cell = side * side;
  for (std::uint32_t row = 0; row < cells_per_side; ++row) {
    for (std::uint32_t column = 0; column < cells_per_side; ++column) {
      cells.dark[row][column] =
          count_dark(image, homography, column * cell + 1, row * cell + 1, side);
    }
  }
  const std::uint32_t samples = cells_per_side * cells_per_side * cells.samples_per_cell;
  work(Work::grid_samples, samples);
  if (image.in_dma_memory) work(Work::grid_samples_dma, samples);
}

// DICT_4X4_250 of the ArUco library, inverted: 1 = black.
const std::array<Code, dictionary_size> dictionary = {
    0x4ACD, 0xF065, 0xCCD2, 0x66B9, 0xAB61, 0x8632, 0x61D1, 0x3B0D, 0x0125, 0x30A9, 0x066E, 0xEE58,
    0xF148, 0xD5F0, 0xDB4E, 0xD9C1, 0xB99A, 0x99FF, 0x93A1, 0x8950, 0x7974, 0x4FD4, 0x332A, 0x227D,
    0x01B8, 0x6B8E, 0x531B, 0x5AAB, 0xDEDC, 0xCB90, 0xBBEA, 0xA84D, 0x6130, 0x0F34, 0xF751, 0xF6D6,
    0xE78A, 0xFB00, 0xF209, 0xE3A5, 0xE8E7, 0xD5D7, 0xCD73, 0xC74D, 0xDB17, 0xD114, 0xD2C0, 0xB49B,
    0xAFD1, 0xAFEC, 0xAE6B, 0xAA97, 0xA2BE, 0xA068, 0x97FE, 0x9798, 0x9EDB, 0x9E16, 0x94ED, 0x901A,
    0x9820, 0x81E4, 0x7F5F, 0x7CBB, 0x745D, 0x6C85, 0x7B93, 0x7AD5, 0x7A63, 0x6376, 0x605E, 0x4483,
    0x43FB, 0x49A4, 0x4037, 0x4854, 0x35E0, 0x369D, 0x26A7, 0x2C2A, 0x3367, 0x385F, 0x3AC8, 0x16A2,
    0x06DA, 0x0444, 0x11D5, 0x08B2, 0xCA8A, 0x7552, 0x89E8, 0xF530, 0xF9B4, 0xD23E, 0xB627, 0xBC0B,
    0xB0C9, 0xB02C, 0x961B, 0x8F38, 0x8591, 0x4B15, 0x12B0, 0x0318, 0x0159, 0xFFDA, 0xFFBC, 0xF577,
    0xF579, 0xFD90, 0xFFE3, 0xFF68, 0xF7C8, 0xF5CE, 0xF639, 0xF4FE, 0xF604, 0xF4A7, 0xEF7D, 0xE7D2,
    0xEF87, 0xEF8C, 0xED8B, 0xED4E, 0xE506, 0xECF9, 0xF3F1, 0xF30E, 0xFBCC, 0xF360, 0xF10D, 0xF102,
    0xF8B3, 0xF05B, 0xF8D0, 0xFA4A, 0xF06E, 0xF824, 0xE11B, 0xEBC6, 0xE27F, 0xEA37, 0xE074, 0xEA45,
    0xE24E, 0xDF7F, 0xD716, 0xDD5D, 0xD7AC, 0xD50F, 0xDD08, 0xD6BF, 0xDEB9, 0xD646, 0xD463, 0xD44D,
    0xC735, 0xC7D1, 0xCFF8, 0xC718, 0xC5B6, 0xC59A, 0xCDA2, 0xC477, 0xC6E2, 0xC42C, 0xD9B8, 0xD87F,
    0xD055, 0xD2EB, 0xDA21, 0xDAAC, 0xD088, 0xCBB7, 0xC357, 0xC3BE, 0xCBF2, 0xCB04, 0xC965, 0xC21F,
    0xCA95, 0xC2F6, 0xC212, 0xC03B, 0xC093, 0xC831, 0xC2A3, 0xC289, 0xC84F, 0xC0E8, 0xC000, 0xB71A,
    0xBD97, 0xB5D2, 0xBE9F, 0xB6AE, 0xBE22, 0xB420, 0xA7B0, 0xA5B7, 0xA7E9, 0xAFA2, 0xA505, 0xA54A,
    0xAEDC, 0xA475, 0xA6E6, 0xAECA, 0xB396, 0xB93E, 0xB1F4, 0xBBA0, 0xB1A6, 0xB27C, 0xB282, 0xB827,
    0xB88C, 0xA37A, 0xA1BB, 0xA9D4, 0xA344, 0xAA3C, 0xA091, 0xA014, 0xA2ED, 0xAAA1, 0x9D8F, 0x9DEA,
    0x9E3D, 0x94DF, 0x9CBA, 0x94A3, 0x94A4, 0x87F3, 0x8530, 0x8780, 0x867F, 0x8E1A, 0x8E8B, 0x8649,
    0x8E2C, 0x84CC, 0x9B95, 0x9957, 0x9158, 0x916E, 0x9ADD, 0x9234, 0x9872, 0x92CE};

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
