#include "random_pictures.h"

#include <algorithm>

using harness::Random;

namespace labelling {

namespace {

template <class Dark>
Binary draw(std::uint32_t width, std::uint32_t height, Dark dark) {
  Binary picture{width, height, {}};
  picture.pixels.reserve(picture.count());
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) picture.pixels.push_back(dark(x, y));
  }
  return picture;
}

/// Rings one pixel apart around the middle of the lower edge, their legs open: they close from
/// inside to outside where the row under them is dark.
Binary arches(std::uint32_t width, std::uint32_t height, std::uint32_t joined_row) {
  return draw(width, height, [&](std::uint32_t x, std::uint32_t y) {
    const std::uint32_t from_side = std::min(x, width - 1 - x);
    return y == joined_row ? x > width / 2 : std::min(from_side, y) % 2 == 0;
  });
}

/// A snake one pixel wide from the border to the middle.
Binary spiral(std::uint32_t width, std::uint32_t height) {
  Binary picture = draw(width, height, [](auto, auto) { return false; });
  const int w = static_cast<int>(width), h = static_cast<int>(height);
  const auto dark = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < w && y < h &&
           picture.pixels[static_cast<std::size_t>(y * w + x)] != 0;
  };
  int x = 0, y = 0, dx = 1, dy = 0;
  for (int turns = 0; turns < 2;) {
    picture.pixels[static_cast<std::size_t>(y * w + x)] = 1;
    const int nx = x + dx, ny = y + dy;
    const bool blocked =
        nx < 0 || ny < 0 || nx >= w || ny >= h || dark(nx, ny) || dark(nx + dx, ny + dy);
    if (blocked) {
      const int turned = dx;
      dx = -dy;
      dy = turned;
      ++turns;
    } else {
      x = nx;
      y = ny;
      turns = 0;
    }
  }
  return picture;
}

}  // namespace

std::vector<std::uint32_t> Binary::words() const {
  std::vector<std::uint32_t> words((pixels.size() + 31) / 32);
  for (std::size_t i = 0; i < pixels.size(); ++i)
    words[i / 32] |= std::uint32_t{pixels[i]} << i % 32;
  return words;
}

std::uint32_t group_at(const Binary& picture, std::uint32_t first, std::uint32_t pixels) {
  std::uint32_t group = 0;
  for (std::uint32_t i = 0; i < pixels; ++i) group |= std::uint32_t{picture.pixels[first + i]} << i;
  return group;
}

Binary drawn(const std::vector<std::string>& rows) {
  const auto width = static_cast<std::uint32_t>(rows.front().size());
  return draw(width, static_cast<std::uint32_t>(rows.size()),
              [&](std::uint32_t x, std::uint32_t y) { return rows[y][x] == '#'; });
}

Binary random_picture(Random& random, std::uint32_t width, std::uint32_t height) {
  const std::uint32_t share = random.below(1000), kind = random.below(6);
  const auto chance = [&random](std::uint32_t of_1000) { return random.below(1000) < of_1000; };
  switch (kind) {
    case 0:  // rows of dots, and lines that join some of them
      return draw(width, height, [&](std::uint32_t, std::uint32_t y) {
        return chance(y % 2 == 0 ? share : 1000 - share);
      });
    case 1:
      return draw(width, height, [&](std::uint32_t x, std::uint32_t y) {
        return ((x + y) % 2 == 0) != chance(share / 8);
      });
    case 2: {
      Binary picture = arches(width, height, random.below(height));
      for (std::uint8_t& pixel : picture.pixels) pixel ^= chance(share / 20);
      return picture;
    }
    default:
      return draw(width, height, [&](auto, auto) { return chance(share); });
  }
}

std::vector<Binary> hard_shapes() {
  const std::uint32_t width = 64, height = 48;
  return {
      draw(width, height, [](auto, auto) { return true; }),
      draw(width, height, [](auto, auto) { return false; }),
      draw(width, height, [](auto x, auto y) { return (x + y) % 2 == 0; }),
      draw(width, height, [](auto x, auto y) { return x % 2 == 0 && y % 2 == 0; }),
      draw(width, height, [](auto x, auto) { return x % 2 == 0; }),
      draw(width, height, [](auto x, auto y) { return x % 2 == 0 || y == 47; }),  // comb
      draw(width, height, [](auto x, auto y) { return x % 2 == 0 || y == 0; }),
      draw(width, height, [](auto x, auto y) { return (x + 3 * y) % 11 < 4; }),
      draw(width, height, [](auto x, auto y) { return (x + 60 - y) % 9 < 2; }),
      // U: two stems that only the last row joins, and dots at the ends of rows
      draw(width, height, [](auto x, auto y) { return x < 3 || x > 60 || (y == 47 && x != 30); }),
      draw(width, height,
           [](auto x, auto y) { return (x == 63 && y % 2 == 0) || (x == 0 && y % 2 == 1); }),
      arches(width, height, 47),
      arches(width, height, 25),
      spiral(width, height),
  };
}

std::vector<pl::Extremes> flood_fill(const Binary& picture) {
  std::vector<std::uint8_t> left = picture.pixels;
  std::vector<pl::Extremes> found;
  std::vector<std::uint32_t> stack;
  for (std::uint32_t start = 0; start < picture.count(); ++start) {
    if (!left[start]) continue;
    const std::uint32_t width = picture.width;
    pl::Extremes extremes(start % width, start % width, start / width);
    left[start] = 0;
    stack = {start};
    while (!stack.empty()) {
      const std::uint32_t x = stack.back() % width, y = stack.back() / width;
      stack.pop_back();
      extremes.join(pl::Extremes(x, x, y));
      for (std::uint32_t ny = y - (y > 0); ny <= std::min(y + 1, picture.height - 1); ++ny) {
        for (std::uint32_t nx = x - (x > 0); nx <= std::min(x + 1, width - 1); ++nx) {
          const std::uint32_t neighbour = ny * width + nx;
          if (!left[neighbour]) continue;
          left[neighbour] = 0;
          stack.push_back(neighbour);
        }
      }
    }
    found.push_back(extremes);
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace labelling
