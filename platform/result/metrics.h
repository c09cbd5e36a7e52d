#pragma once

#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <facts/figure.h>
#include <nlohmann/json.hpp>

namespace platform::result {

using Json = nlohmann::ordered_json;

/// How an application reads what it adds to a unit's entry in result.json, and what it declares of
/// that. One object of the application, before main(), registers itself.
struct UnitMetrics {
  using Found = std::function<void(const std::string& name, double value)>;

  UnitMetrics(bool (*take_member)(const std::string&, const Json&, const Found&),
              void (*find_rates)(const Json&, const Found&),
              const std::vector<facts::Figure>& declared);

  /// Finds the figures in a member: `name` becomes frames.`name`.mean and .max. False: it is none
  /// of the application's, and is read as all others are.
  bool (*take)(const std::string& name, const Json& value, const Found& found);
  /// Finds what a unit counts for, 1 or 0: `name` becomes summary.`name`, the mean over all units.
  void (*rates)(const Json& unit, const Found& found);
};

/// Those of applications.
const std::vector<facts::Figure>& application_figures();
/// Those that are calculated from others in result.json.
std::vector<facts::Figure> derived_figures();

/// Figures by name: a path into result.json. The points of a sweep have the same names, and share
/// them: a figure of a point then costs eight bytes.
class Metrics {
 public:
  using Names = std::vector<std::string>;

  Metrics() = default;
  /// Sorts them; those of one name are added up.
  explicit Metrics(std::vector<std::pair<std::string, double>> figures);
  Metrics(std::initializer_list<std::pair<std::string, double>> figures)
      : Metrics(std::vector<std::pair<std::string, double>>(figures)) {}
  /// `names` are sorted, and as many as `values`.
  Metrics(std::shared_ptr<const Names> names, std::vector<double> values);

  /// Null if missing.
  const double* find(const std::string& name) const;
  /// Of its value; values().size() if missing.
  std::size_t place_of(const std::string& name) const;
  bool empty() const { return values_.empty(); }
  /// Sorted.
  const Names& names() const { return *names_; }
  /// In the order of the names.
  const std::vector<double>& values() const { return values_; }

  /// Uses the other's names if they are the same.
  void share_names(const Metrics& other);
  bool shares_names(const Metrics& other) const { return names_ == other.names_; }
  const std::shared_ptr<const Names>& shared_names() const { return names_; }

 private:
  std::shared_ptr<const Names> names_ = none();
  std::vector<double> values_;

  static const std::shared_ptr<const Names>& none();
};

/// Every number and truth of a result (without provenance and configuration) by its path:
/// "summary.fps.mean", "timing.met". Members of a list are named by their `name`, others by their
/// position; those of one name are added up: "power.modules.ps.cores.w" is the power of that
/// module, whatever rails and reasons it has. Of the frames, mean and largest value over all of
/// them: "frames.counts.words.mean", "frames.time_us.receive.max" (of those with a result),
/// "frames.figures.peak.mean" (what the design finds). Of the timing also
/// "timing.failed" and "timing.unknown": how many modules are clocked above a known limit, and
/// above one of which only a lower bound is known. Of the verdict "verdict.feasible" and
/// "verdict.<part>.holds": 1 for yes, 0 for no, 0.5 for unknown.
Metrics metrics_of(const Json& result);

/// Figures of some names among those of points: found once for points that share names.
class Selection {
 public:
  /// `wanted` are sorted.
  explicit Selection(Metrics::Names wanted) : wanted_(std::move(wanted)) {}

  /// The wanted ones among a point's.
  Metrics of(const Metrics& all) { return picked_from(all).of(all); }
  /// Where the values of all wanted ones stand; all.values().size() for what the point lacks.
  const std::vector<std::size_t>& places_in(const Metrics& all) { return picked_from(all).places; }
  /// Sorted names of all figures that were seen.
  Metrics::Names seen() const;

 private:
  struct Picked {
    std::shared_ptr<const Metrics::Names> all, names;  ///< before and after
    std::vector<std::size_t> places;

    Metrics of(const Metrics& figures) const;
  };

  const Picked& picked_from(const Metrics& all);

  Metrics::Names wanted_;
  std::map<const Metrics::Names*, Picked> picked_;  ///< by `all`
};

/// The figures that all points have, each with the same value.
class CommonFigures {
 public:
  /// A point's; nothing if it has none.
  void add(const Metrics& metrics);
  /// The value of a figure in all points that have any; none if it differs, or a point lacks it.
  std::optional<double> value(const std::string& name) const;

 private:
  Metrics first_;
  Selection selection_{{}};             ///< its names
  std::vector<unsigned char> differs_;  ///< by place in `first_`
};

/// metrics_of() of one result after another: those of the same shape as the one before cost no new
/// names.
class MetricsReader {
 public:
  Metrics read(const Json& result);

 private:
  Metrics::Names paths_;            ///< of the result before, as they were found
  std::vector<std::size_t> order_;  ///< places of the values in `before_`, by path
  Metrics before_;
};

}  // namespace platform::result
