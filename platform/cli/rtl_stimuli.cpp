#include <cli/rtl_stimuli.h>

#include <vp/error.h>
#include <vp/file.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <set>
#include <sstream>

namespace platform::cli {

namespace {

/// The same numbers on each machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint32_t below(std::uint32_t limit) {
    state_ = state_ * 6'364'136'223'846'793'005u + 1'442'695'040'888'963'407u;
    return static_cast<std::uint32_t>((state_ >> 33) % limit);
  }

 private:
  std::uint64_t state_;
};

struct Picture {
  int width, height;
  std::vector<std::uint8_t> pixels;

  Picture(int w, int h, std::uint8_t level)
      : width(w),
        height(h),
        pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), level) {}
  std::uint8_t& at(int x, int y) {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
  void fill(const std::function<int(int x, int y)>& level) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) at(x, y) = static_cast<std::uint8_t>(level(x, y));
    }
  }
  void box(int x0, int y0, int x1, int y1, int level) {
    for (int y = y0; y <= y1 && y < height; ++y) {
      for (int x = x0; x <= x1 && x < width; ++x) at(x, y) = static_cast<std::uint8_t>(level);
    }
  }
};

/// Boxes of all sizes, down to a pixel, at the borders too.
void boxes(Picture& picture, std::uint64_t seed, int count) {
  Random random(seed);
  for (int i = 0; i < count; ++i) {
    const auto x = static_cast<int>(random.below(static_cast<std::uint32_t>(picture.width)));
    const auto y = static_cast<int>(random.below(static_cast<std::uint32_t>(picture.height)));
    const auto most = static_cast<std::uint32_t>(24 + picture.width / 12);
    const auto size = [&] { return static_cast<int>(random.below(2 + random.below(most))); };
    const int right = x + size(), below = y + size();
    picture.box(
        x, y, right, below,
        static_cast<int>(random.below(3) != 0 ? 20 + random.below(60) : 180 + random.below(70)));
  }
}

/// A V of dark lines: two runs each row that become one blob at the end, or one that forks.
bool in_wedge(int x, int y, int period) {
  const int at = x % period, depth = y % period;
  return at == depth / 2 || at == period - 1 - depth / 2;
}

/// Blobs with a gap of one pixel beside either border, or that end one to four pixels before it.
bool touches_edge(int x, int y, int w) {
  const int side = w < 320 ? 2 : 28, band = y / (2 * side);
  if (y % (2 * side) >= side) return false;
  const int right = w - 1 - x;
  const bool at_left = x == 0 || (x >= 2 && x < 2 + side);
  const bool at_right =
      (band % 2 == 0 && right == 0) || (right >= 1 + band % 4 && right < 1 + band % 4 + side);
  return at_left || at_right;
}

std::vector<std::pair<std::string, Picture>> pictures(int w, int h) {
  std::vector<std::pair<std::string, Picture>> all;
  const auto add = [&](const std::string& name, int level) -> Picture& {
    return all.emplace_back(name, Picture(w, h, static_cast<std::uint8_t>(level))).second;
  };
  Random random(7);
  const auto any = [&](std::uint32_t limit) { return static_cast<int>(random.below(limit)); };
  all.reserve(32);
  // The first ones are played longest, and the last ones are left out where there are many pixels.
  add("boxes", 200);
  boxes(all.back().second, 3, w * h / 400 + 8);
  const int period = w < 320 ? 5 : 32, dark = w < 320 ? 3 : 26;
  add("grid", 200).fill([=](int x, int y) {
    return x % period < dark && y % period < dark ? 20 : 200;
  });
  add("few_levels", 0).fill([&](int, int) { return any(4) * 70; });
  add("noise", 0).fill([&](int, int) { return any(256); });
  add("bars", 200).fill([=](int x, int y) { return x % period < dark && y > h / 2 ? 20 : 200; });
  // As many of one level as of another, of which the first counts; then more than there were
  // before.
  add("equal_levels", 0).fill([](int x, int) { return std::array{20, 60, 180, 240}[x % 4]; });
  add("dark_majority", 0).fill([h](int, int y) { return y < h * 45 / 100 ? 30 : 70; });
  add("bright_majority", 0).fill([h](int, int y) { return y < h * 45 / 100 ? 200 : 240; });
  add("edges", 200).fill([w](int x, int y) { return touches_edge(x, y, w) ? 20 : 200; });
  // The tooth at the left edge begins when the others have taken all labels.
  add("comb", 200).fill([&](int x, int y) {
    return x % 4 < 2 && y >= h * 5 / 8 + (x < 2 ? 2 : 0) ? 20 : 200;
  });
  add("checkerboard", 0).fill([](int x, int y) { return (x + y) % 2 != 0 ? 230 : 25; });
  add("dots", 210);
  for (int i = 0; i < w * h / 60; ++i) {
    const int x = any(static_cast<std::uint32_t>(w));
    all.back().second.at(x, any(static_cast<std::uint32_t>(h))) = 15;
  }
  add("wedges", 0).fill([w](int x, int y) { return in_wedge(x, y, w < 320 ? 16 : 48) ? 30 : 220; });
  add("black", 0);
  add("boxes_on_black", 3);
  boxes(all.back().second, 11, w * h / 800 + 4);
  add("soft_noise", 0).fill([&](int x, int y) {
    return 60 + (x * 120) / w + (y * 40) / h + any(30);
  });
  add("lines", 0).fill([](int x, int y) { return x % 8 == 0 || y % 16 == 0 ? 40 : 170; });
  add("squares", 0).fill([](int x, int y) { return (x / 7 + y / 5) % 2 != 0 ? 190 : 45; });
  add("white", 255);
  add("border", 220).fill([&](int x, int y) {
    return x < 2 || y < 2 || x >= w - 2 || y >= h - 2 || (x % 32 == 31) ? 10 : 220;
  });
  return all;
}

}  // namespace

std::vector<StimulusPicture> stimulus_pictures(int width, int height) {
  std::vector<StimulusPicture> all;
  for (auto& [name, picture] : pictures(width, height))
    all.push_back({name, std::move(picture.pixels)});
  return all;
}

std::vector<std::string> write_stimuli(const std::string& folder, int width, int height) {
  std::vector<std::string> files;
  for (const auto& [name, pixels] : stimulus_pictures(width, height)) {
    files.push_back((std::filesystem::path(folder) / (name + ".pgm")).string());
    std::string text = "P5\n" + std::to_string(width) + " " + std::to_string(height) + "\n255\n";
    text.append(pixels.begin(), pixels.end());
    vp::write_file(files.back(), text);
  }
  return files;
}

RecordedPins read_recorded(const std::string& file) {
  std::istringstream lines(vp::read_text(file, "stimulus"));
  RecordedPins pins;
  std::string line;
  std::getline(lines, line);
  std::istringstream names(line);
  for (std::string name; names >> name;) pins.names.push_back(name);
  std::size_t number = 1;
  const auto refuse = [&](const std::string& why) {
    throw vp::InputError("stimulus '" + file + "', line " + std::to_string(number) + ": " + why);
  };
  if (pins.names.empty()) refuse("give the names of the inputs");
  if (std::set<std::string>(pins.names.begin(), pins.names.end()).size() != pins.names.size())
    refuse("each input has a name of its own");
  while (std::getline(lines, line)) {
    ++number;
    if (line.find_first_of("+-") != std::string::npos) refuse("numbers have no sign");
    std::istringstream words(line);
    std::vector<std::uint64_t>& row = pins.rows.emplace_back();
    for (std::uint64_t value = 0; words >> std::hex >> value;) row.push_back(value);
    if (!words.eof() || row.size() != pins.names.size())
      refuse("give " + std::to_string(pins.names.size()) + " hexadecimal numbers");
  }
  if (pins.rows.empty()) refuse("no clock follows the names");
  return pins;
}

}  // namespace platform::cli
