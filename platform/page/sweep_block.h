#pragma once

#include <string>

namespace platform::page {

/// What the page shows of the sweep in a folder (manifest.json, points/KEY.json), a row a point:
///
///   {"name", "title", "text", "folder", "swept": [path…], "metrics": [path…], "effects": […],
///    "points": [{"key", "swept": [value…], "metrics": [number or null…], "failed": bool,
///    "reasons": [text…]}]}
///
/// `reasons` say why a point failed or cannot be built. Figures of one that failed are those until
/// then. Points without a file are left out and counted in "missing". Throws vp::InputError for
/// damaged files.
std::string sweep_json(const std::string& folder);

}  // namespace platform::page
