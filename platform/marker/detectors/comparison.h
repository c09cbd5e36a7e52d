#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <facts/summary.h>
#include <marker/detectors/peers.h>
#include <marker/detectors/truth.h>
#include <result/result_json.h>

/// Detectors on the same images: what each one saw, judged by what is in them.
namespace platform::detectors {

/// What a design takes on the chip, mean over the frames.
struct HardwareFigures {
  std::optional<double> fps, latency_ms, energy_mj;
};

struct Detector {
  std::string name, description;
  std::vector<std::vector<SeenMarker>> seen;  ///< by image
  /// Of this computer for an image: a library's detection, a design's simulation.
  double host_ms = 0;
  std::optional<HardwareFigures> hardware;  ///< of our designs
};

struct Image {
  std::string name;
  ImageTruth truth;
};

struct Comparison {
  struct LeftOut {
    std::string design, why;
  };

  std::string dictionary;
  std::vector<Image> images;
  std::vector<Detector> detectors;
  std::vector<LeftOut> left_out;
};

/// One marker: seen, or missed.
struct Judgement {
  enum class Verdict {
    found,    ///< it is there
    wrong,    ///< seen where none of this ID is, or in another orientation
    missed,   ///< it is there, and was not seen
    unjudged  ///< seen; whether it is there is not known
  };

  int id = 0;
  Verdict verdict = Verdict::unjudged;
  // Of a found one, where the truth is known. The corners' is the mean of the four.
  std::optional<double> corner_px, translation_mm, rotation_deg;
};

const char* to_string(Judgement::Verdict verdict);

/// A seen marker is found if one of its ID is in the image, and each of its corners lies within a
/// quarter of that one's side.
std::vector<Judgement> judge(const ImageTruth& truth, const std::vector<SeenMarker>& seen);

/// All images of one detector.
struct Score {
  std::uint64_t seen = 0;
  std::optional<std::uint64_t> markers;  ///< in the images; none: not known of all of them
  std::uint64_t found = 0;
  std::optional<std::uint64_t> wrong;  ///< none: not known of any image
  facts::Statistic corner_px, translation_mm, rotation_deg;
};

Score score(const Comparison& comparison, const Detector& detector);

/// A table for the console, and what the names mean.
std::string console_text(const Comparison& comparison);
/// The same as a page of documentation.
std::string markdown_text(const Comparison& comparison);
/// The table with all digits; the time of this computer is the last column.
std::string scores_csv(const Comparison& comparison);
/// A line for each marker that a detector saw or missed.
std::string detections_csv(const Comparison& comparison);
/// Everything but the single markers. The time of this computer is in `host_ms`, apart.
result::Json to_json(const Comparison& comparison);

}  // namespace platform::detectors
