#include <sweep/figure_names.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include <sweep/objective.h>
#include <vp/text.h>

namespace platform::sweep {

namespace {

std::string advice(const std::string& name, const Metrics::Names& known) {
  const std::string nearest = vp::nearest_match(name, known);
  return nearest.empty() ? ": a sweep without 'metrics' puts all that there are into sweep.csv"
                         : ": did you mean '" + nearest + "'?";
}

}  // namespace

FigureNames::FigureNames(const Manifest& manifest)
    : asked_(manifest.metrics.begin(), manifest.metrics.end()) {
  for (const std::string& text : manifest.objectives) {
    const Objective objective(text, manifest.name);
    for (const std::string& name : objective.figure().names()) asked_.insert(name);
  }
  // Objectives may use parameters, too.
  for (const Family& family : manifest.families) {
    for (const auto& [path, value] : family.configuration) asked_.erase(path);
  }
  for (const char* special : {"system", "program", "inputs"}) asked_.erase(special);
}

std::vector<std::string> FigureNames::missing_in_first(const Metrics& result) {
  std::vector<std::string> complaints;
  if (std::exchange(seen_, true)) return complaints;
  for (const std::string& name : missing(result.names())) {
    if (name.rfind("frames.", 0) != 0)
      complaints.push_back("the first result has no metric '" + name + "'" +
                           advice(name, result.names()));
  }
  return complaints;
}

std::vector<std::string> FigureNames::missing_in_all(const Metrics::Names& known) const {
  std::vector<std::string> complaints;
  for (const std::string& name : missing(known))
    complaints.push_back("no result has the metric '" + name + "'" + advice(name, known));
  return complaints;
}

std::vector<std::string> FigureNames::missing(const Metrics::Names& known) const {
  std::vector<std::string> names;
  std::copy_if(asked_.begin(), asked_.end(), std::back_inserter(names), [&](const auto& name) {
    return !std::binary_search(known.begin(), known.end(), name);
  });
  return names;
}

}  // namespace platform::sweep
