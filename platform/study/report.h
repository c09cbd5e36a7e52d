#pragma once

#include <string>
#include <vector>

#include <study/results.h>

namespace platform::study {

/// What a sweep found, for a terminal: the best points first, then those that are not feasible and
/// those that failed, with why, at most `most_rows` in all; and the sweep's own text, which speaks
/// of all its points and is left out where some are missing.
std::string sweep_text(const Results& results, std::size_t most_rows = 40);

/// The block "sweep" of the page: what sweep_text() says, for all points, and more figures:
///
///   {"name", "title", "text", "folder", "swept": [path…], "idle", "influence", "missing",
///    "counts": {"points", "feasible", "failed"} of the whole sweep, "objectives": [{"metric",
///    "unit", "better": 1 or -1}], "constraints": [text…], "metrics": [{"path", "unit"}], "points":
///    [{"key", "swept": [value…], "metrics": [number or null…], "failed",
///                "reasons": [text…], "same_as": text, "front": 0 for none,
///                "better": the place in "points" of the one that beats it (find_better())}]}
///
/// "idle" names the parameters that change nothing (idle_text). "influence" is what moves the first
/// objective (sensitivity_json). Of more than 20 000 points it has the first front and every so
/// many of the others. "metrics" of a point that failed are those until then. The members of `more`
/// are added: "steps" is what one step of each parameter is worth at a point (study::effects_json),
/// "progress" how a search went (explore::progress_json).
std::string page_block(const Results& results, const std::string& folder,
                       const Json& more = Json::object());

/// Figures that the page shows of every sweep, for read_results().
std::vector<vp::Expression> page_figures();

/// Writes report.html of a sweep into its folder. False if the program was built without the page.
bool write_page(const Results& results, const std::string& folder,
                const Json& more = Json::object());

/// What to say of the figures that a sweep asks for and none of its results has; `known` are the
/// names of those that there are, sorted.
std::vector<std::string> missing_figures(const Manifest& manifest,
                                         const result::Metrics::Names& known);

}  // namespace platform::study
