#include <zynq/cost_profile.h>

namespace platform {

namespace {

struct Entry {
  const char* work;
  ps::WorkCost cost;
};

// Unoptimised code (-O0), as the thesis' times suggest. `derived`: from the thesis' identification
// share (12 % of 7.1 ms for one candidate of 2304 samples, 5.4.1.1), its ratio of 0.858 against a
// cached image (5.4.1.6), and 41.35 us for a pose of one to two iterations (5.4.1.7). The others
// are `assumed`: statements of the source times about ten cycles each.
constexpr Entry entries[] = {
    {"frames", {2000, 0}},             // assumed
    {"interrupts", {300, 0}},          // assumed; register accesses and exception entry come on top
    {"words_received", {40, 0}},       // assumed
    {"packets_decoded", {90, 0}},      // assumed
    {"blobs_evaluated", {1200, 0}},    // assumed
    {"corner_tests", {60, 0}},         // assumed
    {"quadrant_tests", {80, 0}},       // assumed
    {"score_evaluations", {150, 0}},   // assumed
    {"candidates", {400, 0}},          // assumed
    {"homographies", {3000, 0}},       // assumed
    {"grid_samples", {198, 0}},        // derived: 0.858 of 231 cycles
    {"grid_samples_dma", {0, 49}},     // derived: 0.142 of 231 cycles at 667 MHz
    {"cells", {60, 0}},                // assumed
    {"rotations", {700, 0}},           // assumed
    {"dictionary_compares", {60, 0}},  // assumed
    {"poses", {6000, 0}},              // derived: 9 us of 41.35 us
    {"posit_iterations", {7190, 0}},   // derived: the rest, for a start and two refinements
};

}  // namespace

ps::CostTable assumed_costs() {
  ps::CostTable table("assumed");
  for (const Entry& entry : entries) table.set(entry.work, entry.cost);
  return table;
}

}  // namespace platform
