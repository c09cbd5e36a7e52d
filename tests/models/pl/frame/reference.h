#pragma once

#include <pl/blob_detection/core.h>
#include <pl/common/geometry.h>

#include <cstdint>
#include <vector>

#include "frames.h"
#include "word.h"

/// The words of CornerCore, fed pixel by pixel, with the clocks of the clocked module.
std::vector<harness::Word> reference_corners(const harness::Image& image, const pl::Geometry& g,
                                             std::uint32_t threshold);

/// The binary words of an image.
std::vector<std::uint32_t> pack(const harness::Image& image, std::uint8_t threshold);

/// BlobCore, stepped clock by clock, with filter, numbers and clocks of the clocked module.
class BlobReference {
 public:
  BlobReference(const pl::Geometry& geometry, std::uint32_t labels, std::uint32_t minimum_side);

  void begin();
  void advance(const std::vector<std::uint32_t>& words, std::uint32_t pixels);
  void rest(std::uint64_t clocks);
  /// One clock at least, and until nothing is flushed.
  void finish();
  void reset();

  std::uint32_t active_labels() const;
  std::uint32_t overflow() const { return core_.overflow(); }

  std::vector<harness::Word> words;  ///< all blobs so far

 private:
  void step(bool ena, bool dark, std::uint32_t x, std::uint32_t y);
  void filter();

  pl::Geometry geometry_;
  std::uint32_t labels_, minimum_side_;
  pl::BlobCore core_;
  std::uint32_t position_ = 0;
  std::uint64_t clock_ = 0;
  bool ena_before_ = false, retired_ = false;
  std::uint64_t retired_clock_ = 0;
  std::uint32_t number_ = 0;
};

std::vector<harness::Word> corner_words(const std::vector<pl::StampedWord>& corners);
std::vector<harness::Word> blob_words(const std::vector<pl::StampedBlob>& blobs);
