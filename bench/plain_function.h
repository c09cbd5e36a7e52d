#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <marker/feature_evaluation.h>
#include <marker/feature_set.h>
#include <marker/marker_search.h>
#include <marker/posit.h>
#include <pl/blob_detection/core.h>
#include <pl/common/geometry.h>
#include <pl/corner_detection/core.h>
#include <pl/global_threshold/core.h>

namespace bench {

/// What the hardware found in one frame, each kind in the order of its clocks.
struct Detected {
  std::vector<pl::StampedWord> corners;
  std::vector<pl::StampedBlob> blobs;

  void clear() {
    corners.clear();
    blobs.clear();
  }
};

/// The hardware's detection as functions over whole frames, the fastest there are in this project.
/// Each frame starts from a reset, as the software makes it; the threshold stays.
class FrameDetector {
 public:
  explicit FrameDetector(const pl::Geometry& geometry);

  void detect(const std::uint8_t* image, Detected& result);
  /// 32 pixels a word, of the last frame.
  const std::uint32_t* binary() const { return threshold_.words().data(); }

 private:
  pl::Geometry geometry_;
  pl::CornerFrame corner_;
  pl::ThresholdFrame threshold_;
  pl::BlobFrame blob_;
};

/// The same pixel by pixel, as a first program would be written: the cores of the clocked models,
/// without clocks.
class PixelDetector {
 public:
  explicit PixelDetector(const pl::Geometry& geometry);

  void detect(const std::uint8_t* image, Detected& result);
  const std::uint32_t* binary() const { return words_.data(); }

 private:
  void label(bool ena, bool dark, std::uint32_t x, std::uint32_t y, std::uint32_t step,
             Detected& result);

  pl::Geometry geometry_;
  pl::CornerCore corner_;
  pl::ThresholdCore threshold_;
  pl::BlobCore blob_;
  std::vector<std::uint32_t> words_;
  std::uint32_t number_ = 0;
};

/// Image in, marker and pose out, without a simulator: what the modelled system computes, done by
/// function calls. `Detector` is one of the above.
template <class Detector>
class PlainFunction {
 public:
  explicit PlainFunction(const pl::Geometry& geometry)
      : geometry_(geometry), detector_(geometry), memory_(std::make_unique<Memory>()) {}

  /// The pose of the first marker in the image, if any. The threshold adapts from frame to frame.
  std::optional<marker::Pose> run(const std::uint8_t* image, const marker::Camera& camera);

  /// Of the last frame.
  const Detected& detected() const { return detected_; }
  std::uint32_t feature_words() const { return memory_->words.count; }
  int marker_id() const { return found_.found ? found_.identity.id : -1; }

 private:
  void pack();

  /// As large as the software's own memory.
  struct Memory {
    marker::WordStore words;
    marker::FeatureSet features;
    marker::CandidateList candidates;
  };

  pl::Geometry geometry_;
  Detector detector_;
  Detected detected_;
  std::unique_ptr<Memory> memory_;
  marker::FoundMarker found_{};
};

}  // namespace bench
