#pragma once

#include <map>
#include <string>
#include <vector>

#include <sweep/expression.h>
#include <sweep/metrics.h>
#include <sweep/parameter_table.h>
#include <sweep/point_file.h>
#include <sweep/store.h>

namespace platform::sweep {

/// A point of a sweep with its figures.
struct ResultRow {
  std::string key;
  Assignment swept;
  bool failed = false;
  Failure failure;  ///< if it failed
  Metrics metrics;  ///< empty if there is no result
  std::map<std::string, std::string> configuration;
  std::string program;
  std::string inputs;

  /// The text of a swept value; empty if the point leaves it alone.
  std::string value(const std::string& path) const;
};

/// A sweep's results, in the order of its points.
struct Results {
  Manifest manifest;
  std::vector<ResultRow> rows;
  std::uint64_t missing = 0;  ///< points not computed yet

  std::uint64_t failed() const;
  /// The names of all metrics, sorted.
  std::vector<std::string> metric_names() const;
  /// Those that the sweep asks for; all if it does not.
  std::vector<std::string> chosen_metrics() const;
};

/// Reads the points of the folder's last sweep; without `verify` they were verified before. Throws
/// vp::InputError for a damaged one.
Results read_results(const Store& store, Manifest manifest, bool verify = true);

/// What a name means for a row: a metric, a parameter, or system and inputs. Throws vp::InputError
/// for an unknown one, with the nearest; `where` says who asked.
Value value_in(const Results& results, const ResultRow& row, const std::string& name,
               const std::string& where);

}  // namespace platform::sweep
