#pragma once

#include <map>
#include <string>

#include <report/result_json.h>

namespace platform::page {

/// Rows of points, see point_row(), by key.
using PointRows = std::map<std::string, std::string>;

/// What the page shows of a point with this `outcome`, a member of its file:
///
///   {"metrics": [number or null…], "failed": bool, "reasons": [text…]}
///
/// `reasons` say why it failed or cannot be built. Figures of one that failed are those until then.
std::string point_row(const report::Json& outcome);

/// What the page shows of the sweep in a folder (manifest.json, points/KEY.json), a row a point:
///
///   {"name", "title", "text", "folder", "swept": [path…], "metrics": [path…], "effects": […],
///    "points": [{"key", "swept": [value…], "metrics", "failed", "reasons"}]}
///
/// The files of points whose row is `known` are not read. Points without a file are left out and
/// counted in "missing". Throws vp::InputError for damaged files.
std::string sweep_json(const std::string& folder, const PointRows& known = {});

}  // namespace platform::page
