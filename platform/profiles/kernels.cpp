#include <profiles/kernels.h>

namespace platform::profiles {

const std::vector<Kernel>& kernels() {
  static const std::vector<Kernel> all = {
      {"application", {"frames"}},
      {"interrupt", {"interrupts"}},
      {"receive", {"words_received"}},
      {"decode", {"packets_decoded", "boxes_decoded"}},
      {"evaluation",
       {"corner_tests", "box_tests", "corners_inside", "quadrant_tests", "score_evaluations",
        "quads_checked", "corners_freed", "blobs_evaluated", "candidates"}},
      {"identification",
       {"homographies", "grid_samples", "grid_samples_dma", "cells", "rotations",
        "dictionary_compares"}},
      {"pose", {"poses", "posit_iterations"}},
      {"corner_detection",
       {"corner_frames", "corner_rows", "corner_pixels", "corner_survivors", "corner_bright",
        "corner_points", "corners_found"}},
      {"threshold", {"threshold_frames", "threshold_pixels"}},
      {"blob_detection",
       {"blob_frames", "blob_rows", "blob_pixels", "blob_dark", "blob_runs", "blob_rivals",
        "blob_labels", "blob_label_checks", "blobs_ended"}},
  };
  return all;
}

std::string kernel_of(const std::string& unit) {
  for (const Kernel& kernel : kernels()) {
    for (const std::string& name : kernel.units) {
      if (name == unit) return kernel.name;
    }
  }
  return "";
}

}  // namespace platform::profiles
