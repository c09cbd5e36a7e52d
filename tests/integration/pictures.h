#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace integration {

/// A scene as the platform's own renderer makes it, grey, 8 bits.
cv::Mat scene_picture(const std::string& scene, int width = 640, int height = 480);

/// The same as a cheap camera would take it: soft, noisy, brighter on one side, with a colour cast.
cv::Mat photograph(const std::string& scene);

/// A picture without anything in it but a soft gradient.
cv::Mat empty_wall();

/// Writes an image in the format of the file's extension. Throws std::runtime_error if that fails.
void write_picture(const std::string& path, const cv::Mat& picture);

}  // namespace integration
