#pragma once

#include <optional>
#include <string>
#include <vector>

#include <facts/figure.h>
#include <facts/unit.h>
#include <nlohmann/json.hpp>

/// The table of all figures. What shows, stores or compares numbers of runs reads it: metrics,
/// sweeps, pages, docs.
namespace platform::result {

using Json = nlohmann::ordered_json;

/// Figures by path. A metric is a number by its path: of a figure of units, which begins with
/// "frames.", mean and largest value over all of them, ".mean" and ".max".
class FigureTable {
 public:
  /// Throws vp::InputError, with the place of the declaration: there is one of that path, whose
  /// place is named, too; or it has no path, unit or meaning.
  void add(const facts::Figure& figure);
  /// In the order of their parts of result.json.
  const std::vector<facts::Figure>& list() const { return list_; }
  const facts::Figure* with_path(const std::string& path) const;
  /// What a metric is of; null if no result has it.
  const facts::Figure* of(const std::string& metric) const;

 private:
  std::vector<facts::Figure> list_;
};

/// Those of every result, of the application (UnitMetrics), and of designs that are declared.
const FigureTable& figures();

/// Adds those of a design. Throws vp::InputError as FigureTable::add(), and for one that the
/// platform or its application has, or that another design has in another unit.
void declare(const facts::Work& work);
/// The same from what own_figures_json() gave; of anything else it takes nothing.
void declare(const Json& own_figures);
/// What a design declares and the platform does not: [{path, unit, meaning, better, title, place}].
Json own_figures_json(const facts::Work& work);
/// The same of all designs that are declared.
Json declared_json();

/// How people see a metric.
struct ShownMetric {
  std::string title, unit;
  double factor = 1;  ///< its value times this is in `unit`
  int better = 0;     ///< 1: more, -1: less
};

/// None: the metric has no title. `unit_of_work`: what a "frame" in the title is called.
std::optional<ShownMetric> shown_metric(const std::string& metric,
                                        const std::string& unit_of_work = "frame");
/// The same for a page, of any expression: {path, title, unit, factor, better}.
Json shown_json(const std::string& text);
/// Metrics that pages show where a study does not say.
std::vector<std::string> usual_metrics();
/// The table for pages and programs: [{path, unit, better, title, meaning}], and for some what
/// people see: their value times `factor` in `people_unit`.
Json figures_json();

/// The unit of an expression that is one metric; empty for any other, and for a plain number.
std::string unit_of_metric(const std::string& text);

/// Throws vp::InputError for a name that is neither a metric nor one of `others`: "unknown metric
/// 'x'; did you mean 'y'?".
void check_metric(const std::string& name, const std::vector<std::string>& others);

/// The figures whose path has `part` in it, or that have a metric of that name, as a table; empty:
/// all. Throws vp::InputError with the nearest if missing.
std::string metric_table(const std::string& part);
/// All of them as docs/figures.md.
std::string metric_markdown();

}  // namespace platform::result
