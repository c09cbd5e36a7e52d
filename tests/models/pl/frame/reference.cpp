#include "reference.h"

#include <marker_logic.h>
#include <pl/corner_detection/core.h>

using harness::Image;
using harness::Word;

std::vector<Word> reference_corners(const Image& image, const pl::Geometry& g,
                                    std::uint32_t threshold) {
  pl::CornerCore core(g, threshold);
  std::vector<Word> words;
  for (std::uint32_t i = 0; i < g.pixels(); ++i) {
    pl::Corner c;
    if (!core.push(image[i], i % g.width, i / g.width, c)) continue;
    words.push_back({'C', 7 + i, g.words().corner(c.strength, c.direction, c.x, c.y), 0});
  }
  return words;
}

std::vector<std::uint32_t> pack(const Image& image, std::uint8_t threshold) {
  std::vector<std::uint32_t> words(image.size() / 32);
  for (std::size_t i = 0; i < image.size(); ++i) {
    if (image[i] <= threshold) words[i / 32] |= 1u << i % 32;
  }
  return words;
}

BlobReference::BlobReference(const pl::Geometry& geometry, std::uint32_t labels,
                             std::uint32_t minimum_side)
    : geometry_(geometry), labels_(labels), minimum_side_(minimum_side), core_(geometry, labels) {}

void BlobReference::begin() {
  position_ = 0, clock_ = 0;
}

void BlobReference::advance(const std::vector<std::uint32_t>& binary, std::uint32_t pixels) {
  for (; position_ < pixels; ++position_) {
    step(true, binary[position_ / 32] >> position_ % 32 & 1, position_ % geometry_.width,
         position_ / geometry_.width);
  }
}

void BlobReference::rest(std::uint64_t clocks) {
  for (; clocks != 0; --clocks) step(false, false, 0, 0);
}

void BlobReference::finish() {
  do {
    rest(1);
  } while (core_.flushing());
}

void BlobReference::reset() {
  core_.reset();
  ena_before_ = retired_ = false;
  number_ = 0;
}

std::uint32_t BlobReference::active_labels() const {
  std::uint32_t count = 0;
  for (std::uint32_t label = 1; label < labels_; ++label) {
    count += core_.active(static_cast<pl::BlobCore::Label>(label));
  }
  return count;
}

// The order of BlobDetectionClocked::edge(): a blob is numbered one clock after it retired.
void BlobReference::step(bool ena, bool dark, std::uint32_t x, std::uint32_t y) {
  filter();
  if (ena && !ena_before_) number_ = 0;
  ena_before_ = ena;
  retired_ = core_.step(ena, dark, x, y);
  retired_clock_ = clock_++;
}

void BlobReference::filter() {
  const pl::BoundingBox& box = core_.retired();
  if (!retired_ || !box.at_least(minimum_side_)) return;
  words.push_back({'B', 5 + retired_clock_, geometry_.words().blob_start(number_, box.sx, box.sy),
                   geometry_.words().blob_end(number_, box.ex, box.ey)});
  ++number_;
}

std::vector<Word> corner_words(const std::vector<pl::StampedWord>& corners) {
  std::vector<Word> words;
  for (const pl::StampedWord& c : corners)
    words.push_back({'C', harness::detectors_begin + c.clock, c.word, 0});
  return words;
}

std::vector<Word> blob_words(const std::vector<pl::StampedBlob>& blobs) {
  std::vector<Word> words;
  for (const pl::StampedBlob& b : blobs)
    words.push_back({'B', harness::blobs_begin + b.clock, b.start, b.end});
  return words;
}
