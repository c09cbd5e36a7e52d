#pragma once

#include <cstdint>
#include <fstream>
#include <functional>
#include <string>

#include <boost/test/unit_test.hpp>

#include <marker/scene/scene.h>

#include "executable.h"

/// Runs of the design `improved`, and what tests ask of their results.
namespace integration::improved_runs {

inline Json run_of(const Arguments& arguments, int exit_code = 0, const char* design = "improved") {
  const Workplace place;
  Arguments all = arguments;
  for (const char* more :
       {"--design", design, "--quiet", "--no-pictures", "--set", "profile=a9-O2"})
    all.emplace_back(more);
  const kit::Outcome outcome = place.run(all);
  BOOST_TEST(outcome.exit_code == exit_code, outcome.err);
  return place.result();
}

inline Arguments with(Arguments arguments, const std::string& assignment) {
  arguments.insert(arguments.end(), {"--set", assignment});
  return arguments;
}

/// The first place where both fidelities differ; empty: none.
inline std::string difference(const Arguments& arguments, int exit_code = 0) {
  Json fast = run_of(with(arguments, "fidelity=tlm"), exit_code);
  Json slow = run_of(with(arguments, "fidelity=clocked"), exit_code);
  for (const char* key : {"fidelity", "configuration", "provenance"}) {
    fast.erase(key);
    slow.erase(key);
  }
  const Json patch = Json::diff(fast, slow);
  return patch.empty() ? "" : patch[0].dump();
}

/// Mean over the frames.
inline double mean_us(const Json& result, const std::string& stage) {
  double sum = 0;
  for (const Json& frame : result["frames"]) sum += double(frame["time_us"][stage]);
  return sum / static_cast<double>(result["frames"].size());
}

inline double period_us(const Json& result) {
  return 1e6 / double(result["summary"]["fps"]["mean"]);
}

inline double latency_us(const Json& frame) {
  return frame["time_us"]["last_pixel_to_result"];
}

/// Of the scenes' markers, each of which was found.
inline double mean_error(const Json& result, const char* what) {
  double sum = 0;
  for (const Json& frame : result["frames"])
    sum += double(frame["markers"].at(0).at("error").at(what));
  return sum / static_cast<double>(result["frames"].size());
}

/// A picture of 640x480 px; its path.
inline std::string picture_in(const kit::TemporaryFolder& folder, const std::string& name,
                              const std::function<int(int x, int y)>& grey) {
  const std::string path = folder / (name + ".pgm");
  std::ofstream file(path, std::ios::binary);
  file << "P5 640 480 255\n";
  for (int y = 0; y < 480; ++y)
    for (int x = 0; x < 640; ++x) file.put(static_cast<char>(grey(x, y)));
  return path;
}

/// Of an upright marker of `side` px at (0, 0), and the white around it. IDs begin anew at 250.
inline int grey_of_marker(int id, int x, int y, int side) {
  if (x < 0 || x >= side || y < 0 || y >= side) return 220;
  const int row = y * 6 / side - 1, column = x * 6 / side - 1;
  const bool is_border = row < 0 || row > 3 || column < 0 || column > 3;
  const std::uint16_t word = platform::marker_word(id % platform::dictionary_size);
  return is_border || platform::is_black(word, row, column) ? 30 : 220;
}

inline const Arguments scenes{"demo", "squares15", "roll30", "front7", "z4.5", "z0.5"};

/// A picture whose markers 0 to 7 are on a board of four columns.
inline Arguments of_board(Arguments picture) {
  for (const char* setting : {"sw.board=grid", "sw.board_columns=4", "sw.board_rows=2",
                              "sw.marker_side=0.1 m", "sw.board_gap=0.1 m"})
    picture = with(picture, setting);
  return picture;
}

/// Eight markers of 60 px, 60 px apart, seen from the front.
inline Arguments board_in(const kit::TemporaryFolder& folder) {
  return of_board({picture_in(folder, "board", [](int x, int y) {
    const int u = x - 80, v = y - 120;
    if (u < 0 || u >= 480 || v < 0 || v >= 240) return 220;
    return grey_of_marker(u / 120 + v / 120 * 4, u % 120, v % 120, 60);
  })});
}

}  // namespace integration::improved_runs
