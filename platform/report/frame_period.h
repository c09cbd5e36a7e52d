#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <report/result.h>
#include <vp/power_meter.h>

namespace platform::report {

/// Cuts a run into the periods of its frames, for whoever divides by time: the frame rate and the
/// power use the same ones.
///
/// A period reaches from the end of the frame before it (its own start, for the first) to its own
/// end, without the time in which its image was only uploaded (thesis 5.5: images are preloaded).
class FramePeriods {
 public:
  /// The period of the next frame, in order of time.
  std::vector<vp::Interval> next(const FrameReport& frame);
  /// End of the last frame; 0 before the first.
  std::uint64_t end_ps() const { return end_ps_.value_or(0); }

 private:
  std::optional<std::uint64_t> end_ps_;
};

}  // namespace platform::report
