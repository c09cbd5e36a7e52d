#pragma once

#include <hal/hal.h>
#include <marker/camera.h>
#include <marker/marker_detector.h>
#include <marker/optics.h>
#include <marker/response.h>

#include <cstdint>

namespace improved {

/// What the user says of a camera's response curve: the option `response`.
enum class ResponseChoice : std::uint32_t { camera, linear, srgb, rec709, exponent, found };

/// What is done about a blob that is refused: the option `tries`.
/// `camera`: outlines, but one where levels are known to be light, as in scenes.
enum class Tries : std::uint32_t { camera, one, nearer, outlines };

struct OpticsOptions {
  ResponseChoice response;
  double exponent;  ///< of ResponseChoice::exponent
  Tries tries;
};

/// What the camera's lens and response curve ask of the detector, frame by frame. A curve that is
/// not known is found from the markers.
class FrameOptics {
 public:
  /// Begins a run. For static memory.
  void open(const OpticsOptions& options);

  /// For the camera of that frame; nullptr: the lens of the picture says all. Valid until the next
  /// call of any function.
  const marker::Optics* begin(const hal_frame& frame);

  /// Takes in what the markers of the frame say of the curve, and notes it there. True if they are
  /// worth another look, with what begin() returned.
  bool learn(marker::Detections& found);

 private:
  std::uint32_t response_of(const hal_frame& frame) const;
  Tries tries_of(const hal_frame& frame) const;
  void follow_finder();

  OpticsOptions options_;
  marker::LightTable given_;  ///< by the options
  bool learns_;               ///< in this frame
  bool has_sought_;           ///< the finder is open
  std::uint32_t frames_;      ///< for which it was
  marker::ResponseUse use_;
  marker::Optics optics_;
  marker::ResponseFinder finder_;
};

/// The Brown–Conrady lens of a frame; of another model: a pinhole.
marker::Lens lens_of(const hal_frame& frame);

}  // namespace improved
