#include <study/doubt.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <numeric>

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

/// Finds whether one of many points dominates a place: of up to two objectives by bisection, of
/// more by looking at all.
class Dominators {
 public:
  Dominators(const Figures& figures, const std::vector<bool>& maximise)
      : figures_(figures), maximise_(maximise) {
    if (maximise.size() > 2) return;
    std::vector<std::size_t> order(figures.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return first(figures[a]) > first(figures[b]); });
    Step step;
    for (const std::size_t i : order) {
      step.first = first(figures[i]);
      const double second = this->second(figures[i]);
      if (second > step.most) {
        step.next = step.most;
        step.most = second;
        step.holder = i;
      } else {
        step.next = std::max(step.next, second);
      }
      steps_.push_back(step);
    }
  }

  /// Without the point `except`.
  bool dominate(const std::vector<double>& place, std::size_t except) const {
    if (maximise_.size() > 2) {
      for (std::size_t j = 0; j < figures_.size(); ++j)
        if (j != except && dominates(figures_[j], place, maximise_)) return true;
      return false;
    }
    const double x = first(place), y = second(place);
    const auto better = std::partition_point(steps_.begin(), steps_.end(),
                                             [x](const Step& s) { return s.first > x; });
    const auto no_worse =
        std::partition_point(better, steps_.end(), [x](const Step& s) { return s.first == x; });
    return most_before(better, except) >= y || most_before(no_worse, except) > y;
  }

 private:
  static constexpr double nothing = -std::numeric_limits<double>::infinity();

  /// The best two in the second objective, of a point and those better in the first.
  struct Step {
    double first = 0;
    double most = nothing;
    double next = nothing;
    std::size_t holder = 0;  ///< of `most`
  };
  using Place = std::vector<Step>::const_iterator;

  double turned(const std::vector<double>& figures, std::size_t i) const {
    return maximise_[i] ? figures[i] : -figures[i];
  }
  double first(const std::vector<double>& figures) const { return turned(figures, 0); }
  double second(const std::vector<double>& figures) const {
    return maximise_.size() > 1 ? turned(figures, 1) : 0;
  }
  double most_before(Place end, std::size_t except) const {
    if (end == steps_.begin()) return nothing;
    const Step& step = *std::prev(end);
    return step.holder == except ? step.next : step.most;
  }

  const Figures& figures_;
  const std::vector<bool>& maximise_;
  std::vector<Step> steps_;  ///< best first in the first objective
};

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

std::vector<result::Holds> surely_dominated(const std::vector<std::vector<Span>>& points,
                                            const std::vector<bool>& maximise) {
  const Figures best = ends(points, maximise, true), worst = ends(points, maximise, false);
  const Dominators at_worst(worst, maximise), at_best(best, maximise);
  std::vector<result::Holds> found;
  found.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    found.push_back(at_worst.dominate(best[i], i)   ? result::Holds::yes
                    : at_best.dominate(worst[i], i) ? result::Holds::unknown
                                                    : result::Holds::no);
  }
  return found;
}

}  // namespace platform::study
