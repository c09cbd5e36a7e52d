#pragma once

#include <string>

namespace platform::page {

/// What the page shows of the sweep in a folder (manifest.json, points/KEY.json), a row a point:
///
///   {"name", "title", "text", "folder", "swept": [path…], "metrics": [path…], "effects": […],
///    "points": [{"key", "swept": [value…], "metrics": [number or null…], "reasons": [text…]}]}
///
/// `reasons` say why a point cannot be built, or failed. Points without a file are left out and
/// counted in "missing". Throws vp::InputError for damaged files.
std::string sweep_json(const std::string& folder);

}  // namespace platform::page
