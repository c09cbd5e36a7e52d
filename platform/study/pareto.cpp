#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <set>

#include <result/console.h>
#include <result/metrics.h>
#include <result/table.h>
#include <study/doubt.h>
#include <study/pareto.h>
#include <study/results.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>

namespace platform::study {

namespace {

/// What is behind "max " or "min ".
std::string figure_text(const std::string& text, const std::string& where) {
  const std::string trimmed(vp::trim(text));
  const std::string first = trimmed.substr(0, 4);
  if ((first != "max " && first != "min ") || trimmed.size() < 5)
    throw vp::InputError(where + ": the objective '" + text +
                         "' does not say which way is better: write 'max METRIC' or 'min METRIC'");
  return trimmed.substr(4);
}

}  // namespace

Objective::Objective(const std::string& text, const std::string& where)
    : maximise_(vp::trim(text).substr(0, 3) == "max"), figure_(figure_text(text, where), where) {}

bool dominates(const std::vector<double>& a, const std::vector<double>& b,
               const std::vector<bool>& maximise) {
  bool better = false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double x = maximise[i] ? a[i] : -a[i];
    const double y = maximise[i] ? b[i] : -b[i];
    if (x < y) return false;
    better = better || x > y;
  }
  return better;
}

namespace {

std::vector<bool> directions(const std::vector<Objective>& objectives) {
  std::vector<bool> maximise;
  maximise.reserve(objectives.size());
  for (const Objective& objective : objectives) maximise.push_back(objective.maximise());
  return maximise;
}

std::optional<std::size_t> knee_of(const std::vector<RankedPoint>& points,
                                   const std::vector<bool>& maximise) {
  std::vector<double> low(maximise.size(), std::numeric_limits<double>::infinity());
  std::vector<double> high(maximise.size(), -std::numeric_limits<double>::infinity());
  std::size_t size = 0;
  for (const RankedPoint& point : points) {
    if (point.front != 1) continue;
    ++size;
    for (std::size_t i = 0; i < maximise.size(); ++i) {
      low[i] = std::min(low[i], point.figures[i]);
      high[i] = std::max(high[i], point.figures[i]);
    }
  }
  std::optional<std::size_t> knee;
  if (size <= 2) return knee;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (points[p].front != 1) continue;
    double distance = 0;
    for (std::size_t i = 0; i < maximise.size(); ++i) {
      if (high[i] == low[i]) continue;
      const double best = maximise[i] ? high[i] : low[i];
      const double part = (points[p].figures[i] - best) / (high[i] - low[i]);
      distance += part * part;
    }
    if (distance < nearest) {
      nearest = distance;
      knee = p;
    }
  }
  return knee;
}

/// The figures of the objectives; empty if the point lacks one.
std::vector<double> figures_of(const ResultRow& row, const std::vector<Objective>& objectives) {
  std::vector<double> figures;
  for (const Objective& objective : objectives) {
    const std::optional<double> figure = figure_in(row, objective.figure());
    if (!figure) return {};
    figures.push_back(*figure);
  }
  return figures;
}

/// Counts the metrics that the point lacks, each once.
void count_lacking(const ResultRow& row, const std::vector<const vp::Expression*>& expressions,
                   std::map<std::string, std::uint64_t>& lacking) {
  std::set<std::string> names;
  for (const vp::Expression* expression : expressions) {
    if (const std::string* name = missing_in(row, *expression)) names.insert(*name);
  }
  for (const std::string& name : names) ++lacking[name];
}

std::vector<std::string> texts(const std::vector<Objective>& objectives) {
  std::vector<std::string> result;
  result.reserve(objectives.size());
  for (const Objective& objective : objectives) result.push_back(objective.figure().text());
  return result;
}

}  // namespace

// Seen best first by the first objective, a point is dominated only by what was seen before it, and
// if a front has such a point, so have all fronts before that one.
std::vector<std::size_t> fronts(const std::vector<std::vector<double>>& figures,
                                const std::vector<bool>& maximise) {
  std::vector<std::size_t> order(figures.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    for (std::size_t i = 0; i < maximise.size(); ++i) {
      if (figures[a][i] != figures[b][i]) return (figures[a][i] > figures[b][i]) == maximise[i];
    }
    return a < b;
  });
  std::vector<std::vector<std::size_t>> members;
  std::vector<std::size_t> front(figures.size(), 0);
  for (const std::size_t i : order) {
    const auto dominates_it = [&](std::size_t j) {
      return dominates(figures[j], figures[i], maximise);
    };
    const auto found =
        std::partition_point(members.begin(), members.end(), [&](const auto& of_front) {
          // With two objectives the last one is the best in the second.
          if (maximise.size() <= 2) return dominates_it(of_front.back());
          return std::any_of(of_front.rbegin(), of_front.rend(), dominates_it);
        });
    front[i] = static_cast<std::size_t>(found - members.begin()) + 1;
    if (found == members.end()) {
      members.push_back({i});
    } else {
      found->push_back(i);
    }
  }
  return front;
}

bool is_repetition(const Results& results, const ResultRow& row,
                   const std::vector<Objective>& objectives) {
  if (!row.same_as) return false;
  // Constraints and objectives may be on parameters, in which the two differ.
  const ResultRow& first = results.rows[*row.same_as];
  return results.feasible(first) == results.feasible(row) &&
         figures_of(first, objectives) == figures_of(row, objectives);
}

Pareto rank(const Results& results, const std::vector<Objective>& objectives) {
  Pareto pareto;
  std::vector<const vp::Expression*> expressions;
  expressions.reserve(objectives.size() + results.constraints.size());
  for (const Objective& objective : objectives) expressions.push_back(&objective.figure());
  for (const vp::Expression& constraint : results.constraints) expressions.push_back(&constraint);
  pareto.points.reserve(results.rows.size());
  for (const ResultRow& row : results.rows) {
    if (row.failed) continue;
    RankedPoint point;
    point.row = &row;
    point.figures = figures_of(row, objectives);
    point.feasible = results.feasible(row);
    count_lacking(row, expressions, pareto.lacking);
    pareto.points.push_back(std::move(point));
  }
  std::vector<std::vector<double>> figures;
  std::vector<RankedPoint*> ranked;
  for (RankedPoint& point : pareto.points) {
    if (point.feasible != result::Holds::yes || point.figures.empty() ||
        is_repetition(results, *point.row, objectives))
      continue;
    ranked.push_back(&point);
    figures.push_back(std::move(point.figures));
  }
  const std::vector<bool> maximise = directions(objectives);
  const std::vector<std::size_t> front = fronts(figures, maximise);
  for (std::size_t i = 0; i < ranked.size(); ++i) {
    ranked[i]->front = front[i];
    ranked[i]->figures = std::move(figures[i]);
  }
  pareto.knee = knee_of(pareto.points, maximise);
  return pareto;
}

void judge_by_bands(Pareto& pareto, const std::vector<Objective>& objectives) {
  std::vector<RankedPoint*> ranked;
  std::vector<std::vector<Span>> spans;
  for (RankedPoint& point : pareto.points) {
    if (point.front == 0) continue;
    ranked.push_back(&point);
    spans.emplace_back();
    for (const Objective& objective : objectives) {
      const double nominal = point.figures[spans.back().size()];
      const Span span = span_in(*point.row, objective.figure()).value_or(Span{nominal, nominal});
      pareto.has_bands = pareto.has_bands || span.low != span.high;
      spans.back().push_back(span);
    }
  }
  const std::vector<result::Holds> dominated = surely_dominated(spans, directions(objectives));
  for (std::size_t i = 0; i < ranked.size(); ++i) ranked[i]->dominated = dominated[i];
}

void find_better(Pareto& pareto, const std::vector<Objective>& objectives) {
  const std::vector<bool> maximise = directions(objectives);
  std::vector<std::size_t> best;
  std::vector<double> low(maximise.size(), std::numeric_limits<double>::infinity());
  std::vector<double> high(maximise.size(), -std::numeric_limits<double>::infinity());
  for (std::size_t p = 0; p < pareto.points.size(); ++p) {
    const RankedPoint& point = pareto.points[p];
    if (point.front == 0) continue;
    if (point.front == 1) best.push_back(p);
    for (std::size_t i = 0; i < maximise.size(); ++i) {
      low[i] = std::min(low[i], point.figures[i]);
      high[i] = std::max(high[i], point.figures[i]);
    }
  }
  const auto least_gain = [&](const RankedPoint& better, const RankedPoint& worse) {
    double least = 1;
    for (std::size_t i = 0; i < maximise.size(); ++i) {
      if (high[i] == low[i]) continue;
      const double gain = better.figures[i] - worse.figures[i];
      least = std::min(least, (maximise[i] ? gain : -gain) / (high[i] - low[i]));
    }
    return least;
  };
  for (RankedPoint& point : pareto.points) {
    if (point.front < 2) continue;
    double most = -1;
    for (const std::size_t p : best) {
      const double gain = least_gain(pareto.points[p], point);
      if (gain <= most || !dominates(pareto.points[p].figures, point.figures, maximise)) continue;
      most = gain;
      point.better = p;
    }
  }
}

std::vector<Objective> objectives_of(const Results& results) {
  std::vector<std::string> texts = results.manifest.objectives;
  if (texts.empty()) texts.assign(usual_objectives.begin(), usual_objectives.end());
  std::vector<Objective> objectives;
  for (const std::string& text : texts) {
    Objective objective(text, results.manifest.name);
    const auto has_it = [&](const ResultRow& row) {
      return figure_in(row, objective.figure()).has_value();
    };
    if (std::any_of(results.rows.begin(), results.rows.end(), has_it))
      objectives.push_back(std::move(objective));
  }
  return objectives;
}

std::vector<std::size_t> best_first(const Pareto& pareto,
                                    const std::vector<Objective>& objectives) {
  std::vector<std::size_t> order(pareto.points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto is_before = [&](std::size_t a, std::size_t b) {
    const RankedPoint& left = pareto.points[a];
    const RankedPoint& right = pareto.points[b];
    if (left.front == 0 || right.front == 0) return left.front > right.front;
    if (left.front != right.front) return left.front < right.front;
    return objectives.front().maximise() ? left.figures[0] > right.figures[0]
                                         : left.figures[0] < right.figures[0];
  };
  std::stable_sort(order.begin(), order.end(), is_before);
  return order;
}

namespace {

/// How far the point is from being feasible: parts of its verdict that do not hold, then the
/// constraints.
std::pair<std::ptrdiff_t, double> distance(const Results& results, const ResultRow& row) {
  const auto parts = std::count_if(
      std::begin(result::verdict_parts), std::end(result::verdict_parts),
      [&](const char* part) { return results.holds(row, part) != result::Holds::yes; });
  double shortfall = 0;
  for (const vp::Expression* constraint : results.broken(row)) {
    const auto lookup = [&](const std::string& name) { return value_in(row, name); };
    shortfall += missing_in(row, *constraint) ? 1 : constraint->shortfall(lookup);
  }
  return {parts, shortfall};
}

/// "clock = 50 MHz, labels = 16: breaks fps >= 200 (fps = 50)".
std::string described(const Results& results, const ResultRow& row) {
  std::vector<std::string> values, figures;
  for (const std::string& path : results.manifest.swept)
    values.push_back(path + " = " + row.value(path));
  std::set<std::string> names;
  for (const vp::Expression* constraint : results.broken(row))
    names.insert(constraint->names().begin(), constraint->names().end());
  for (const std::string& name : names) {
    if (const double* found = row.metrics.find(name))
      figures.push_back(name + " = " + result::readable(*found));
  }
  return vp::join(values, ", ") + ": " + vp::join(results.reasons(row), "; ") +
         (figures.empty() ? "" : " (" + vp::join(figures, ", ") + ")");
}

}  // namespace

std::string why_no_point(const Results& results) {
  std::vector<const ResultRow*> ran;
  for (const ResultRow& row : results.rows) {
    if (!row.failed) ran.push_back(&row);
  }
  if (ran.empty()) return "the sweep has no point with a result";
  const auto is_feasible = [&](const ResultRow* row) {
    return results.feasible(*row) == result::Holds::yes;
  };
  if (std::any_of(ran.begin(), ran.end(), is_feasible))
    return "no feasible point has a value of every objective";
  std::string text = "no point is feasible: " + verdicts_text(results);
  for (const vp::Expression& constraint : results.constraints) {
    const auto breaks = [&](const ResultRow* row) {
      const auto broken = results.broken(*row);
      return std::find(broken.begin(), broken.end(), &constraint) != broken.end();
    };
    const auto count = std::count_if(ran.begin(), ran.end(), breaks);
    if (count != 0)
      text += "; '" + constraint.text() + "' rules out " + std::to_string(count) + " of " +
              std::to_string(ran.size());
  }
  const ResultRow* nearest =
      *std::min_element(ran.begin(), ran.end(), [&](const ResultRow* a, const ResultRow* b) {
        return distance(results, *a) < distance(results, *b);
      });
  return text + "; the nearest is " + described(results, *nearest);
}

std::string doubt_text(const Pareto& pareto) {
  if (!pareto.has_bands) return "";
  std::size_t on_it = 0, sure = 0, others = 0, worse = 0;
  for (const RankedPoint& point : pareto.points) {
    if (point.front == 1) {
      ++on_it;
      sure += point.dominated == result::Holds::no;
    } else if (point.front > 1) {
      ++others;
      worse += point.dominated == result::Holds::yes;
    }
  }
  std::string text = "By the bands of the figures " + std::to_string(sure) + " of " +
                     result::counted(on_it, "point") + " on the front can be beaten by no other";
  if (others > 0)
    text += "; of " + std::to_string(others) + " behind it " + std::to_string(worse) +
            (worse == 1 ? " is" : " are") + " worse for sure";
  return text;
}

std::string pareto_table(const Results& results, const std::vector<Objective>& objectives,
                         const Pareto& pareto) {
  std::vector<std::string> names = results.manifest.swept;
  for (const std::string& text : texts(objectives)) names.push_back(text);
  std::vector<std::string> head = result::short_names(names);
  head.emplace_back("");
  result::TextTable table(head);
  for (const std::size_t i : best_first(pareto, objectives)) {
    if (pareto.points[i].front != 1) break;
    std::vector<std::string> row;
    for (const std::string& path : results.manifest.swept)
      row.push_back(pareto.points[i].row->value(path));
    for (const double figure : pareto.points[i].figures) row.push_back(result::readable(figure));
    std::vector<std::string> words;
    if (pareto.knee == i) words.emplace_back("knee");
    if (pareto.has_bands && pareto.points[i].dominated == result::Holds::no)
      words.emplace_back("for sure");
    row.push_back(vp::join(words, ", "));
    table.add(row);
  }
  return table.text();
}

void write_pareto_csv(const std::string& path, const Results& results,
                      const std::vector<Objective>& objectives, const Pareto& pareto) {
  vp::OutputFile file(path);
  std::vector<std::string> head{"key", "front", "knee", "feasible", "dominated"};
  for (const std::string& swept : results.manifest.swept) head.push_back(swept);
  for (const Objective& objective : objectives)
    head.push_back((objective.maximise() ? "max " : "min ") + objective.figure().text());
  head.emplace_back("better");
  for (const Objective& objective : objectives)
    head.push_back("better by " + objective.figure().text());
  file.write(result::csv_line(head));
  for (std::size_t i = 0; i < pareto.points.size(); ++i) {
    const RankedPoint& point = pareto.points[i];
    std::vector<std::string> fields{point.row->key, std::to_string(point.front),
                                    pareto.knee == i ? "1" : "0", to_string(point.feasible),
                                    point.dominated ? to_string(*point.dominated) : ""};
    for (const std::string& swept : results.manifest.swept)
      fields.push_back(point.row->value(swept));
    for (const double figure : point.figures) fields.push_back(result::csv_number(figure));
    if (point.better) {
      const RankedPoint& better = pareto.points[*point.better];
      fields.push_back(better.row->key);
      for (std::size_t o = 0; o < objectives.size(); ++o)
        fields.push_back(result::csv_number(std::abs(better.figures[o] - point.figures[o])));
    }
    fields.resize(head.size());
    file.write(result::csv_line(fields));
  }
  file.commit_durably();
}

}  // namespace platform::study
