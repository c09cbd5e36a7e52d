#pragma once

namespace platform {

/// Registers the metrics of the marker application with the platform, once: markers found, errors,
/// reprojection, thresholds. Returns true, for an object that is made before main().
bool register_marker_metrics();

}  // namespace platform
