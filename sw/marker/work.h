#pragma once

#include <hal/hal.h>

#include <cstdint>

/// The units of work that PS programs count: X(name, what one unit is). The order is that of
/// hal_program.work.
#define MARKERVP_WORK_ITEMS(X)                                                        \
  X(frames, "a frame set up and taken down by the application")                       \
  X(interrupts, "a DMA interrupt served, dispatcher included")                        \
  X(words_received, "a feature word stored, counted and acknowledged")                \
  X(packets_decoded, "a feature word decoded and stored as corner or half a box")     \
  X(blobs_evaluated, "a bounding box prepared and its four corners checked")          \
  X(corner_tests, "a corner looked at for one blob: assigned? inside the box?")       \
  X(quadrant_tests, "a corner inside the box tested against one quadrant")            \
  X(score_evaluations, "a corner score computed and compared")                        \
  X(candidates, "a candidate stored")                                                 \
  X(homographies, "the eight components of appendix D")                               \
  X(grid_samples, "a canonical sample mapped into the image and read")                \
  X(grid_samples_dma, "one of them read from memory that a DMA engine wrote: stalls") \
  X(cells, "a cell's majority decided")                                               \
  X(rotations, "a code turned by a quarter")                                          \
  X(dictionary_compares, "a Hamming distance to one dictionary word")                 \
  X(poses, "a pose set up and concluded")                                             \
  X(posit_iterations, "one POS step of POSIT with the error of both its poses")

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
  X(pose_estimation)

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
