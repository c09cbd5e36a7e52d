#pragma once

#include <apps/improved/frame_optics.h>
#include <hal/hal.h>
#include <hal/option_data.h>
#include <marker/camera.h>
#include <marker/code_book.h>
#include <marker/marker_detector.h>
#include <marker/pose_filter.h>

#include <cstdint>

/// X(name, unit or names, default, minimum, maximum, documentation). The order is that of
/// hal_program.options, and of `dictionary` that of marker::dictionaries.
#define IMPROVED_OPTIONS(X)                                                                    \
  X(dictionary,                                                                                \
    "4x4_50|4x4_100|4x4_250|4x4_1000|5x5_50|5x5_100|5x5_250|5x5_1000|6x6_50|6x6_100|6x6_250|"  \
    "6x6_1000|7x7_50|7x7_100|7x7_250|7x7_1000|apriltag_36h11|apriltag_16h5|apriltag_25h9|"     \
    "aruco_original|aruco_mip_36h12",                                                          \
    2, 0, 20, "markers that are looked for (the thesis' are 4x4_250)")                         \
  X(dictionary_file, HAL_UNIT_FILE, 0, 0, 1,                                                   \
    "markers of your own instead: a dictionary of OpenCV's, a family of AprilTag's in C")      \
  X(border_bits, "", 1, 1, 3, "width of a marker's black border, cells")                       \
  X(board, "none|grid|charuco", 0, 0, 2,                                                       \
    "none: each marker has a pose of its own; else one pose of all that are on the board")     \
  X(marker_side, "m", 0.30, 0.001, 100, "side of a marker's black square (thesis chapter 5)")  \
  X(board_columns, "", 5, 1, 1000, "of a grid: markers; of a ChArUco board: squares")          \
  X(board_rows, "", 7, 1, 1000, "the same from top to bottom")                                 \
  X(board_gap, "m", 0.06, 0, 100, "between the markers of a grid")                             \
  X(board_first_id, "", 0, 0, 1000, "ID of the top left marker of a grid")                     \
  X(board_square, "m", 0.40, 0.001, 100, "side of a square of a ChArUco board")                \
  X(board_white_first, "", 0, 0, 1,                                                            \
    "1: the top left square of the ChArUco board is white (OpenCV up to 4.6, even rows)")      \
  X(minimum_side, "px", 9, 4, 1000,                                                            \
    "blobs whose box is smaller are not looked at: six cells of the least size (decision)")    \
  X(white_border, "", 0, 0, 32, "so many cells of a marker's border may be white (decision)")  \
  X(minimum_contrast, "", 8, 5, 255,                                                           \
    "grey levels between the sides of an edge; as few as dim light leaves (decision)")         \
  X(crossings, "", 256, 16, 256,                                                               \
    "places of a side, at most, where its edge is measured: time for accuracy (decision)")     \
  X(tries, "camera|one|nearer|outlines", 0, 0, 3,                                              \
    "nearer: what is refused is looked at once more, nearer to its edge (neighbours that "     \
    "nearly touch); outlines: and then its outline is followed (touched and hidden corners); " \
    "camera: outlines, but one where levels are light, as in scenes")                          \
  X(response, "camera|linear|srgb|rec709|exponent|found", 0, 0, 5,                             \
    "what light grey levels stand for. camera: as its file says, else linear in scenes and "   \
    "found from the markers in pictures")                                                      \
  X(response_exponent, "", 2.2, 0.5, 5,                                                        \
    "light is this power of the grey level (sw.response=exponent)")                            \
  X(overlap, "", 1, 0, 1,                                                                      \
    "1: the logic takes the next frame while the software works on the last; 0: one by one")   \
  X(second_core, "", 0, 0, 1,                                                                  \
    "1: both cores read the markers of a frame; poses are part of their detection then")       \
  X(pose_filter, "", 0, 0, 1,                                                                  \
    "1: poses follow from those of the frames before, too (Kalman filter of steady motion)")   \
  X(filter_acceleration, "", 2, 0.001, 10000,                                                  \
    "m/s2, of the motion that the filter expects (assumed: a camera in the hand)")             \
  X(filter_turn_acceleration, "", 10, 0.001, 100000, "rad/s2, of its turns (assumed)")         \
  X(timeout, "ms", 100, 0.1, 1000000,                                                          \
    "longest time from the trigger to a frame in memory "                                      \
    "(decision)")

namespace improved {

/// The options as values in the units above.
struct Options {
  const marker::Dictionary* dictionary;
  const void* own_dictionary;  ///< DictionaryData of the user's own; nullptr: none
  std::uint32_t border;        ///< width of a marker's, cells
  marker::DetectorOptions detector;
  OpticsOptions optics;
  bool overlap;
  bool second_core;
  bool pose_filter;
  marker::PoseFilterOptions filter;
  double timeout;
};

/// For hal_program.options.
extern const hal_option_info option_table[];
extern const std::uint32_t option_count;

/// What the run asks for.
Options read_options();

}  // namespace improved
