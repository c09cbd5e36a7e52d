#include <fmt/format.h>

#include <validation/measures.h>
#include <validation/plots.h>

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

}  // namespace platform::validation
