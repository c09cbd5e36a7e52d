#pragma once

#include <string>
#include <vector>

#include "frames.h"

namespace harness {

/// A frame of the golden sequence: 640 x 480 pixels.
struct GoldenFrame {
  std::string name;
  bool complete;  ///< all words are kept; else their fingerprint
  Image image;
};

/// The frames in the order in which reference and models get them, without a system reset between:
/// the threshold of each but the first comes from the one before.
std::vector<GoldenFrame> golden_sequence();

}  // namespace harness
