#pragma once

#include <optional>
#include <string>
#include <vector>

#include <validation/measured.h>

/// The sums that rows of the report are made of. Frames of the two systems belong together
/// pairwise.
namespace platform::validation {

using Groups = std::vector<std::string>;
/// One number of a frame.
using Value = double (*)(const Frame&);

/// Stages as the thesis cuts them (5.4.1), ms. In the hybrid system the corner detection includes
/// decoding what came; the other two end when all features are there.
double frame_ms(const Frame& frame);
double hybrid_corner_ms(const Frame& frame);
double hybrid_blob_ms(const Frame& frame);
double hybrid_threshold_ms(const Frame& frame);
double ps_capture_ms(const Frame& frame);
double ps_corner_ms(const Frame& frame);
double ps_blob_ms(const Frame& frame);
double ps_threshold_ms(const Frame& frame);
double evaluation_ms(const Frame& frame);
double identification_ms(const Frame& frame);
double pose_ms(const Frame& frame);
/// Part of the frame's time, %.
double identification_share(const Frame& frame);
double frames_per_second(const Frame& frame);

/// Mean over the frames of these tests. None if a run has none of them.
std::optional<Measurement> mean(const Run& run, const Groups& groups, Value value);
/// Mean over pairs of frames: PS-only minus hybrid, and PS-only over hybrid.
std::optional<Measurement> mean_difference(const Measured& measured, const Groups& groups,
                                           Value ps_only, Value hybrid);
std::optional<Measurement> mean_ratio(const Measured& measured, const Groups& groups, Value ps_only,
                                      Value hybrid);
/// The first and the last image of the increased-feature test, and the ratio last over first.
std::optional<Measurement> at_first(const Run& run, Value value);
std::optional<Measurement> at_last(const Run& run, Value value);
std::optional<Measurement> growth(const Run& run, Value value);

/// Mean over the frames of these tests in which the marker was found.
std::optional<Measurement> mean_corner_mm(const Run& run, const Groups& groups);
std::optional<Measurement> mean_translation_mm(const Run& run, const Groups& groups);
std::optional<Measurement> mean_rotation_deg(const Run& run, const Groups& groups);
std::optional<Measurement> mean_iterations(const Run& run, const Groups& groups);
/// Width of the marker in the image of that name, px.
std::optional<Measurement> marker_width_px(const Run& run, const std::string& input);
/// Side of the marker in mm over its width in px: what a pixel covers on its plane (thesis 5.3.1).
double pixel_mm(const FoundTrue& found);

}  // namespace platform::validation
