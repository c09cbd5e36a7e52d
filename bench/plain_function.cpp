#include "plain_function.h"

namespace bench {

namespace {

// The defaults of the platform: pl.corner_detection.threshold, pl.blob_detection.label_count and
// minimum_side, sw.margin, sw.canonical_width.
constexpr std::uint32_t corner_threshold = 30;
constexpr std::uint32_t label_count = 128;
constexpr std::uint32_t minimum_side = 24;
constexpr double margin_px = 4;
constexpr std::uint32_t canonical_width = 60;

}  // namespace

FrameDetector::FrameDetector(const pl::Geometry& geometry)
    : geometry_(geometry),
      corner_(geometry, corner_threshold),
      threshold_(geometry),
      blob_(geometry, label_count, minimum_side) {}

void FrameDetector::detect(const std::uint8_t* image, Detected& result) {
  corner_.detect(image, result.corners);
  threshold_.begin(image);
  threshold_.advance(geometry_.pixels());
  blob_.reset();
  blob_.begin();
  blob_.advance(threshold_.words().data(), geometry_.pixels(), result.blobs);
  blob_.finish(result.blobs);
  threshold_.end();
}

PixelDetector::PixelDetector(const pl::Geometry& geometry)
    : geometry_(geometry),
      corner_(geometry, corner_threshold),
      blob_(geometry, label_count),
      words_(geometry.pixels() / 32) {}

void PixelDetector::detect(const std::uint8_t* image, Detected& result) {
  std::uint32_t i = 0;
  number_ = 0;
  corner_.reset();
  blob_.reset();
  for (std::uint32_t y = 0; y < geometry_.height; ++y) {
    for (std::uint32_t x = 0; x < geometry_.width; ++x, ++i) {
      pl::Corner corner;
      if (corner_.push(image[i], x, y, corner)) {
        result.corners.push_back(
            {pl::CornerFrame::clock(geometry_, corner.x, corner.y),
             geometry_.words().corner(corner.strength, corner.direction, corner.x, corner.y)});
      }
      const bool dark = threshold_.push(image[i]);
      words_[i / 32] = words_[i / 32] >> 1 | std::uint32_t{dark} << 31;
      label(true, dark, x, y, i, result);
    }
  }
  do {
    label(false, false, 0, 0, i++, result);
  } while (blob_.flushing());
  threshold_.end_frame();
}

void PixelDetector::label(bool ena, bool dark, std::uint32_t x, std::uint32_t y, std::uint32_t step,
                          Detected& result) {
  constexpr std::uint32_t latency = 1;  // from the retirement of a label
  if (!blob_.step(ena, dark, x, y)) return;
  const pl::BoundingBox& box = blob_.retired();
  if (!box.at_least(minimum_side)) return;
  result.blobs.push_back({latency + step, geometry_.words().blob_start(number_, box.sx, box.sy),
                          geometry_.words().blob_end(number_, box.ex, box.ey)});
  ++number_;
}

template <class Detector>
std::optional<marker::Pose> PlainFunction<Detector>::run(const std::uint8_t* image,
                                                         const marker::Camera& camera) {
  detected_.clear();
  detector_.detect(image, detected_);
  pack();
  Memory& m = *memory_;
  m.features.clear();
  marker::decode(m.words.words.data(), m.words.stored(), geometry_.words(), m.features);
  m.candidates.count = m.candidates.lost = 0;
  marker::evaluate_features(m.features, {margin_px}, m.candidates);
  const marker::BinaryImage binary{detector_.binary(), geometry_.width, geometry_.height, false};
  found_ = marker::find_first_marker(m.features, m.candidates, binary, canonical_width);
  if (!found_.found) return std::nullopt;
  return marker::estimate_pose(found_.corners, camera, marker::PositOptions{});
}

/// The feature words in the order in which they leave the hardware.
template <class Detector>
void PlainFunction<Detector>::pack() {
  marker::WordStore& words = memory_->words;
  words.clear();
  auto blob = detected_.blobs.begin();
  // The blob detection takes a pixel one clock behind the corner detection.
  const auto push_blobs_before = [&](std::uint64_t clock) {
    for (; blob != detected_.blobs.end() && blob->clock + 1 < clock; ++blob) {
      words.push(blob->start);
      words.push(blob->end);
    }
  };
  for (const pl::StampedWord& corner : detected_.corners) {
    push_blobs_before(corner.clock);
    words.push(corner.word);
  }
  push_blobs_before(~std::uint64_t{0});
  words.push(marker_logic::WordFormat::end_of_frame);
}

template class PlainFunction<FrameDetector>;
template class PlainFunction<PixelDetector>;

}  // namespace bench
