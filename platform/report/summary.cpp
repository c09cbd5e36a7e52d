#include <report/summary.h>

#include <algorithm>

#include <report/error_measure.h>

namespace platform::report {

namespace {

constexpr double ps_per_us = 1e6;
constexpr double ps_per_s = 1e12;

}  // namespace

void Statistic::add(double value) {
  min_ = count_ == 0 ? value : std::min(min_, value);
  max_ = count_ == 0 ? value : std::max(max_, value);
  sum_ += value;
  ++count_;
}

void Summary::add(const FrameReport& frame) {
  std::uint64_t period = frame.end_ps - (frames() == 0 ? frame.start_ps : last_end_ps_);
  if (frames() > 0) period -= std::min(period, frame.upload_ps);
  if (period > 0) fps_.add(ps_per_s / static_cast<double>(period));
  busy_ps_ += period;
  last_end_ps_ = frame.end_ps;
  latency_us_.add(static_cast<double>(frame.end_ps - frame.start_ps) / ps_per_us);
  if (!frame.warnings.empty()) ++warned_;
  add_stages(frame);
  add_markers(frame);
}

double Summary::mean_fps() const {
  if (busy_ps_ == 0) return 0;
  return static_cast<double>(frames()) * ps_per_s / static_cast<double>(busy_ps_);
}

void Summary::add_stages(const FrameReport& frame) {
  for (const StageTime& time : frame.times) {
    auto stage = std::find_if(stages_.begin(), stages_.end(),
                              [&](const Stage& known) { return known.name == time.name; });
    if (stage == stages_.end()) stage = stages_.insert(stages_.end(), Stage{time.name, {}});
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
  if (frame.truth && !frame.markers.empty() && !right) ++mistaken_;
}

}  // namespace platform::report
