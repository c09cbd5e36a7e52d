// When images of a camera come.
#include <chip/run/camera_timing.h>

#include <boost/test/unit_test.hpp>
#include <memory>
#include <string>
#include <utility>

#include <vp/configuration.h>
#include <vp/error.h>

#include "simulation.h"

using platform::CameraTiming;

namespace {

struct Camera : kit::Simulation {
  explicit Camera(const std::string& rate) {
    if (!rate.empty()) configuration.set("camera.rate", rate);
    const vp::Configuration::Scope scope(configuration);
    timing = std::make_unique<CameraTiming>("camera");
  }
  vp::Configuration configuration;
  std::unique_ptr<CameraTiming> timing;
};

}  // namespace

BOOST_AUTO_TEST_SUITE(camera_timing)

BOOST_AUTO_TEST_CASE(images_do_not_drift) {
  const Camera camera("60 fps");
  BOOST_TEST(camera.timing->has_rate());
  BOOST_TEST(camera.timing->fps() == 60.0);
  BOOST_TEST(camera.timing->offset_ps(0) == 0u);
  BOOST_TEST(camera.timing->offset_ps(1) == 16'666'666'667u);
  BOOST_TEST(camera.timing->offset_ps(2) == 33'333'333'333u);
  BOOST_TEST(camera.timing->offset_ps(3) == 50'000'000'000u);
  BOOST_TEST(camera.timing->offset_ps(216'000) == 3'600'000'000'000'000u);
}

BOOST_AUTO_TEST_CASE(the_next_image_comes_at_or_after_a_time) {
  const Camera camera("60 fps");
  for (const auto& [ps, image] : {std::pair<std::uint64_t, std::uint64_t>{0, 0},
                                  {1, 1},
                                  {16'666'666'666, 1},
                                  {16'666'666'667, 1},
                                  {16'666'666'668, 2},
                                  {33'333'333'333, 2},
                                  {33'333'333'334, 3}})
    BOOST_TEST(camera.timing->first_after(ps) == image, ps << " ps");
}

BOOST_AUTO_TEST_CASE(rates_are_written_as_they_are_read) {
  for (const auto& [given, written] : {std::pair<const char*, const char*>{"60 fps", "60 fps"},
                                       {"60Hz", "60 fps"},
                                       {"0.1 fps", "0.1 fps"},
                                       {"29.97 fps", "29.97 fps"},
                                       {"1 kHz", "1000 fps"},
                                       {"none", "none"}}) {
    const Camera camera(given);
    BOOST_TEST(camera.timing->rate.text() == written);
    BOOST_TEST((Camera(written).timing->rate.micro_fps() == camera.timing->rate.micro_fps()));
  }
  BOOST_TEST(!Camera("").timing->has_rate());
  BOOST_TEST(!Camera("none").timing->rate.is_changed());
}

BOOST_AUTO_TEST_CASE(rates_that_no_camera_has) {
  for (const auto& [given, nearest] : {std::pair<const char*, const char*>{"0 fps", "0.1 fps"},
                                       {"-60 fps", "0.1 fps"},
                                       {"0.0999 fps", "0.1 fps"},
                                       {"1e9 fps", "100000 fps"},
                                       {"100001 fps", "100000 fps"},
                                       {"1e400 fps", "100000 fps"}}) {
    BOOST_CHECK_EXCEPTION(Camera{given}, vp::InputError, [&](const vp::InputError& error) {
      const std::string text = error.what();
      return text.find("camera.rate") == 0 &&
             text.find("the nearest is " + std::string(nearest)) != std::string::npos;
    });
  }
  for (const char* given : {"60", "nan fps", "inf fps", "fast", "60 ms"}) {
    BOOST_CHECK_EXCEPTION(Camera{given}, vp::InputError, [](const vp::InputError& error) {
      return std::string(error.what()).find("write 60 fps, or none") != std::string::npos;
    });
  }
}

BOOST_AUTO_TEST_SUITE_END()
