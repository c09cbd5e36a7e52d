#include <validation/measures.h>

#include <scene/pose.h>

namespace platform::validation {

namespace {

constexpr double mm_per_m = 1000;
constexpr double percent = 100;
constexpr double ms_per_s = 1000;

std::optional<Measurement> of_values(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  return mean_of(values);
}

template <typename Combine>
std::optional<Measurement> mean_of_pairs(const Measured& measured, const Groups& groups,
                                         Combine combine) {
  const auto hybrid = measured.hybrid.of(groups), ps_only = measured.ps_only.of(groups);
  std::vector<double> values;
  for (std::size_t i = 0; i < hybrid.size(); ++i)
    values.push_back(combine(*ps_only[i], *hybrid[i]));
  return of_values(values);
}

template <typename Read>
std::optional<Measurement> mean_of_found(const Run& run, const Groups& groups, Read read) {
  std::vector<double> values;
  for (const Frame* frame : run.of(groups)) {
    if (frame->found && frame->found->translation_mm) values.push_back(read(*frame->found));
  }
  return of_values(values);
}

}  // namespace

double frame_ms(const Frame& frame) {
  return frame.ms("frame");
}
double hybrid_corner_ms(const Frame& frame) {
  return frame.ms("feature_extraction") + frame.ms("receive");
}
double hybrid_blob_ms(const Frame& frame) {
  return frame.ms("feature_extraction");
}
double hybrid_threshold_ms(const Frame& frame) {
  return frame.ms("feature_extraction");
}
double ps_capture_ms(const Frame& frame) {
  return frame.ms("capture");
}
double ps_corner_ms(const Frame& frame) {
  return frame.ms("corner_detection");
}
double ps_blob_ms(const Frame& frame) {
  return frame.ms("blob_detection");
}
double ps_threshold_ms(const Frame& frame) {
  return frame.ms("threshold");
}
double evaluation_ms(const Frame& frame) {
  return frame.ms("evaluation");
}
double identification_ms(const Frame& frame) {
  return frame.ms("identification");
}
double pose_ms(const Frame& frame) {
  return frame.ms("pose");
}
double identification_share(const Frame& frame) {
  return percent * frame.ms("identification") / frame.ms("frame");
}
double frames_per_second(const Frame& frame) {
  return ms_per_s / frame.ms("frame");
}

std::optional<Measurement> mean(const Run& run, const Groups& groups, Value value) {
  std::vector<double> values;
  for (const Frame* frame : run.of(groups)) values.push_back(value(*frame));
  return of_values(values);
}

std::optional<Measurement> mean_difference(const Measured& measured, const Groups& groups,
                                           Value ps_only, Value hybrid) {
  return mean_of_pairs(measured, groups, [&](const Frame& slow, const Frame& fast) {
    return ps_only(slow) - hybrid(fast);
  });
}

std::optional<Measurement> mean_ratio(const Measured& measured, const Groups& groups, Value ps_only,
                                      Value hybrid) {
  return mean_of_pairs(measured, groups, [&](const Frame& slow, const Frame& fast) {
    return ps_only(slow) / hybrid(fast);
  });
}

std::optional<Measurement> at_first(const Run& run, Value value) {
  const auto frames = run.of(feature_test);
  if (frames.empty()) return std::nullopt;
  return Measurement{value(*frames.front())};
}

std::optional<Measurement> at_last(const Run& run, Value value) {
  const auto frames = run.of(feature_test);
  if (frames.empty()) return std::nullopt;
  return Measurement{value(*frames.back())};
}

std::optional<Measurement> growth(const Run& run, Value value) {
  const auto first = at_first(run, value), last = at_last(run, value);
  if (!first || !last) return std::nullopt;
  return Measurement{last->value / first->value};
}

double pixel_mm(const FoundTrue& found) {
  return marker_side_m * mm_per_m / found.width_px;
}

std::optional<Measurement> mean_corner_mm(const Run& run, const Groups& groups) {
  return mean_of_found(run, groups,
                       [](const FoundTrue& found) { return found.corner_px * pixel_mm(found); });
}

std::optional<Measurement> mean_translation_mm(const Run& run, const Groups& groups) {
  return mean_of_found(run, groups, [](const FoundTrue& found) { return *found.translation_mm; });
}

std::optional<Measurement> mean_rotation_deg(const Run& run, const Groups& groups) {
  return mean_of_found(run, groups, [](const FoundTrue& found) { return *found.rotation_deg; });
}

std::optional<Measurement> mean_iterations(const Run& run, const Groups& groups) {
  return mean_of_found(run, groups,
                       [](const FoundTrue& found) { return double{1} * found.iterations; });
}

std::optional<Measurement> marker_width_px(const Run& run, const std::string& input) {
  for (const Frame& frame : run.frames) {
    if (frame.input == input && frame.found) return Measurement{frame.found->width_px};
  }
  return std::nullopt;
}

}  // namespace platform::validation
