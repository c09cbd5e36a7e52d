#pragma once

#include <hal/hal.h>

#include <cstdint>

/// The units of work that PS programs count: X(name, what one unit is). The order is that of
/// hal_program.work.
#define MARKERVP_WORK_ITEMS(X)                                                                \
  X(frames, "a frame set up and taken down by the application")                               \
  X(interrupts, "a DMA interrupt served, dispatcher included")                                \
  X(words_received, "a feature word stored, counted and acknowledged")                        \
  X(packets_decoded, "a feature word decoded; a corner is stored, too")                       \
  X(boxes_decoded, "two words matched to a bounding box and stored")                          \
  X(corners_freed, "a corner marked as not assigned before the evaluation")                   \
  X(blobs_evaluated, "a bounding box prepared and its four corners checked")                  \
  X(corner_tests, "a corner looked at for one blob: assigned already?")                       \
  X(box_tests, "a corner not assigned: inside the box?")                                      \
  X(corners_inside, "a corner inside the box: its quadrants")                                 \
  X(quadrant_tests, "one of them tested against one quadrant")                                \
  X(score_evaluations, "a corner score computed and compared")                                \
  X(quads_checked, "four corners of a box: distinct and convex?")                             \
  X(candidates, "a candidate stored")                                                         \
  X(homographies, "the eight components of appendix D")                                       \
  X(grid_samples, "a canonical sample mapped into the image and read")                        \
  X(grid_samples_dma, "one of them read from memory that a DMA engine wrote: stalls")         \
  X(cells, "a cell's majority decided")                                                       \
  X(rotations, "a code turned by a quarter")                                                  \
  X(dictionary_compares, "a code compared with one of the dictionary")                        \
  X(poses, "a pose set up and concluded")                                                     \
  X(posit_iterations, "one POS step of POSIT with the error of both its poses")               \
  X(corner_frames, "an image searched for corners on the PS: what does not depend on it")     \
  X(corner_rows, "a row of points scored")                                                    \
  X(corner_pixels, "a point pre-tested, and its strength looked at")                          \
  X(corner_survivors, "a point that passed the pre-test: all 16 pixels of its circle")        \
  X(corner_bright, "a bright pixel on the circle of such a point")                            \
  X(corner_points, "a corner before suppression, compared with its neighbours")               \
  X(corners_found, "a corner stored with its direction")                                      \
  X(threshold_frames, "an image made binary on the PS: histogram cleared, peaks found")       \
  X(threshold_pixels, "a pixel counted in the histogram and compared")                        \
  X(blob_frames, "an image grouped on the PS: what does not depend on it")                    \
  X(blob_rows, "a row grouped, and ended blobs looked for")                                   \
  X(blob_pixels, "a pixel of the binary image read, its label stored")                        \
  X(blob_dark, "one of them dark")                                                            \
  X(blob_runs, "a dark pixel without labelled left neighbour: the whole window")              \
  X(blob_rivals, "another label enters the window of a run: widths compared")                 \
  X(blob_labels, "a new label")                                                               \
  X(blob_label_checks, "a label asked whether its blob ended")                                \
  X(blobs_ended, "a label given back, its box filtered by size")                              \
  X(blobs_checked, "a blob of a packet: its extremes and its size checked")                   \
  X(quads_spanned, "four of eight extremes chosen, before a pixel is read")                   \
  X(hulls_tested, "four that span more than those before: convex?")                           \
  X(quads_fitted, "a candidate's corners looked for: set up and concluded")                   \
  X(quads_refined, "its covariance, at the end of the last pass")                             \
  X(fit_passes, "a quadrilateral's sides set up")                                             \
  X(side_fits, "a side measured: path, grey levels, line, without its crossings")             \
  X(corners_met, "a corner where two lines meet")                                             \
  X(lens_steps, "a point led once through the lens, with its derivatives")                    \
  X(strips, "a strip laid across a side")                                                     \
  X(crossings, "the edge in one of them found and taken into the line")                       \
  X(transitions, "a crossing whose blur is measured")                                         \
  X(points_refitted, "a crossing moved up and taken into a line once more")                   \
  X(level_reads, "a strip asked for the grey levels beside its edge")                         \
  X(level_pixels, "a pixel beyond a transition read for a grey level")                        \
  X(codes_read, "a marker's cells set up")                                                    \
  X(code_cells, "a cell of a marker read in nine places")                                     \
  X(code_parts, "a word of a book looked at in the search for a part of one")                 \
  X(code_compares, "a cell in which a word differs from one of a book counted, and one more") \
  X(code_turns, "a cell of a word turned by a quarter")                                       \
  X(board_poses, "a pose of a marker or board set up, both solutions concluded")              \
  X(pose_steps, "a step of one of them, without the markers")                                 \
  X(markers_weighted, "what the corners of a marker weigh, from their covariance")            \
  X(marker_weighings, "a marker's corners weighed in such a step")                            \
  X(crossings_dma, "a crossing in memory that a DMA engine wrote: stalls")                    \
  X(code_cells_dma, "a cell in such memory: stalls")                                          \
  X(tracks_begun, "a pose that the filter sees for the first time, or anew")                  \
  X(poses_predicted, "a pose led on to the time of a frame")                                  \
  X(poses_weighed, "a pose of a frame held against it: the covariance's Cholesky factor")     \
  X(poses_corrected, "a pose corrected by that of the frame")                                 \
  X(lit_fits, "a quadrilateral to be measured in light")                                      \
  X(lit_corners, "four of them concluded, with their covariance")                             \
  X(lit_passes, "its sides set up, its corners met")                                          \
  X(lit_side_fits, "a side measured in light, without its crossings")                         \
  X(lit_crossings, "the edge in a strip of light found and taken into the line")              \
  X(lit_strips, "a strip of light laid across a side")                                        \
  X(lit_level_reads, "such a strip asked for the light beside its edge")                      \
  X(lit_level_pixels, "a pixel beyond a transition read for it")                              \
  X(lit_refitted, "a crossing in light taken into a line once more")                          \
  X(lit_transitions, "a crossing in light whose blur is measured")                            \
  X(lens_bends, "a point led once through a polynomial lens of any model")                    \
  X(lens_angles, "the angle of a ray, for a fisheye lens")                                    \
  X(lens_radii, "how far from the axis it is seen, with the slope")                           \
  X(lens_tangents, "the tangent of an angle")                                                 \
  X(inner_cells, "two neighbouring cells of a marker: an edge between them?")                 \
  X(inner_edges, "such an edge laid out in the picture")                                      \
  X(inner_strips, "a strip across one of them")                                               \
  X(inner_blurs, "such an edge freed from the blur of the cells around")                      \
  X(inner_pixels, "a pixel of such a strip")                                                  \
  X(curves_made, "a response curve's table filled")                                           \
  X(outlines, "a blob's outline looked for, set up and concluded")                            \
  X(outline_samples, "a pixel looked at for what is dark around a blob")                      \
  X(outline_looks, "a neighbour of an outline's pixel: dark?")                                \
  X(outline_points, "a pixel of the outline followed")                                        \
  X(outline_distances, "one held against a chord")                                            \
  X(outline_fitted, "one taken into a line")                                                  \
  X(outline_meets, "two lines: do they meet?")                                                \
  X(outline_covers, "four pieces that meet: do they cover their sides?")                      \
  X(packets_summed, "a packet whose checksum is looked at, of any length")                    \
  X(words_summed, "a word of it")                                                             \
  X(local_frames, "a picture searched with a threshold of each pixel's own")                  \
  X(local_rows, "a row of it")                                                                \
  X(local_pixels, "a pixel held against the mean around it")                                  \
  X(local_runs, "dark pixels beside each other, added to their blob")                         \
  X(local_joins, "two blobs that turn out to be one")

/// The functions that PS programs annotate, as in traces and reports. The order is that of
/// hal_program.functions.
#define MARKERVP_FUNCTIONS(X) \
  X(upload)                   \
  X(receive)                  \
  X(dma_interrupt)            \
  X(decode)                   \
  X(feature_evaluation)       \
  X(rectification)            \
  X(identification)           \
  X(pose_estimation)          \
  X(capture)                  \
  X(corner_detection)         \
  X(thresholding)             \
  X(blob_detection)           \
  X(marker_detection)         \
  X(quad_fit)                 \
  X(cell_reading)             \
  X(pose_filter)

namespace marker {

enum class Work : std::uint32_t {
#define MARKERVP_ENUMERATOR(name, unit) name,
  MARKERVP_WORK_ITEMS(MARKERVP_ENUMERATOR)
#undef MARKERVP_ENUMERATOR
      count
};

enum class Function : std::uint32_t {
#define MARKERVP_ENUMERATOR(name) name,
  MARKERVP_FUNCTIONS(MARKERVP_ENUMERATOR)
#undef MARKERVP_ENUMERATOR
      count
};

/// For hal_program.work.
inline constexpr const char* work_names[] = {
#define MARKERVP_NAME(name, unit) #name,
    MARKERVP_WORK_ITEMS(MARKERVP_NAME)
#undef MARKERVP_NAME
};

/// For hal_program.functions.
inline constexpr const char* function_names[] = {
#define MARKERVP_NAME(name) #name,
    MARKERVP_FUNCTIONS(MARKERVP_NAME)
#undef MARKERVP_NAME
};

/// `count` units of `item` were done. Nothing on the chip.
inline void work([[maybe_unused]] Work item, [[maybe_unused]] std::uint64_t count) {
  hal_work(static_cast<std::uint32_t>(item), count);
}

/// Counts one unit in `counter`, for work() to tell later. Nothing on the chip.
#ifdef HAL_BARE_METAL
#define MARKERVP_COUNT(counter) static_cast<void>(0)
#else
#define MARKERVP_COUNT(counter) static_cast<void>(++(counter))
#endif

/// Adds to such a counter.
#ifdef HAL_BARE_METAL
#define MARKERVP_ADD(counter, units) static_cast<void>(0)
#else
#define MARKERVP_ADD(counter, units) static_cast<void>((counter) += (units))
#endif

/// Marks a function from construction to the end of the block. Nothing on the chip.
class FunctionScope {
 public:
  explicit FunctionScope([[maybe_unused]] Function function) {
    hal_function_enter(static_cast<std::uint32_t>(function));
  }
  ~FunctionScope() { hal_function_leave(); }
  FunctionScope(const FunctionScope&) = delete;
  FunctionScope& operator=(const FunctionScope&) = delete;
};

}  // namespace marker
