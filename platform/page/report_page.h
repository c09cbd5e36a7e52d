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

inline constexpr const char* report_name = "report.html";

/// Writes report.html into a folder that has result.json (a run), validation.json (a validation) or
/// points/ (a sweep), from these files. Of a run, `extras` is the block that RunExtras made; empty:
/// that of the page that is there already, if there is one. False if the program was built without
/// the page. Throws vp::InputError if the folder has none of these, or a file is damaged.
bool write_report(const std::string& folder, const std::string& extras = "");

/// The same of a sweep whose points are `known`, all or some.
bool write_sweep_report(const std::string& folder, const PointRows& known);

/// A page into `output` that compares the runs in two folders.
bool write_comparison(const std::string& first, const std::string& second,
                      const std::string& output);

}  // namespace platform::page
