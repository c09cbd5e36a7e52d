// SLCR, UART and private timer in the whole platform, through their drivers.
#include <chip/run/simulation.h>
#include <marker/input/image_input.h>
#include <vp/configuration.h>
#include <boost/test/unit_test.hpp>
#include <string>
#include <vector>

#include "platform_run.h"
#include "simulation.h"

using platform::Simulation;
using platform::facts::UnitReport;

namespace {

/// Pixel clocks from a frame's start to its end word.
constexpr double end_word_clocks = 640 * 480 + 17;

struct DeviceRun {
  explicit DeviceRun(const std::vector<std::string>& scenes) {
    const kit::Simulation context;
    vp::Configuration configuration;
    const vp::Configuration::Scope scope(configuration);
    Simulation simulation({MARKERVP_PS_DEVICES});
    platform::Zynq& zynq = simulation.zynq();
    zynq.ps.uart1.console.connect([this](const std::string& line) { lines.push_back(line); });

    platform::input::InputOptions options;
    options.size = platform::input::image_size(simulation.input());
    auto source = platform::input::open_inputs(scenes, options);
    simulation.run([&] { return source->next(); },
                   [&](UnitReport&& report) {
                     frames.push_back(std::move(report));
                     pixel_clocks.push_back(zynq.ps.fclk_clk1.clk.frequency_hz());
                     return true;
                   });
    warnings = simulation.reports().count(sc_core::SC_WARNING);
  }
  std::vector<UnitReport> frames;
  std::vector<std::uint64_t> pixel_clocks;  ///< when each frame's report came
  std::vector<std::string> lines;
  std::uint64_t warnings = 0;
};

const DeviceRun& five_frames() {
  static const DeviceRun run({"roll30", "roll30", "roll30", "roll30", "roll30"});
  return run;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(ps_devices)

BOOST_AUTO_TEST_CASE(software_sets_the_pixel_clock_and_the_frame_takes_as_long) {
  const DeviceRun& run = five_frames();
  BOOST_TEST_REQUIRE(run.frames.size() == 5u);
  const double mhz[] = {50, 25, 100, 50};
  for (std::size_t i = 0; i < 4; ++i) {
    BOOST_TEST(run.pixel_clocks[i] == static_cast<std::uint64_t>(mhz[i] * 1e6));
    const double expected_us = end_word_clocks / mhz[i];
    const double time_us = integration::stage_us(run.frames[i], "feature_extraction");
    BOOST_TEST(time_us > expected_us);
    BOOST_TEST(time_us < expected_us + 2);  // a few reads of the feature register
    BOOST_TEST(run.frames[i].warnings.empty());
    BOOST_TEST(integration::overflows(run.frames[i]) == 0u);
    BOOST_TEST(run.frames[i].counts["feature_words"] == run.frames[0].counts["feature_words"]);
  }
}

BOOST_AUTO_TEST_CASE(it_may_change_in_the_midst_of_a_frame) {
  const UnitReport& frame = five_frames().frames.at(4);
  // 50 MHz before, 100 MHz after: the first microseconds only.
  const double whole_us = end_word_clocks / 100;
  const double time_us = integration::stage_us(frame, "feature_extraction");
  BOOST_TEST(time_us > whole_us);
  BOOST_TEST(time_us < whole_us + 5);
  BOOST_TEST(frame.counts["feature_words"] == five_frames().frames[0].counts["feature_words"]);
}

// Power of the feature extraction over that of the PS, which stays: as the pixel clock.
BOOST_AUTO_TEST_CASE(energy_follows_the_clock_that_software_sets) {
  const DeviceRun& run = five_frames();
  const auto share = [&](std::size_t frame) {
    double ps = 0, features = 0;
    for (const auto& part : run.frames.at(frame).energy) {
      if (part.group == "ps") ps = part.mj;
      if (part.group == "feature_extraction") features = part.mj;
    }
    return features / ps;
  };
  const auto within = boost::test_tools::tolerance(0.001);
  BOOST_TEST(share(1) == share(0) / 2, within);
  BOOST_TEST(share(2) == share(0) * 2, within);
  BOOST_TEST(share(3) == share(0), within);
  // In the midst of it from 50 to 100 MHz: 4.8 ms of upload, which this program does not tell of,
  // before, 3.07 ms of the frame behind.
  BOOST_TEST(share(4) > 1.35 * share(0));
  BOOST_TEST(share(4) < 1.45 * share(0));
}

BOOST_AUTO_TEST_CASE(the_uart_sends_at_its_baud_rate) {
  const DeviceRun& run = five_frames();
  const std::vector<std::string> expected{"frame 0", "frame 1", "frame 2", "frame 3", "frame 4"};
  BOOST_TEST(run.lines == expected, boost::test_tools::per_element());
  // 8 characters of 10 bits at 115 207 baud, seen with one poll's delay.
  for (const UnitReport& frame : run.frames) {
    const double time_us = integration::stage_us(frame, "upload");
    BOOST_TEST(time_us > 694.4);
    BOOST_TEST(time_us < 695.4);
  }
  BOOST_TEST(run.warnings == 0u);
}

BOOST_AUTO_TEST_SUITE_END()
