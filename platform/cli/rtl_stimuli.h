#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace platform::cli {

/// A picture that is hard on the logic of the marker designs.
struct StimulusPicture {
  std::string name;
  std::vector<std::uint8_t> pixels;
};

/// Noise, few grey levels (so that scores, widths and counts are equal), dots, lines of one pixel,
/// as many blobs as fit, black and white.
std::vector<StimulusPicture> stimulus_pictures(int width, int height);

/// Writes each as a file of this size into `folder`, which exists, and returns the files. Throws
/// vp::OutputError.
std::vector<std::string> write_stimuli(const std::string& folder, int width, int height);

/// Inputs that a proof found: a value a clock for each pin of these names.
struct RecordedPins {
  std::vector<std::string> names;
  std::vector<std::vector<std::uint64_t>> rows;
};

/// Reads the names, and a line a clock of as many hexadecimal numbers. Throws vp::InputError with
/// the line.
RecordedPins read_recorded(const std::string& file);

}  // namespace platform::cli
