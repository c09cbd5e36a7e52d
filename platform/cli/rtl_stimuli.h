#pragma once

#include <string>
#include <vector>

namespace platform::cli {

/// Pictures that are hard on the logic of the marker designs: noise, few grey levels (so that
/// scores, widths and counts are equal), dots, lines of one pixel, as many blobs as fit, black and
/// white. Writes each as a file of this size into `folder`, which exists, and returns the files.
/// Throws vp::OutputError.
std::vector<std::string> write_stimuli(const std::string& folder, int width, int height);

}  // namespace platform::cli
