#pragma once

#include <string>
#include <vector>

#include <marker/validation/measured.h>
#include <marker/validation/published.h>
#include <marker/validation/validation.h>

/// Runs made by hand, with times that are easy to reckon with.
namespace synthetic {

using platform::validation::Frame;
using platform::validation::Measured;
using platform::validation::Published;
using platform::validation::Run;

/// A frame of the hybrid system in ms: 6 of features, 1 of receive, `identification`, 0.5 of
/// evaluation and 0.5 of pose.
Frame hybrid_frame(const std::string& input, double identification_ms);

/// A frame of the PS-only system: 6 of capture, `corner`, 10 of threshold, `blob`, identification,
/// 0.5 of evaluation and 0.5 of pose.
Frame ps_frame(const std::string& input, double corner_ms, double blob_ms,
               double identification_ms);

/// All images of chapter 5; the marker is found in each. Times grow with the squares:
/// identification 2 ms and 1 ms a square more (hybrid) and half as much (PS-only), corner detection
/// 40 ms and 1 ms a square more, blob detection 20 ms and 2 ms a square more; other images are as
/// with one square.
Measured all_images();

/// The table that is installed.
std::vector<Published> published();

/// The row of that name.
platform::validation::Row row(const std::vector<platform::validation::Row>& rows,
                              const std::string& id);

}  // namespace synthetic
