#pragma once

#include <string>
#include <utility>
#include <vector>

#include <facts/result.h>
#include <marker/input/frame_source.h>
#include <marker/report/marker_frame.h>

namespace integration {

/// A run of the whole platform in this process.
struct PlatformRun {
  platform::facts::RunFacts facts;
  /// With input, truth and camera filled in.
  std::vector<platform::facts::UnitReport> frames;
};

/// Parameters by path: {"ps.fclk_clk1.frequency", "40 MHz"}.
using Settings = std::vector<std::pair<std::string, std::string>>;

/// The program that runs on the PS.
enum class System { hybrid, ps_only };

/// Runs scenes or groups of scenes, in the resolution that the settings ask for, one after the
/// other.
PlatformRun run_scenes(const std::vector<std::string>& scenes, const Settings& settings = {},
                       System system = System::hybrid);

/// Runs the same for images of the test's own.
PlatformRun run_images(const std::vector<platform::GreyImage>& images,
                       const Settings& settings = {}, System system = System::hybrid);

/// Duration of one stage of a frame, us. Throws std::out_of_range if the frame has none of that
/// name.
double stage_us(const platform::facts::UnitReport& frame, const std::string& stage);

/// The overflow counters together.
std::uint64_t overflows(const platform::facts::UnitReport& frame);

/// What was found, in words that compare: "corner x y strength direction", "blob sx sy ex ey".
std::vector<std::string> features(const platform::facts::UnitReport& frame);

}  // namespace integration
