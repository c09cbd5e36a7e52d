#include <pl/global_threshold/core.h>

#include <pl/common/known_frames.h>

#include <algorithm>

namespace pl {

// Neighbouring pixels are often equal: eight tables, so that no increment waits for the last one.
Histogram count_levels(const std::uint8_t* pixels, std::size_t count) {
  std::array<Histogram, 8> tables{};
  std::size_t i = 0;
  for (; i + tables.size() <= count; i += tables.size()) {
    for (std::size_t t = 0; t < tables.size(); ++t) ++tables[t][pixels[i + t]];
  }
  for (; i < count; ++i) ++tables[0][pixels[i]];
  for (std::size_t t = 1; t < tables.size(); ++t) {
    for (std::size_t level = 0; level < 256; ++level) tables[0][level] += tables[t][level];
  }
  return tables[0];
}

namespace {

/// The level among `first` to `first` + 127 that reached the greatest count first, `fallback` if
/// there is no pixel. A level reached its final count with its last pixel, so among equals it is
/// the one whose last pixel came first.
std::uint8_t find_peak(const Histogram& histogram, std::size_t first, std::uint8_t fallback,
                       const std::uint8_t* pixels, std::size_t count) {
  const auto begin = histogram.begin() + static_cast<std::ptrdiff_t>(first), end = begin + 128;
  const std::uint32_t most = *std::max_element(begin, end);
  if (most == 0) return fallback;
  std::array<bool, 256> candidate{};
  std::size_t candidates = 0;
  for (std::size_t level = first; level < first + 128; ++level) {
    candidate[level] = histogram[level] == most;
    candidates += candidate[level];
  }
  for (const std::uint8_t* p = pixels + count; candidates > 1;) {
    const std::uint8_t level = *--p;
    candidates -= candidate[level];
    candidate[level] = false;
  }
  return static_cast<std::uint8_t>(std::find(candidate.begin(), candidate.end(), true) -
                                   candidate.begin());
}

}  // namespace

Peaks find_peaks(const std::uint8_t* pixels, std::size_t count) {
  const Histogram histogram = count_levels(pixels, count);
  const Peaks none;
  return {find_peak(histogram, 0, none.dark, pixels, count),
          find_peak(histogram, 128, none.bright, pixels, count)};
}

ThresholdFrame::ThresholdFrame(const Geometry& geometry) : words_(geometry.pixels() / 32) {}

void ThresholdFrame::begin(const std::uint8_t* image) {
  image_ = image;
  rewind(0);
}

void ThresholdFrame::advance(std::uint32_t pixels) {
  if (position_ % 32 != 0) advance_by_pixel(std::min(pixels, (position_ / 32 + 1) * 32));
  const std::uint32_t whole = pixels / 32 * 32;
  if (position_ < whole) {
    pack_dark(image_ + position_, (whole - position_) / 32, threshold_, &words_[position_ / 32]);
    position_ = whole;
  }
  advance_by_pixel(pixels);
}

void ThresholdFrame::advance_by_pixel(std::uint32_t to) {
  for (; position_ < to; ++position_) {
    const std::uint32_t dark = image_[position_] <= threshold_;
    words_[position_ / 32] |= dark << position_ % 32;
  }
}

void ThresholdFrame::rewind(std::uint32_t pixel) {
  position_ = pixel;
  std::size_t word = pixel / 32;
  if (pixel % 32 != 0) words_[word++] &= (1u << pixel % 32) - 1;
  std::fill(words_.begin() + static_cast<std::ptrdiff_t>(word), words_.end(), 0);
}

void ThresholdFrame::refresh(std::uint32_t first, std::uint32_t count) {
  for (std::uint32_t i = first; i < first + count; ++i) {
    const std::uint32_t bit = 1u << i % 32;
    std::uint32_t& word = words_[i / 32];
    word = image_[i] <= threshold_ ? word | bit : word & ~bit;
  }
}

std::uint8_t ThresholdFrame::next_threshold() const {
  static KnownFrames<Peaks> known;
  return known.result(image_, position_, 0, [&] { return find_peaks(image_, position_); })
      .threshold();
}

std::uint8_t ThresholdFrame::end() {
  threshold_ = next_threshold();
  return threshold_;
}

Histogram ThresholdFrame::histogram() const {
  static KnownFrames<Histogram> known;
  return known.result(image_, position_, 0, [this] { return count_levels(image_, position_); });
}

void ThresholdSearch::start(std::uint64_t due, std::optional<std::uint8_t> found) {
  due_ = found ? due : never;
  found_ = found.value_or(0);
}

std::optional<std::uint8_t> ThresholdSearch::take(std::uint64_t cycle) {
  if (cycle < due_) return std::nullopt;
  due_ = never;
  return found_;
}

}  // namespace pl
