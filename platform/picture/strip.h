#pragma once

#include <opencv2/core.hpp>

#include <report/result.h>

namespace platform::picture {

/// Height of the strip below the image, px.
constexpr int strip_height = 118;

/// Fills the strip: ID and time, pose, error and counts on the left, the legend on the right if
/// there is room.
void draw_strip(cv::Mat& strip, const report::FrameReport& frame);

}  // namespace platform::picture
