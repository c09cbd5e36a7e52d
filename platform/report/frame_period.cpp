#include <report/frame_period.h>

#include <algorithm>

namespace platform::report {

std::vector<vp::Interval> FramePeriods::next(const FrameReport& frame) {
  std::vector<vp::Interval> period;
  if (end_ps_) {
    const std::uint64_t upload = frame.start_ps - std::min(frame.start_ps, frame.upload_ps);
    period.push_back({*end_ps_, std::max(*end_ps_, upload)});
    period.push_back({std::max(*end_ps_, frame.start_ps), frame.end_ps});
  } else {
    period.push_back({frame.start_ps, frame.end_ps});
  }
  end_ps_ = frame.end_ps;
  return period;
}

}  // namespace platform::report
