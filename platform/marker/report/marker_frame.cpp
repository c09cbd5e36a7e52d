#include <marker/report/marker_frame.h>

#include <marker/input/frame_source.h>
#include <Eigen/Core>

#include <memory>

namespace platform {

MarkerFrame& marker_frame(facts::UnitReport& frame) {
  if (!frame.extra) frame.extra = std::make_shared<MarkerFrame>();
  return dynamic_cast<MarkerFrame&>(*frame.extra);
}

const MarkerFrame& marker_frame(const facts::UnitReport& frame) {
  static const MarkerFrame nothing;
  const auto* found = dynamic_cast<const MarkerFrame*>(frame.extra.get());
  return found ? *found : nothing;
}

namespace {

// Keys of `summary` in result.json, and what the console says.
constexpr const char* detected = "detected";
constexpr const char* mistaken = "mistaken";

}  // namespace

const facts::Work& marker_work() {
  static const facts::Work work = [] {
    facts::Work marker;
    marker.unit = "frame";
    marker.job = "the marker of the scene is found in every frame, and nothing is lost";
    marker.given = "image";
    marker.tallies = {{detected, "with a marker", "no marker", true, facts::Better::more},
                      {mistaken, "of them a wrong one", "", false}};
    return marker;
  }();
  return work;
}

void take_truth(facts::UnitReport& frame) {
  const auto* input = dynamic_cast<const input::InputFrame*>(frame.given.get());
  if (!input) return;
  MarkerFrame& found = marker_frame(frame);
  found.camera = input->camera;
  found.truth = input->truth;
  found.further_truth = input->further_truth;
}

void judge(facts::UnitReport& frame) {
  const MarkerFrame& found = marker_frame(frame);
  bool right = false, wrong = false;
  for (const FoundMarker& marker : found.markers) {
    const GroundTruth* truth = truth_of(found, marker);
    if (truth == nullptr) wrong = true;
    if (truth != nullptr && truth->marker_id == found.truth->marker_id) right = true;
  }
  const bool overlooked = found.truth && !right;
  if (!found.markers.empty()) frame.tallies.emplace_back(detected);
  if (overlooked && wrong) frame.tallies.emplace_back(mistaken);
  if (overlooked) frame.failures.emplace_back("without the marker of the scene");
}

void MarkerFrame::add_samples(const Sample& sample) const {
  for (const FoundMarker& found : markers) {
    const GroundTruth* own = truth_of(*this, found);
    if (own == nullptr) continue;
    const MarkerError error = measure_error(found, *own);
    sample("corner_px", error.corner_px);
    if (!has_pose_error(found, *own)) continue;
    sample("translation_mm", error.translation_mm);
    sample("rotation_deg", error.rotation_deg);
  }
}

std::optional<std::string> MarkerFrame::misfit() const {
  if (!board) return std::nullopt;
  return board->misfit;
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

const GroundTruth* truth_of(const MarkerFrame& frame, const FoundMarker& found) {
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

std::string another_marker_text(const MarkerFrame& frame) {
  std::string text = "another marker: the scene has " + std::to_string(frame.truth->marker_id);
  const std::size_t more = frame.further_truth.size();
  return more == 0 ? text : text + " and " + std::to_string(more) + " more";
}

}  // namespace platform
