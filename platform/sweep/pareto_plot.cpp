#include <algorithm>
#include <sstream>
#include <string_view>

#include <host/gnuplot.h>
#include <sweep/csv_line.h>
#include <sweep/pareto.h>
#include <vp/text.h>

namespace platform::sweep {

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
