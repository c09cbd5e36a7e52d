#include <validation/plots.h>

#include <fmt/format.h>

#include <cstdlib>
#include <stdexcept>

namespace platform::validation {

namespace {

/// Threshold of the corner detection (SPEC, decision), if a configuration says none.
constexpr int usual_corner_threshold = 30;

int corner_threshold(const Run& run) {
  const auto entry = run.configuration.find("pl.corner_detection.threshold");
  return entry == run.configuration.end() ? usual_corner_threshold
                                          : std::atoi(entry->second.c_str());
}

}  // namespace

double published_value(const Validation& v, const std::string& id) {
  for (const Row& row : v.rows) {
    if (row.published.id == id) return row.published.value;
  }
  throw std::out_of_range("no published value " + id);
}

std::string published_line(const Validation& v, const std::string& id, double scale) {
  return fmt::format("{} with lines ls 9 title 'thesis, mean'", published_value(v, id) * scale);
}

double position_of(const Frame& frame) {
  return std::atof(frame.input.c_str() + frame.group.size());
}

std::vector<Plot> all_plots(const Validation& v) {
  const auto frames = v.measured.hybrid.of(marker_tests);
  std::vector<Plot> plots = feature_plots(v);
  for (const Plot& plot : test_plots(v, image_work(frames, corner_threshold(v.measured.hybrid)))) {
    plots.push_back(plot);
  }
  for (const Plot& plot : accuracy_plots(v)) plots.push_back(plot);
  return plots;
}

}  // namespace platform::validation
