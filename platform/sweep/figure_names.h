#pragma once

#include <set>
#include <string>
#include <vector>

#include <sweep/manifest.h>
#include <sweep/metrics.h>

namespace platform::sweep {

/// Which of the figures that a sweep asks for do not exist. What figures there are, only results
/// tell.
class FigureNames {
 public:
  explicit FigureNames(const Manifest& manifest);

  /// What to say of those that the first result does not have; nothing of later results. Figures of
  /// frames may be in another: they depend on what was found.
  std::vector<std::string> missing_in_first(const Metrics& result);
  /// What to say of those that no result has, whose names are these, sorted.
  std::vector<std::string> missing_in_all(const Metrics::Names& known) const;

 private:
  std::vector<std::string> missing(const Metrics::Names& known) const;

  std::set<std::string> asked_;
  bool seen_ = false;
};

}  // namespace platform::sweep
