#include <study/doubt.h>

#include <algorithm>

#include <study/pareto.h>

namespace platform::study {

namespace {

constexpr std::size_t most_bands = 8;  ///< of one figure: each doubles what is looked at
constexpr const char* middle = ".nominal";

using Figures = std::vector<std::vector<double>>;

/// Of each point the better or the worse end of every span.
Figures ends(const std::vector<std::vector<Span>>& points, const std::vector<bool>& maximise,
             bool better) {
  Figures figures;
  figures.reserve(points.size());
  for (const std::vector<Span>& spans : points) {
    figures.emplace_back();
    for (std::size_t i = 0; i < spans.size(); ++i)
      figures.back().push_back(maximise[i] == better ? spans[i].high : spans[i].low);
  }
  return figures;
}

std::vector<std::size_t> first_front(const Figures& figures, const std::vector<bool>& maximise) {
  const std::vector<std::size_t> front = fronts(figures, maximise);
  std::vector<std::size_t> members;
  for (std::size_t i = 0; i < front.size(); ++i) {
    if (front[i] == 1) members.push_back(i);
  }
  return members;
}

}  // namespace

std::vector<std::string> band_of(const std::string& metric) {
  const std::size_t length = std::string(middle).size();
  if (metric.size() <= length || metric.compare(metric.size() - length, length, middle) != 0)
    return {};
  const std::string stem = metric.substr(0, metric.size() - length);
  return {stem + ".low", stem + ".high"};
}

std::optional<Span> span_in(const ResultRow& row, const vp::Expression& figure) {
  const std::optional<double> nominal = figure_in(row, figure);
  if (!nominal) return std::nullopt;
  std::vector<std::string> banded;
  for (const std::string& name : figure.names()) {
    const std::vector<std::string> band = band_of(name);
    if (!band.empty() && row.metrics.find(band[0]) && row.metrics.find(band[1]))
      banded.push_back(name);
  }
  if (banded.size() > most_bands) return std::nullopt;
  Span span{*nominal, *nominal};
  for (std::size_t ends = 0; !banded.empty() && ends < 1u << banded.size(); ++ends) {
    const vp::ExpressionValue value = figure.value([&](const std::string& name) {
      const auto place = std::find(banded.begin(), banded.end(), name);
      if (place == banded.end()) return value_in(row, name);
      const bool is_high = ends >> (place - banded.begin()) & 1u;
      return value_in(row, band_of(name)[is_high ? 1 : 0]);
    });
    if (!value.known) return std::nullopt;
    span.low = std::min(span.low, static_cast<double>(value.number));
    span.high = std::max(span.high, static_cast<double>(value.number));
  }
  return span;
}

// What dominates is found among those that nothing dominates: at their worst for what is sure, at
// their best for what is possible. A point at its best may hide others from that front: where it is
// on it, all are looked at.
std::vector<result::Holds> surely_dominated(const std::vector<std::vector<Span>>& points,
                                            const std::vector<bool>& maximise) {
  const Figures best = ends(points, maximise, true), worst = ends(points, maximise, false);
  const std::vector<std::size_t> solid = first_front(worst, maximise);
  const std::vector<std::size_t> hopeful = first_front(best, maximise);
  std::vector<bool> is_hopeful(points.size(), false);
  for (const std::size_t i : hopeful) is_hopeful[i] = true;
  std::vector<result::Holds> found;
  found.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool surely = std::any_of(solid.begin(), solid.end(), [&](std::size_t j) {
      return dominates(worst[j], best[i], maximise);
    });
    bool possibly = !is_hopeful[i];
    for (std::size_t j = 0; j < points.size() && !possibly; ++j)
      possibly = j != i && dominates(best[j], worst[i], maximise);
    found.push_back(surely     ? result::Holds::yes
                    : possibly ? result::Holds::unknown
                               : result::Holds::no);
  }
  return found;
}

}  // namespace platform::study
