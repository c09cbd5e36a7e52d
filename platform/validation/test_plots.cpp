#include <fmt/format.h>

#include <scene/catalogue.h>
#include <scene/renderer.h>
#include <validation/measures.h>
#include <validation/plots.h>

namespace platform::validation {

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

}  // namespace platform::validation
