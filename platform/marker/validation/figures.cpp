#include <fmt/format.h>

#include <marker/scene/renderer.h>
#include <marker/scene/scene.h>
#include <marker/validation/measured.h>
#include <marker/validation/validation.h>

namespace platform::validation {

namespace {

using Table = std::vector<std::vector<double>>;

constexpr const char* squares_label = "squares in the image";
constexpr const char* squares_range = "set xrange [0:16]\nset xtics 1, 2, 15\n";
constexpr double last_image = 15;

/// Columns: 1 squares, 2 frame, 3 corner, 4 blob, 5 threshold, 6 evaluation, 7 identification,
/// 8 pose (ms), 9 share of identification (%), 10 candidates; hybrid 11 feature extraction and 12
/// receive, PS-only 11 capture.
void add_stages(PlotScript& script, const Validation& v) {
  Table hybrid, ps;
  for (const Frame* f : v.measured.hybrid.of(feature_test)) {
    hybrid.push_back({position_of(*f), frame_ms(*f), hybrid_corner_ms(*f), hybrid_blob_ms(*f),
                      hybrid_threshold_ms(*f), evaluation_ms(*f), identification_ms(*f),
                      pose_ms(*f), identification_share(*f), static_cast<double>(f->candidates),
                      f->ms("feature_extraction"), f->ms("receive")});
  }
  for (const Frame* f : v.measured.ps_only.of(feature_test)) {
    ps.push_back({position_of(*f), frame_ms(*f), ps_corner_ms(*f), ps_blob_ms(*f),
                  ps_threshold_ms(*f), evaluation_ms(*f), identification_ms(*f), pose_ms(*f),
                  identification_share(*f), static_cast<double>(f->candidates), ps_capture_ms(*f)});
  }
  script.data("hybrid", hybrid);
  script.data("ps", ps);
}

Plot total_plot(const Validation& v) {
  PlotScript script(2, 1);
  add_stages(script, v);
  Table speedup;
  const auto hybrid = v.measured.hybrid.of(feature_test), ps = v.measured.ps_only.of(feature_test);
  for (std::size_t i = 0; i < hybrid.size(); ++i) {
    speedup.push_back({position_of(*hybrid[i]), frame_ms(*ps[i]) / frame_ms(*hybrid[i])});
  }
  script.data("speedup", speedup);
  script.data("ends", {{1, published_value(v, "speedup.features.first")},
                       {last_image, published_value(v, "speedup.features.last")}});
  script.panel("Whole frame", squares_label, "time (ms)",
               fmt::format("{}set yrange [0:120]\nplot "
                           "$hybrid using 1:2 with linespoints ls 1 title 'hybrid', "
                           "$ps using 1:2 with linespoints ls 2 title 'PS-only'",
                           squares_range));
  script.panel("Speed-up", squares_label, "PS-only time / hybrid time",
               fmt::format("{}set yrange [0:15]\nset key bottom left\nplot "
                           "{} with lines ls 9 title 'thesis, mean', "
                           "$ends with points ls 9 title 'thesis, 1 and 15 squares', "
                           "$speedup with linespoints ls 1 title 'platform'",
                           squares_range, published_value(v, "speedup.features")));
  return {"features_total", "Time of a frame and speed-up while squares are added", "5.29",
          script.text()};
}

Plot stack_plot(const Validation& v) {
  PlotScript script(2, 1);
  add_stages(script, v);
  const char* boxes =
      "set xrange [0.4:15.6]\nset xtics 1, 2, 15\nset boxwidth 0.8\n"
      "set key top left horizontal maxrows 3\n";
  // Sums, the tallest first: each box hides the lower part of the one before.
  script.panel(
      "Hybrid", squares_label, "time (ms)",
      fmt::format("{}set yrange [0:20]\nplot "
                  "$hybrid using 1:($11+$12+$6+$7+$8) with boxes ls 5 title 'pose', "
                  "$hybrid using 1:($11+$12+$6+$7) with boxes ls 1 title 'identification', "
                  "$hybrid using 1:($11+$12+$6) with boxes ls 2 title 'evaluation', "
                  "$hybrid using 1:($11+$12) with boxes ls 3 title 'receive', "
                  "$hybrid using 1:11 with boxes ls 6 title 'features (PL)'",
                  boxes));
  script.panel(
      "PS-only", squares_label, "time (ms)",
      fmt::format("{}set yrange [0:160]\nset ytics 20\nplot "
                  "$ps using 1:($11+$3+$5+$4+$6+$7) with boxes ls 1 title 'identification', "
                  "$ps using 1:($11+$3+$5+$4+$6) with boxes ls 2 title 'evaluation', "
                  "$ps using 1:($11+$3+$5+$4) with boxes ls 4 title 'blob detection', "
                  "$ps using 1:($11+$3+$5) with boxes ls 5 title 'threshold', "
                  "$ps using 1:($11+$3) with boxes ls 6 title 'corner detection', "
                  "$ps using 1:11 with boxes ls 3 title 'capture'",
                  boxes));
  return {"stages", "Stages of a frame while squares are added", "5.28, 5.30 and 5.31",
          script.text()};
}

/// Lines of both systems, and what the thesis prints of each.
std::string both(int column, const std::string& range, const std::string& extra) {
  return fmt::format(
      "{}{}\nplot {}$hybrid using 1:{} with linespoints ls 1 title 'hybrid', "
      "$ps using 1:{} with linespoints ls 2 title 'PS-only'",
      squares_range, range, extra.empty() ? "" : extra + ", ", column, column);
}

/// Two published levels, named once.
std::string levels(double one, double other) {
  return fmt::format("{} with lines ls 9 title 'thesis, mean', {} with lines ls 9 notitle", one,
                     other);
}

Plot stage_times_plot(const Validation& v) {
  PlotScript script(3, 2);
  add_stages(script, v);
  const double pl_ms = published_value(v, "corner.hybrid") / 1000;
  const double identification = published_value(v, "identification.hybrid");
  script.panel(
      "Corner detection", squares_label, "time (ms)",
      both(3, "set yrange [0:80]", levels(pl_ms, pl_ms + published_value(v, "corner.delta"))));
  script.panel(
      "Blob detection", squares_label, "time (ms)",
      both(4, "set yrange [0:32]", levels(pl_ms, pl_ms + published_value(v, "blob.delta"))));
  script.panel(
      "Threshold", squares_label, "time (ms)",
      both(5, "set yrange [0:17]",
           levels(published_value(v, "threshold.hybrid"), published_value(v, "threshold.ps"))));
  script.panel("Feature evaluation", squares_label, "time (ms)",
               both(6, "set yrange [0:0.35]", ""));
  script.panel(
      "Marker identification", squares_label, "time (ms)",
      both(7, "set yrange [0:10]",
           levels(identification, identification * published_value(v, "identification.speedup"))));
  script.panel("Pose estimation", squares_label, "time (µs)",
               fmt::format("{}set yrange [0:70]\nplot {}, "
                           "$hybrid using 1:($8*1000) with linespoints ls 1 title 'hybrid', "
                           "$ps using 1:($8*1000) with linespoints ls 2 title 'PS-only'",
                           squares_range, published_line(v, "pose.duration")));
  return {"stage_times", "Each stage while squares are added", "5.32 to 5.36", script.text()};
}

Plot identification_plot(const Validation& v) {
  PlotScript script(2, 1);
  add_stages(script, v);
  const auto share = [&](const char* name) {
    return published_value(v, std::string("identification.share.") + name);
  };
  script.data("hybrid_ends", {{1, share("hybrid.first")}, {last_image, share("hybrid.last")}});
  script.data("ps_ends", {{1, share("ps.first")}, {last_image, share("ps.last")}});
  script.panel("Identification against candidates", "candidates in the image", "time (ms)",
               "set xrange [0:16]\nset yrange [0:9]\nplot "
               "$hybrid using 10:7 with points ls 1 title 'hybrid', "
               "$ps using 10:7 with points ls 2 title 'PS-only'");
  script.panel("Share of identification", squares_label, "part of the frame's time (%)",
               fmt::format("{}set yrange [0:75]\nplot $hybrid_ends with points ls 9 title "
                           "'thesis, 1 and 15 squares', $ps_ends with points ls 9 notitle, "
                           "$hybrid using 1:9 with linespoints ls 1 title 'hybrid', "
                           "$ps using 1:9 with linespoints ls 2 title 'PS-only'",
                           squares_range));
  return {"identification", "Identification: a step for each candidate before the marker",
          "5.30, 5.31 and 5.36", script.text()};
}

}  // namespace

std::vector<Plot> feature_plots(const Validation& v) {
  return {total_plot(v), stack_plot(v), stage_times_plot(v), identification_plot(v)};
}

namespace {

using Table = std::vector<std::vector<double>>;

constexpr int corner_column = 2, blob_column = 3, dark_column = 4, evaluated_column = 5,
              hybrid_corner_column = 6, hybrid_blob_column = 7, ps_corner_column = 8,
              ps_blob_column = 9, hybrid_frame_column = 10, ps_frame_column = 11,
              speedup_column = 12;

/// A row for each image of one family of tests; column 1 is its position in marker_tests.
void add_family(PlotScript& script, const std::string& name, const Validation& v,
                const std::vector<std::string>& groups, const std::vector<ImageWork>& work) {
  Table table;
  const auto hybrid = v.measured.hybrid.of(marker_tests), ps = v.measured.ps_only.of(marker_tests);
  for (std::size_t i = 0; i < hybrid.size(); ++i) {
    const Frame &fast = *hybrid[i], &slow = *ps[i];
    const bool member = [&] {
      for (const std::string& group : groups) {
        if (group == fast.group) return true;
      }
      return false;
    }();
    if (!member) continue;
    table.push_back({static_cast<double>(i), static_cast<double>(fast.corners),
                     static_cast<double>(fast.blobs), static_cast<double>(work[i].dark) / 1000,
                     static_cast<double>(work[i].evaluated) / 1000, hybrid_corner_ms(fast),
                     hybrid_blob_ms(fast), ps_corner_ms(slow), ps_blob_ms(slow), frame_ms(fast),
                     frame_ms(slow), frame_ms(slow) / frame_ms(fast)});
  }
  script.data(name, table);
}

void add_families(PlotScript& script, const Validation& v, const std::vector<ImageWork>& work) {
  add_family(script, "translation", v, translation_tests, work);
  add_family(script, "rotation", v, rotation_tests, work);
  add_family(script, "features", v, feature_test, work);
}

std::string scatter(int x, int y) {
  return fmt::format(
      "plot $translation using {0}:{1} ls 1 title 'translation', "
      "$rotation using {0}:{1} ls 2 title 'rotation', "
      "$features using {0}:{1} ls 3 title 'squares'",
      x, y);
}

/// Room above the points for the key.
constexpr const char* room = "set offsets graph 0.03, graph 0.03, graph 0.3, graph 0.05\n";

Plot corner_scatter(const Validation& v, const std::vector<ImageWork>& work) {
  PlotScript script(3, 1);
  add_families(script, v, work);
  script.panel("Hybrid", "corners", "corner detection (ms)",
               room + scatter(corner_column, hybrid_corner_column));
  script.panel(
      "PS-only", "corners", "corner detection (ms)",
      room + std::string("set key top right\n") + scatter(corner_column, ps_corner_column));
  script.panel("PS-only", "pixels that pass the pre-test (thousands)", "corner detection (ms)",
               room + scatter(evaluated_column, ps_corner_column));
  return {"corner_scatter", "Corner detection in all tests", "5.37 to 5.39", script.text()};
}

Plot blob_scatter(const Validation& v, const std::vector<ImageWork>& work) {
  PlotScript script(3, 1);
  add_families(script, v, work);
  script.panel(
      "Hybrid", "blobs", "blob detection (ms)",
      std::string(room) + "set yrange [6.1:6.2]\n" + scatter(blob_column, hybrid_blob_column));
  script.panel("PS-only", "blobs", "blob detection (ms)",
               room + std::string("set key bottom right\n") + scatter(blob_column, ps_blob_column));
  script.panel("PS-only", "dark pixels (thousands)", "blob detection (ms)",
               room + std::string("set xrange [0:*]\n") + scatter(dark_column, ps_blob_column));
  return {"blob_scatter", "Blob detection in all tests", "5.40, 5.41 and 5.43", script.text()};
}

/// Names of the tests below the images of translation and rotation tests.
std::string test_names(const Validation& v) {
  std::string tics;
  std::size_t first = 0;
  const auto frames = v.measured.hybrid.of(marker_tests);
  for (std::size_t i = 0; i < frames.size() && frames[i]->group != "squares"; ++i) {
    const bool last = i + 1 == frames.size() || frames[i + 1]->group != frames[i]->group;
    if (!last) continue;
    const double middle = static_cast<double>(first + i) / 2;
    tics += fmt::format("{}'{}' {}", tics.empty() ? "" : ", ", frames[i]->group, middle);
    first = i + 1;
  }
  return "set xtics (" + tics + ")\n";
}

Plot times_plot(const Validation& v, const std::vector<ImageWork>& work) {
  PlotScript script(3, 1);
  add_families(script, v, work);
  const std::string names = test_names(v) + "set xrange [-1:41]\n";
  const auto lines = [](int column) {
    return fmt::format(
        "plot $translation using 1:{0} ls 1 title 'translation', "
        "$rotation using 1:{0} ls 2 title 'rotation'",
        column);
  };
  script.panel("Hybrid", "test", "time of a frame (ms)",
               names + "set yrange [6:9]\n" + lines(hybrid_frame_column));
  script.panel("PS-only", "test", "time of a frame (ms)",
               names + "set yrange [84:94]\n" + lines(ps_frame_column));
  const double translation = published_value(v, "speedup.translation");
  const double rotation = published_value(v, "speedup.rotation");
  script.data("translation_mean", {{-0.5, translation}, {18.5, translation}});
  script.data("rotation_mean", {{18.5, rotation}, {40.5, rotation}});
  script.panel("Speed-up", "test", "PS-only time / hybrid time",
               names + fmt::format("set yrange [10:17]\nplot "
                                   "$translation_mean with lines ls 9 title 'thesis, mean', "
                                   "$rotation_mean with lines ls 9 notitle, "
                                   "$translation using 1:{0} ls 1 title 'translation', "
                                   "$rotation using 1:{0} ls 2 title 'rotation'",
                                   speedup_column));
  return {"test_times", "Translation and rotation tests, image by image", "5.44 and 5.45",
          script.text()};
}

Plot dark_plot() {
  constexpr int steps_of = 5, levels = 256;
  PlotScript script(1, 1);
  const GreyImage image = render(make_scene("z2.0"));
  Table table;
  for (int level = 0; level < levels; level += steps_of) {
    const auto dark = count_dark(image, static_cast<std::uint32_t>(level));
    table.push_back({static_cast<double>(level), static_cast<double>(dark) / 1000});
  }
  script.data("dark", table);
  script.panel("Image z2.0", "threshold (grey level)", "dark pixels (thousands)",
               "set xrange [0:255]\nset yrange [0:*]\n"
               "plot $dark with linespoints ls 1 title 'of 307 thousand'");
  return {"dark_pixels", "Dark pixels by threshold", "5.42", script.text()};
}

}  // namespace

std::vector<Plot> test_plots(const Validation& v, const std::vector<ImageWork>& work) {
  return {corner_scatter(v, work), blob_scatter(v, work), dark_plot(), times_plot(v, work)};
}

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
