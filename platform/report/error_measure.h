#pragma once

#include <report/result.h>

namespace platform::report {

/// Distance of a found marker from the truth.
struct MarkerError {
  double corner_px = 0;       ///< mean distance of the four corners
  double translation_mm = 0;  ///< distance of the translations
  double rotation_deg = 0;    ///< angle of the rotation between the two
};

/// Translation and rotation are meaningless for a marker without pose.
MarkerError measure_error(const FoundMarker& found, const GroundTruth& truth);

/// The truth of this marker: null if none is known or the marker is another one.
const GroundTruth* truth_of(const FrameReport& frame, const FoundMarker& found);

}  // namespace platform::report
