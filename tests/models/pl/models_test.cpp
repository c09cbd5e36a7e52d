// Which model of an IP is built, and what is refused.
#include <pl/common/frame_channel.h>
#include <pl/corner_detection/corner_detection.h>
#include <vp/error.h>

#include <boost/test/unit_test.hpp>
#include <functional>
#include <stdexcept>

#include "pipeline.h"

namespace {

/// What a design from outside brings: here the same model by another name.
void add_foreign_model() {
  static const bool once = [] {
    pl::CornerDetection::models().add(pl::model<pl::CornerDetection, pl::CornerDetectionClocked>(
        "foreign", pl::by_pixel, pl::no_image));
    return true;
  }();
  static_cast<void>(once);
}

/// A filter that exists clock by clock only.
class Wire final : public pl::PixelFilter {
 public:
  Wire(sc_core::sc_module_name name, const pl::Site& site) : PixelFilter(name, site) {}

 private:
  void edge() override {
    frame_ena = ena;
    pixel_out = pixel;
    pixel_x = x;
    pixel_y = y;
  }
  vp::IpEstimate own_estimate() const override { return {}; }
};
const pl::Models<pl::PixelFilter> wire{
    "wire", {pl::model<pl::PixelFilter, Wire>("clocked", pl::by_pixel, pl::by_pixel)}};

struct Logic : kit::Simulation {
  Logic(pl::Fidelity fidelity, const std::vector<std::string>& assignments,
        const pl::Models<pl::PixelFilter>* filter = nullptr)
      : settings(assignments), pl("pl", system_clk, pixel_clk, fidelity, filter) {}

  harness::Settings settings;
  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock system_clk{"system_clk", scheduler, 100'000'000};
  vp::Clock pixel_clk{"pixel_clk", scheduler, 50'000'000};
  pl::FeatureExtraction pl;
};

std::string refusal(const std::function<void()>& build) {
  try {
    build();
  } catch (const vp::InputError& error) {
    return error.what();
  }
  return "nothing was refused";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(models)

BOOST_AUTO_TEST_CASE(a_model_from_outside_is_chosen_by_name_and_gives_the_same_words) {
  add_foreign_model();
  std::vector<std::string> settings = harness::frame_size(64, 32);
  std::vector<harness::Word> expected, found;
  {
    harness::Pipeline pipeline({}, settings);
    pipeline.load(harness::noise(64, 32, 7));
    expected = pipeline.run_frame();
  }
  settings.push_back("pl.fidelity.corner_detection=foreign");
  harness::Pipeline pipeline({}, settings);
  pipeline.load(harness::noise(64, 32, 7));
  found = pipeline.run_frame();
  BOOST_TEST(harness::first_difference(found, expected) == "");
  BOOST_TEST(harness::count(found, 'C') > 0u);
}

BOOST_AUTO_TEST_CASE(what_feeds_a_model_from_outside_goes_with_it) {
  add_foreign_model();
  Logic logic(pl::Fidelity::tlm, {"pl.fidelity.corner_detection=foreign"});
  BOOST_TEST(logic.pl.fidelity.sensor_input.gives().pixels);
  BOOST_TEST(!logic.pl.fidelity.global_threshold.gives().pixels);
}

BOOST_AUTO_TEST_CASE(a_name_is_taken_once) {
  add_foreign_model();
  const auto again =
      pl::model<pl::CornerDetection, pl::CornerDetectionTlm>("foreign", pl::by_frame, pl::no_image);
  BOOST_CHECK_THROW(pl::CornerDetection::models().add(again), std::logic_error);
}

BOOST_AUTO_TEST_CASE(a_name_that_no_model_has_is_refused_with_those_there_are) {
  const std::string why =
      refusal([] { Logic(pl::Fidelity::tlm, {"pl.fidelity.blob_detection=clock"}); });
  BOOST_TEST(contains(why, "pl.fidelity.blob_detection"));
  BOOST_TEST(contains(why, "clocked or tlm"));
}

BOOST_AUTO_TEST_CASE(models_that_do_not_go_together_are_refused_with_their_names) {
  BOOST_TEST(refusal([] { Logic(pl::Fidelity::tlm, {"pl.fidelity.global_threshold=clocked"}); }) ==
             "pl.fidelity.global_threshold = clocked does not go with "
             "pl.fidelity.blob_detection = tlm: one gives pixels one by one, the other takes "
             "whole frames; choose pl.fidelity.blob_detection=clocked");
  const std::string why = refusal([] { Logic(pl::Fidelity::tlm, {}, &wire); });
  BOOST_TEST(contains(why,
                      "pl.fidelity.wire = clocked does not go with "
                      "pl.fidelity.corner_detection = tlm"));
}

BOOST_AUTO_TEST_CASE(a_filter_that_wants_pixels_makes_the_sensor_give_them) {
  const Logic logic(pl::Fidelity::tlm,
                    {"pl.fidelity.corner_detection=clocked", "pl.fidelity.blob_detection=clocked"},
                    &wire);
  BOOST_TEST(logic.pl.fidelity.sensor_input.gives().pixels);
}

BOOST_AUTO_TEST_CASE(frames_of_nobody_are_refused_with_the_name_of_the_port) {
  const std::string why = refusal([] {
    kit::Simulation simulation;
    vp::ClockScheduler scheduler{"scheduler"};
    vp::Clock clk{"clk", scheduler, 50'000'000};
    vp::Signal<bool> low{"low"};
    vp::Signal<std::uint8_t> pixel{"pixel"};
    vp::Signal<std::uint16_t> place{"place"};
    pl::CornerDetectionTlm ip{"corner_detection", {clk, {}}};
    ip.ena(low);
    ip.rst(low);
    ip.pixel(pixel);
    ip.x(place);
    ip.y(place);
    sc_core::sc_start(sc_core::SC_ZERO_TIME);
  });
  BOOST_TEST(contains(why, "port 'corner_detection.frames' is connected to nothing"));
}

BOOST_AUTO_TEST_CASE(an_enable_without_a_frame_is_told_with_the_name_of_the_channel) {
  kit::Simulation simulation;
  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clk{"clk", scheduler, 50'000'000};
  const pl::FrameChannel<std::uint8_t> channel{"channel", clk};
  BOOST_CHECK_EXCEPTION(channel.data(), vp::ProtocolError, [](const vp::ProtocolError& error) {
    return std::string(error.what()).find("channel: pixels are enabled, but no frame") == 0;
  });
}

BOOST_AUTO_TEST_SUITE_END()
