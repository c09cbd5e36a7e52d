#include <fmt/format.h>

#include <validation/measures.h>
#include <validation/plots.h>

namespace platform::validation {

namespace {

using Table = std::vector<std::vector<double>>;

struct Test {
  const char* group;
  const char* title;
  const char* x_label;
};

constexpr Test pose_tests[] = {
    {"x", "X displacement", "camera X (m)"},
    {"y", "Y displacement", "camera Y (m)"},
    {"z", "Z displacement", "distance (m)"},
    {"pitch", "Pitch", "angle (°)"},
    {"yaw", "Yaw", "angle (°)"},
    {"roll", "Roll", "angle (°)"},
};

/// Position, corner error mm, translation error mm, rotation error °, pixel width mm.
Table errors(const Validation& v, const char* group) {
  Table table;
  for (const Frame* frame : v.measured.hybrid.of({group})) {
    if (!frame->found || !frame->found->translation_mm) continue;
    const FoundTrue& found = *frame->found;
    table.push_back({position_of(*frame), found.corner_px * pixel_mm(found), *found.translation_mm,
                     *found.rotation_deg, pixel_mm(found)});
  }
  return table;
}

void add_data(PlotScript& script, const Validation& v) {
  for (const Test& test : pose_tests) script.data(test.group, errors(v, test.group));
}

/// One panel a test: an error by position, with the thesis' mean.
Plot pose_plot(const Validation& v, const std::string& what, const std::string& y_label,
               int column) {
  PlotScript script(3, 2);
  add_data(script, v);
  for (const Test& test : pose_tests) {
    const std::string id = std::string("pose.") + test.group + "." + what;
    script.panel(test.title, test.x_label, y_label,
                 fmt::format("set yrange [0:*]\nset offsets graph 0.04, graph 0.04, graph 0.35, 0\n"
                             "plot {}, ${} using 1:{} with linespoints ls 1 title 'platform'",
                             published_line(v, id), test.group, column));
  }
  return {"pose_" + what,
          "Error of the " + what + " in the six pose tests; dashed: mean of the thesis",
          "5.21 to 5.23 and 5.25 to 5.27", script.text()};
}

Plot corner_plot(const Validation& v) {
  PlotScript script(3, 1);
  add_data(script, v);
  script.panel("Z displacement", "distance (m)", "mean corner error (mm)",
               "set yrange [0:*]\n"
               "plot $z using 1:2 with linespoints ls 1 title 'platform', "
               "$z using 1:5 with lines ls 3 title 'width of a pixel'");
  script.panel("X, Y displacement at 2 m", "camera X, Y (m)", "mean corner error (mm)",
               fmt::format("set yrange [0:*]\nset offsets 0, 0, graph 0.3, 0\n"
                           "plot {}, $x using 1:2 with linespoints ls 1 title 'X', "
                           "$y using 1:2 with linespoints ls 2 title 'Y'",
                           published_line(v, "corner.error.translation")));
  script.panel("Roll at 1 m", "angle (°)", "mean corner error (mm)",
               fmt::format("set yrange [0:*]\nset offsets 0, 0, graph 0.3, 0\n"
                           "plot {}, $roll using 1:2 with linespoints ls 1 title 'platform'",
                           published_line(v, "corner.error.roll")));
  return {"corner_error", "Distance of the detected corners from the true ones", "5.19 and 5.20",
          script.text()};
}

Plot relation_plot(const Validation& v) {
  PlotScript script(1, 1);
  add_data(script, v);
  script.panel("Z displacement", "mean corner error (mm)", "translation error (mm)",
               "set yrange [0:*]\nset xrange [0:*]\n"
               "f(x) = a * x + b\nset fit quiet\nset fit logfile '/dev/null'\n"
               "fit f(x) $z using 2:3 via a, b\n"
               "plot $z using 2:3 with points ls 1 title 'platform', "
               "f(x) with lines ls 3 title 'best line'");
  return {"error_relation", "Error of the translation against that of the corners", "5.24",
          script.text()};
}

}  // namespace

std::vector<Plot> accuracy_plots(const Validation& v) {
  return {corner_plot(v), pose_plot(v, "translation", "translation error (mm)", 3),
          pose_plot(v, "rotation", "rotation error (°)", 4), relation_plot(v)};
}

}  // namespace platform::validation
