#pragma once

#include <string>

namespace platform::page {

inline constexpr const char* report_name = "report.html";

/// Writes report.html into a folder that has result.json (a run) or validation.json (a validation),
/// from these files; a sweep has its own (sweep/report.h). Of a run, `extras` is the block that
/// RunExtras made; empty: that of the page that is there already, if there is one. False if the
/// program was built without the page. Throws vp::InputError if the folder has none of these, or a
/// file is damaged.
bool write_report(const std::string& folder, const std::string& extras = "");

/// A page into `output` that compares the runs in two folders.
bool write_comparison(const std::string& first, const std::string& second,
                      const std::string& output);

}  // namespace platform::page
