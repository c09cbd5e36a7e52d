#include <report/summary.h>

#include <algorithm>

#include <report/error_measure.h>

namespace platform::report {

bool has_parts(const std::vector<StageTime>& stages, const std::string& stage) {
  return std::any_of(stages.begin(), stages.end(),
                     [&](const StageTime& other) { return other.part_of == stage; });
}

void Statistic::add(double value) {
  min_ = count_ == 0 ? value : std::min(min_, value);
  max_ = count_ == 0 ? value : std::max(max_, value);
  sum_ += value;
  ++count_;
}

void Summary::add(const FrameReport& frame) {
  ++frames_;
  if (!frame.warnings.empty()) ++warned_;
  if (frame.counts.lost() != 0) ++lossy_;
  for (const vp::Interval& part : periods_.next(frame)) open_ps_ += part.to_ps - part.from_ps;
  if (!frame.delivered()) return;
  if (open_ps_ > 0) fps_.add(ps_per_s / static_cast<double>(open_ps_));
  busy_ps_ += open_ps_;
  open_ps_ = 0;
  latency_us_.add(static_cast<double>(frame.end_ps - frame.start_ps) / ps_per_us);
  add_stages(frame);
  add_markers(frame);
}

double Summary::mean_fps() const {
  if (busy_ps_ == 0) return 0;
  return static_cast<double>(delivered()) * ps_per_s / static_cast<double>(busy_ps_);
}

void Summary::add_stages(const FrameReport& frame) {
  for (const StageTime& time : frame.times) {
    auto stage = std::find_if(stages_.begin(), stages_.end(),
                              [&](const Stage& known) { return known.name == time.name; });
    if (stage == stages_.end())
      stage = stages_.insert(stages_.end(), Stage{time.name, time.part_of, {}});
    stage->us.add(static_cast<double>(time.ps) / ps_per_us);
  }
}

void Summary::add_markers(const FrameReport& frame) {
  if (!frame.markers.empty()) ++detected_;
  bool right = false;
  for (const FoundMarker& found : frame.markers) {
    const GroundTruth* truth = truth_of(frame, found);
    if (truth == nullptr) continue;
    right = true;
    const MarkerError error = measure_error(found, *truth);
    corner_px_.add(error.corner_px);
    if (!found.has_pose) continue;
    translation_mm_.add(error.translation_mm);
    rotation_deg_.add(error.rotation_deg);
  }
  const bool overlooked = frame.truth && !right;
  if (overlooked) ++overlooked_;
  if (overlooked && !frame.markers.empty()) ++mistaken_;
  if (!overlooked && frame.counts.lost() == 0) ++fulfilled_;
}

}  // namespace platform::report
