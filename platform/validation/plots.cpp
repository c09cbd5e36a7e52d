#include <fmt/format.h>

#include <cstdlib>
#include <stdexcept>

#include <host/process.h>
#include <validation/validation.h>
#include <vp/error.h>
#include <vp/text.h>

namespace platform::validation {

namespace {

namespace fs = std::filesystem;

constexpr int panel_width = 430, panel_height = 310;  // px

/// Line styles 1 to 6: colours that people with any colour vision can tell apart (Okabe and Ito
/// 2008), each with a point of its own. Style 9: what the thesis prints.
constexpr const char* styles = R"(
set style line 1 lc rgb '#0072B2' lw 2 pt 7 ps 0.6
set style line 2 lc rgb '#D55E00' lw 2 pt 5 ps 0.6
set style line 3 lc rgb '#009E73' lw 2 pt 9 ps 0.7
set style line 4 lc rgb '#E69F00' lw 2 pt 13 ps 0.8
set style line 5 lc rgb '#CC79A7' lw 2 pt 11 ps 0.7
set style line 6 lc rgb '#56B4E9' lw 2 pt 4 ps 0.7
set style line 9 lc rgb '#333333' lw 1.5 dt (8,5) pt 2 ps 1
set style fill solid 0.9 noborder
set border 3 lc rgb '#666666'
set tics nomirror out scale 0.5
set grid ytics lc rgb '#DDDDDD' lw 1 dt 1
set key top left samplen 2 spacing 1.1
)";

/// What every panel begins with: the one before may have changed it.
constexpr const char* fresh = R"(
unset label
unset arrow
unset logscale
set style data points
set xtics autofreq norotate
set ytics autofreq
set autoscale
set offsets 0, 0, 0, 0
set key top left Left reverse
)";

}  // namespace

PlotScript::PlotScript(int columns, int rows) : columns_(columns), rows_(rows) {}

void PlotScript::data(const std::string& name, const std::vector<std::vector<double>>& rows) {
  data_ += "$" + name + " << EOD\n";
  for (const std::vector<double>& row : rows) {
    std::vector<std::string> cells;
    cells.reserve(row.size());
    for (const double value : row) cells.push_back(vp::format_fixed(value, 6));
    data_ += vp::join(cells, " ") + "\n";
  }
  data_ += "EOD\n";
}

void PlotScript::panel(const std::string& title, const std::string& x_label,
                       const std::string& y_label, const std::string& commands) {
  panels_ += fresh;
  panels_ += "set title " + host::gnuplot_quoted(title) + "\nset xlabel " +
             host::gnuplot_quoted(x_label) + "\nset ylabel " + host::gnuplot_quoted(y_label) +
             "\n" + commands + "\n";
}

std::string PlotScript::text() const {
  const std::string size = fmt::format("{},{}", columns_ * panel_width, rows_ * panel_height);
  return fmt::format("set terminal svg size {} dynamic font 'sans-serif,12' background '#FFFFFF'\n",
                     size) +
         "set encoding utf8\n" + data_ + styles +
         fmt::format("set multiplot layout {},{}\n", rows_, columns_) + panels_ +
         "unset multiplot\n";
}

bool draw(const Plot& plot, const fs::path& folder) {
  const host::CommandEnd end =
      host::draw_with_gnuplot((folder / (plot.name + ".svg")).string(), plot.script);
  if (end.exit_code == host::no_such_command) return false;
  if (end.exit_code != 0) {
    throw vp::InputError("gnuplot could not draw '" + plot.name +
                         "': " + std::string(vp::trim(end.out)));
  }
  return true;
}

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
