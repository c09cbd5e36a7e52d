#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>
#include <string_view>

#include <host/child.h>
#include <sweep/pareto.h>
#include <sweep/results.h>
#include <sweep/tables.h>
#include <vp/error.h>
#include <vp/text.h>

namespace platform::sweep {

namespace {

/// What stands behind "max " or "min ".
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

namespace {

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

std::vector<bool> directions(const std::vector<Objective>& objectives) {
  std::vector<bool> maximise;
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

report::Holds feasible(const Results& results, const ResultRow& row,
                       const std::vector<vp::Expression>& constraints) {
  const auto lookup = [&](const std::string& name) { return value_in(row, name); };
  for (const vp::Expression& constraint : constraints) {
    if (missing_in(row, constraint) || !constraint.holds(lookup)) return report::Holds::no;
  }
  return results.feasible(row);
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

/// All that points are judged by. Throws for a name that no point has.
std::vector<const vp::Expression*> checked(const Results& results,
                                           const std::vector<Objective>& objectives,
                                           const std::vector<vp::Expression>& constraints) {
  std::vector<const vp::Expression*> all;
  if (results.job) check_names(results, *results.job);
  for (const Objective& objective : objectives) {
    all.push_back(&objective.figure());
    check_names(results, *all.back());
  }
  for (const vp::Expression& constraint : constraints) {
    all.push_back(&constraint);
    check_names(results, constraint);
  }
  return all;
}

std::vector<std::string> texts(const std::vector<Objective>& objectives) {
  std::vector<std::string> result;
  for (const Objective& objective : objectives) result.push_back(objective.figure().text());
  return result;
}

}  // namespace

std::vector<std::size_t> fronts(const std::vector<std::vector<double>>& figures,
                                const std::vector<bool>& maximise) {
  std::vector<std::size_t> front(figures.size(), 0);
  std::vector<std::size_t> left(figures.size());
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = i;
  for (std::size_t number = 1; !left.empty(); ++number) {
    std::vector<std::size_t> dominated;
    for (const std::size_t i : left) {
      const bool is_dominated = std::any_of(left.begin(), left.end(), [&](std::size_t j) {
        return dominates(figures[j], figures[i], maximise);
      });
      if (is_dominated) {
        dominated.push_back(i);
      } else {
        front[i] = number;
      }
    }
    left = std::move(dominated);
  }
  return front;
}

Pareto rank(const Results& results, const std::vector<Objective>& objectives,
            const std::vector<vp::Expression>& constraints) {
  Pareto pareto;
  const std::vector<const vp::Expression*> expressions = checked(results, objectives, constraints);
  for (const ResultRow& row : results.rows) {
    if (row.failed) continue;
    RankedPoint point;
    point.row = &row;
    point.figures = figures_of(row, objectives);
    point.feasible = feasible(results, row, constraints);
    count_lacking(row, expressions, pareto.lacking);
    pareto.points.push_back(std::move(point));
  }
  if (pareto.points.empty()) throw vp::InputError("the sweep has no point with a result");
  std::vector<std::vector<double>> figures;
  std::vector<RankedPoint*> ranked;
  for (RankedPoint& point : pareto.points) {
    if (point.feasible != report::Holds::yes || point.figures.empty()) continue;
    ranked.push_back(&point);
    figures.push_back(point.figures);
  }
  if (ranked.empty())
    throw vp::InputError("no point is feasible" +
                         std::string(constraints.empty() ? "" : ", meets the constraints") +
                         " and has a value of every objective: " + verdicts_text(results));
  const std::vector<bool> maximise = directions(objectives);
  const std::vector<std::size_t> front = fronts(figures, maximise);
  for (std::size_t i = 0; i < ranked.size(); ++i) ranked[i]->front = front[i];
  pareto.knee = knee_of(pareto.points, maximise);
  return pareto;
}

std::string pareto_table(const Results& results, const std::vector<Objective>& objectives,
                         const Pareto& pareto) {
  std::vector<std::string> names = results.manifest.swept;
  for (const std::string& text : texts(objectives)) names.push_back(text);
  std::vector<std::string> head = short_names(names);
  head.emplace_back("");
  TextTable table(head);
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < pareto.points.size(); ++i) {
    if (pareto.points[i].front == 1) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return pareto.points[a].figures[0] < pareto.points[b].figures[0];
  });
  for (const std::size_t i : order) {
    std::vector<std::string> row;
    for (const std::string& path : results.manifest.swept)
      row.push_back(pareto.points[i].row->value(path));
    for (const double figure : pareto.points[i].figures) row.push_back(readable(figure));
    row.emplace_back(pareto.knee == i ? "knee" : "");
    table.add(row);
  }
  return table.text();
}

std::string pareto_csv(const Results& results, const std::vector<Objective>& objectives,
                       const Pareto& pareto) {
  std::vector<std::string> head{"key", "front", "knee", "feasible"};
  for (const std::string& path : results.manifest.swept) head.push_back(path);
  for (const Objective& objective : objectives)
    head.push_back((objective.maximise() ? "max " : "min ") + objective.figure().text());
  std::string text = csv_line(head);
  for (std::size_t i = 0; i < pareto.points.size(); ++i) {
    const RankedPoint& point = pareto.points[i];
    std::vector<std::string> fields{point.row->key, std::to_string(point.front),
                                    pareto.knee == i ? "1" : "0", to_string(point.feasible)};
    for (const std::string& path : results.manifest.swept) fields.push_back(point.row->value(path));
    for (const double figure : point.figures) fields.push_back(csv_number(figure));
    fields.resize(head.size());
    text += csv_line(fields);
  }
  return text;
}

namespace {

/// The unit that the metric's name ends with, as " / W"; empty for a count or an expression.
std::string axis_unit(const std::string& metric) {
  constexpr std::pair<const char*, const char*> units[] = {
      {"fps", "1/s"}, {"_w", "W"},   {"_us", "µs"}, {"_mj", "mJ"},   {"_mm", "mm"},
      {"_px", "px"},  {"_deg", "°"}, {"_c", "°C"},  {"_mhz", "MHz"}, {"_percent", "%"}};
  if (metric.find_first_of(" */+-()") != std::string::npos) return "";
  for (const std::string& part : vp::split(metric, '.')) {
    for (const auto& [end, unit] : units) {
      const std::string_view wanted = end;
      if (part.size() >= wanted.size() &&
          part.compare(part.size() - wanted.size(), wanted.size(), wanted) == 0)
        return std::string(" / ") + unit;
    }
  }
  return "";
}

std::string axis_label(const Objective& objective) {
  const std::string text = objective.figure().text();
  return text + axis_unit(text) +
         (objective.maximise() ? "  (more is better)" : "  (less is better)");
}

/// Points for which `wanted` holds, as a data block of gnuplot.
template <class Wanted>
std::string block(const std::string& name, const Pareto& pareto, const Wanted& wanted) {
  std::vector<std::pair<double, double>> points;
  for (std::size_t i = 0; i < pareto.points.size(); ++i) {
    if (!pareto.points[i].figures.empty() && wanted(i))
      points.emplace_back(pareto.points[i].figures[0], pareto.points[i].figures[1]);
  }
  std::sort(points.begin(), points.end());
  std::string text = "$" + name + " << EOD\n";
  for (const auto& [x, y] : points) text += csv_number(x) + " " + csv_number(y) + "\n";
  // A block must not be empty: not a number is not drawn.
  if (points.empty()) text += "NaN NaN\n";
  return text + "EOD\n";
}

}  // namespace

std::optional<std::string> plot_pareto(const std::string& file, const Results& results,
                                       const std::vector<Objective>& objectives,
                                       const Pareto& pareto) {
  if (objectives.size() < 2) return "a plot needs two objectives";
  const auto& points = pareto.points;
  std::ostringstream script;
  script << "set encoding utf8\n"
         << "set terminal svg size 800,560 font 'sans,14' noenhanced background rgb 'white'\n"
         << block("infeasible", pareto,
                  [&](std::size_t i) { return points[i].feasible == report::Holds::no; })
         << block("unknown", pareto,
                  [&](std::size_t i) { return points[i].feasible == report::Holds::unknown; })
         << block("dominated", pareto, [&](std::size_t i) { return points[i].front > 1; })
         << block("front", pareto, [&](std::size_t i) { return points[i].front == 1; })
         << block("knee", pareto, [&](std::size_t i) { return pareto.knee == i; }) << "set title "
         << host::gnuplot_quoted(results.manifest.title.empty() ? results.manifest.name
                                                                : results.manifest.title)
         << "\nset xlabel " << host::gnuplot_quoted(axis_label(objectives[0])) << "\nset ylabel "
         << host::gnuplot_quoted(axis_label(objectives[1])) << "\n"
         << "set grid lc rgb '#dddddd'\nset bmargin 6\nset key at screen 0.5, screen 0.03 center "
            "bottom horizontal\nset offsets "
            "graph 0.05, graph 0.05, graph 0.05, graph 0.05\n"
         // Okabe and Ito's palette: every eye tells them apart.
         << "plot $infeasible with points pt 2 ps 0.8 lc rgb '#999999' title 'infeasible', "
            "$unknown with points pt 8 ps 0.9 lc rgb '#e69f00' title 'unknown', "
            "$dominated with points pt 7 ps 0.6 lc rgb '#56b4e9' title 'dominated', "
            "$front with linespoints pt 7 ps 0.9 lw 2 lc rgb '#0072b2' title 'Pareto front', "
            "$knee with points pt 6 ps 2 lw 3 lc rgb '#d55e00' title 'knee'\n";
  const host::CommandEnd end = host::draw_with_gnuplot(file, script.str());
  if (end.exit_code == 0) return std::nullopt;
  if (end.exit_code == host::no_such_command)
    return "gnuplot is not installed (package gnuplot-nox)";
  std::string said(vp::trim(end.out));
  std::replace(said.begin(), said.end(), '\n', ' ');
  return "gnuplot: " + said;
}

}  // namespace platform::sweep
