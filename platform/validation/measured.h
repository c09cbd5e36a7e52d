#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace platform::validation {

/// A mean and, over several values, its standard deviation.
struct Measurement {
  double value = 0;
  std::optional<double> spread = std::nullopt;
};

/// Of at least one value; the spread is the sample's (n - 1), none for a single value.
Measurement mean_of(const std::vector<double>& values);

/// The marker of the scene, as found.
struct FoundTrue {
  double width_px = 0;   ///< true width: mean of the upper and the lower side
  double corner_px = 0;  ///< errors
  std::optional<double> translation_mm = std::nullopt;
  std::optional<double> rotation_deg = std::nullopt;
  std::uint32_t iterations = 0;
};

/// A frame of result.json.
struct Frame {
  std::string input;  ///< "squares7"
  std::string group;  ///< "squares": the test it belongs to
  std::uint32_t threshold = 0;
  std::uint64_t corners = 0, blobs = 0, candidates = 0;
  std::optional<FoundTrue> found = std::nullopt;  ///< none: the scene's marker was not found
  std::string markers;                            ///< all that was found, as text to compare
  std::map<std::string, double> times_us;

  /// Time of a stage. Throws vp::InputError if the frame has no such stage.
  double ms(const std::string& stage) const;
};

/// A run of one system.
struct Run {
  std::string system, profile, fidelity, design;
  std::map<std::string, std::string> configuration;
  std::vector<Frame> frames;
  nlohmann::json root;  ///< all of result.json but the frames

  /// The frames of these tests, in order.
  std::vector<const Frame*> of(const std::vector<std::string>& groups) const;
};

/// Reads a result.json. Throws vp::InputError that names the file.
Run read_run(const std::filesystem::path& file);

/// Both systems on the same images.
struct Measured {
  Run hybrid, ps_only;
};

/// Throws vp::InputError if the two did not see the same images.
void check_same_inputs(const Measured& measured);

inline const std::vector<std::string> translation_tests{"x", "y", "z"};
inline const std::vector<std::string> rotation_tests{"pitch", "yaw", "roll"};
inline const std::vector<std::string> feature_test{"squares"};
/// The 56 images of 5.2.2 to 5.2.4.
inline const std::vector<std::string> marker_tests{"x",   "y",    "z",      "pitch",
                                                   "yaw", "roll", "squares"};
/// Everything that chapter 5 tests.
inline const std::vector<std::string> all_tests{"x",    "y",       "z",  "pitch", "yaw",
                                                "roll", "squares", "id", "front"};

}  // namespace platform::validation
