#include <Eigen/Core>
#include <algorithm>
#include <numeric>

#include <facts/summary.h>

namespace platform::facts {

std::uint64_t& Counts::entry(const std::string& name, bool lost) {
  const auto known = std::find_if(list_.begin(), list_.end(),
                                  [&](const Count& count) { return count.name == name; });
  if (known != list_.end()) return known->value;
  return list_.emplace_back(Count{name, 0, lost}).value;
}

std::uint64_t Counts::operator[](const std::string& name) const {
  const auto known = std::find_if(list_.begin(), list_.end(),
                                  [&](const Count& count) { return count.name == name; });
  return known == list_.end() ? 0 : known->value;
}

std::uint64_t Counts::lost() const {
  return std::accumulate(
      list_.begin(), list_.end(), std::uint64_t{0},
      [](std::uint64_t sum, const Count& count) { return sum + (count.lost ? count.value : 0); });
}

MarkerError measure_error(const FoundMarker& found, const GroundTruth& truth) {
  MarkerError error;
  for (std::size_t i = 0; i < found.corners_px.size(); ++i) {
    const PixelPoint &a = found.corners_px[i], &b = truth.corners_px[i];
    error.corner_px += Eigen::Vector2d(a.x - b.x, a.y - b.y).norm() / 4;
  }
  if (has_pose_error(found, truth)) {
    error.translation_mm = translation_error_mm(found.pose, truth.pose);
    error.rotation_deg = rotation_error_deg(found.pose, truth.pose);
  }
  return error;
}

bool has_pose_error(const FoundMarker& found, const GroundTruth& truth) {
  return found.has_pose && truth.is_usual;
}

const GroundTruth* truth_of(const FrameReport& frame, const FoundMarker& found) {
  const GroundTruth* nearest = nullptr;
  const auto consider = [&](const GroundTruth& truth) {
    if (truth.marker_id != found.id) return;
    const bool is_nearer = !nearest || measure_error(found, truth).corner_px <
                                           measure_error(found, *nearest).corner_px;
    if (is_nearer) nearest = &truth;
  };
  if (frame.truth) consider(*frame.truth);
  for (const GroundTruth& truth : frame.further_truth) consider(truth);
  return nearest;
}

std::string another_marker_text(const FrameReport& frame) {
  std::string text = "another marker: the scene has " + std::to_string(frame.truth->marker_id);
  const std::size_t more = frame.further_truth.size();
  return more == 0 ? text : text + " and " + std::to_string(more) + " more";
}

std::vector<vp::Interval> FramePeriods::next(const FrameReport& frame) {
  if (frame.camera_period) {
    end_ps_ = frame.camera_period->to_ps;
    return {*frame.camera_period};
  }
  std::vector<vp::Interval> period;
  if (end_ps_) end_ps_ = std::max(*end_ps_, frame.settled_ps);
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
  if (frame.settling_showings > 0) ++settled_;
  if (frame.counts.lost() != 0) ++lossy_;
  std::uint64_t period_ps = 0;
  for (const vp::Interval& part : periods_.next(frame)) period_ps += part.to_ps - part.from_ps;
  open_ps_ += period_ps;
  limit_.add(frame, period_ps);
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
      stage =
          stages_.insert(stages_.end(), Stage{time.name, time.part_of, time.clock, time.why, {}});
    stage->us.add(static_cast<double>(time.ps) / ps_per_us);
  }
}

void Summary::add_markers(const FrameReport& frame) {
  if (!frame.markers.empty()) ++detected_;
  bool right = false, wrong = false;
  for (const FoundMarker& found : frame.markers) {
    const GroundTruth* truth = truth_of(frame, found);
    if (truth == nullptr) wrong = true;
    if (truth == nullptr) continue;
    if (truth->marker_id == frame.truth->marker_id) right = true;
    const MarkerError error = measure_error(found, *truth);
    corner_px_.add(error.corner_px);
    if (!has_pose_error(found, *truth)) continue;
    translation_mm_.add(error.translation_mm);
    rotation_deg_.add(error.rotation_deg);
  }
  const bool overlooked = frame.truth && !right;
  if (overlooked) ++overlooked_;
  if (overlooked && wrong) ++mistaken_;
  if (!overlooked && frame.counts.lost() == 0) ++fulfilled_;
}

}  // namespace platform::facts
