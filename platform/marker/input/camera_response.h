#pragma once

#include <string>

#include <marker/input/calibration_file.h>
#include <marker/scene/pose.h>

namespace platform::input {

/// The response curve that an entry of a camera file says: "linear", "srgb", "rec709", an exponent
/// from 0.5 to 5 (light is that power of the grey level), or the light of 256 grey levels in any
/// unit. `what`: the file, for messages. Throws vp::InputError for anything else, and for a curve
/// that falls.
Response response_of(const CalibrationEntry& entry, const std::string& what);

}  // namespace platform::input
