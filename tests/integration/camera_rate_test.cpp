// A camera of a fixed rate: what is taken, what is dropped, and what the wait costs.
#include <boost/test/unit_test.hpp>

#include <cstdint>
#include <string>
#include <vector>

#include "executable.h"
#include "platform_run.h"

using namespace integration;

namespace {

const auto near = boost::test_tools::tolerance(1e-9);

/// The demo scene so often, at the rate.
PlatformRun run_at(const std::string& rate, int images, System system = System::hybrid,
                   Settings settings = {}) {
  settings.emplace_back("camera.rate", rate);
  return run_scenes(std::vector<std::string>(static_cast<std::size_t>(images), "demo"), settings,
                    system);
}

Json result_at(const std::string& rate, const Arguments& more = {}) {
  const Workplace place;
  Arguments arguments{"demo", "--repeat", "3", "-q", "--no-pictures", "--rate", rate};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const kit::Outcome outcome = place.run(arguments);
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  return place.result();
}

}  // namespace

BOOST_AUTO_TEST_SUITE(camera_rate)

// Whatever the model of the logic: image n comes round(n / 60 s) after the first.
BOOST_AUTO_TEST_CASE(each_image_is_taken_when_it_comes) {
  for (const char* fidelity : {"tlm", "clocked"}) {
    const PlatformRun run = run_at("60 fps", 3, System::hybrid, {{"fidelity", fidelity}});
    BOOST_TEST_REQUIRE(run.frames.size() == 3u);
    const std::uint64_t first = run.frames[0].camera_period->from_ps;
    const std::uint64_t start = run.frames[0].start_ps - first;
    BOOST_TEST(start < 5'000'000u);  // of reset and control words, 5 us
    const std::uint64_t came[] = {0, 16'666'666'667, 33'333'333'333, 50'000'000'000};
    for (std::size_t i = 0; i < 3; ++i) {
      BOOST_TEST(run.frames[i].index == i);
      BOOST_TEST(run.frames[i].camera_period->from_ps - first == came[i]);
      BOOST_TEST(run.frames[i].camera_period->to_ps - first == came[i + 1]);
      BOOST_TEST(run.frames[i].upload_ps < 1'000'000u);  // none: two looks at the timer
    }
    BOOST_TEST(run.facts.camera->offered == 3u);
    BOOST_TEST(run.facts.camera->dropped == 0u);
    BOOST_TEST(run.facts.end->ps - first >= came[3]);
    BOOST_TEST(run.facts.end->ps - first < came[3] + 1'000'000);
  }
}

// 10.9 ms of work, an image every 8.3 ms: each second one is lost, whole.
BOOST_AUTO_TEST_CASE(an_image_that_comes_while_the_program_is_busy_is_dropped) {
  for (const char* fidelity : {"tlm", "clocked"}) {
    const PlatformRun run = run_at("120 fps", 4, System::hybrid, {{"fidelity", fidelity}});
    BOOST_TEST_REQUIRE(run.frames.size() == 2u);
    const std::uint64_t first = run.frames[0].camera_period->from_ps;
    BOOST_TEST(run.frames[0].index == 0u);
    BOOST_TEST(run.frames[1].index == 2u);
    BOOST_TEST(run.frames[1].camera_period->from_ps - first == 16'666'666'667u);
    BOOST_TEST(run.frames[1].camera_period->to_ps - first == 33'333'333'333u);
    for (const auto& frame : run.frames)
      BOOST_TEST(platform::marker_frame(frame).markers.size() == 1u);
    BOOST_TEST(run.facts.camera->offered == 4u);
    BOOST_TEST(run.facts.camera->dropped == 2u);
    BOOST_TEST(run.facts.camera->utilisation_percent() > 100);
  }
}

// 92 ms of work: the camera continues while the program is busy with the last image.
BOOST_AUTO_TEST_CASE(software_alone_takes_one_of_six) {
  const PlatformRun run = run_at("60 fps", 1, System::ps_only);
  BOOST_TEST_REQUIRE(run.frames.size() == 1u);
  const auto& camera = *run.facts.camera;
  BOOST_TEST(camera.offered == camera.dropped + 1);
  BOOST_TEST(camera.dropped == 5u);
  const auto& period = *run.frames[0].camera_period;
  BOOST_TEST(period.to_ps - period.from_ps == 100'000'000'000u);
}

BOOST_AUTO_TEST_CASE(rate_energy_and_power_are_those_of_whole_periods) {
  const Json result = result_at("60");
  const Json &summary = result["summary"], &camera = result["camera"];
  BOOST_TEST(camera["rate_fps"] == 60.0);
  BOOST_TEST(camera["delivered_fps"] == 60.0);
  BOOST_TEST(summary["fps"]["mean"] == 60.0);
  BOOST_TEST(camera["slack_us"]["mean"].get<double>() ==
                 1e6 / 60 * (1 - camera["utilisation_percent"].get<double>() / 100),
             boost::test_tools::tolerance(1e-3));
  BOOST_TEST(camera["slack_us"]["min"].get<double>() <= camera["slack_us"]["mean"].get<double>());
  BOOST_TEST(result["verdict"]["job"]["holds"] == "yes");
  BOOST_TEST(result["power"]["mode"] == "activity");
  const double per_frame = summary["energy_per_frame_mj"];
  BOOST_TEST(per_frame * 60 / 1e3 == summary["power_w"]["total"].get<double>(), near);
  double sum = 0;
  for (const Json& frame : result["frames"]) sum += frame["energy_mj"]["total"].get<double>();
  BOOST_TEST(sum == 3 * per_frame, near);
}

// The chip rests between images: half as many take less power, and more energy each.
BOOST_AUTO_TEST_CASE(the_wait_costs_what_a_sleeping_core_takes) {
  const Json slow = result_at("30 fps")["summary"], fast = result_at("60 fps")["summary"];
  const double slow_mj = slow["energy_per_frame_mj"], fast_mj = fast["energy_per_frame_mj"];
  BOOST_TEST(slow["power_w"]["total"].get<double>() < fast["power_w"]["total"].get<double>());
  BOOST_TEST(slow_mj > fast_mj);
  // 16.7 ms of wait, at less than a frame takes.
  BOOST_TEST(slow_mj < 2 * fast_mj);
}

BOOST_AUTO_TEST_CASE(a_rate_that_is_too_high_fails_the_job) {
  const Workplace place;
  const kit::Outcome outcome = place.run({"demo", "-q", "--no-pictures", "--rate", "120", "fps"});
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  const Json result = place.result();
  BOOST_TEST(result["camera"]["offered"] == 2);
  BOOST_TEST(result["verdict"]["feasible"] == "no");
  BOOST_TEST(result["verdict"]["job"]["why"] == "1 of 2 frames of the camera dropped");
  BOOST_TEST(result["verdict"]["job"]["margin_percent"] == -50.0);
  BOOST_TEST(
      outcome.out.find("camera   120 fps: 1 of 2 frames dropped   busy 13") != std::string::npos,
      outcome.out);
}

BOOST_AUTO_TEST_CASE(without_a_rate_nothing_is_said_of_a_camera) {
  const Workplace place;
  BOOST_TEST(place.run({"demo", "-q", "--no-pictures"}).exit_code == 0);
  const Json result = place.result();
  BOOST_TEST(!result.contains("camera"));
  BOOST_TEST(!result["summary"].contains("unpublished"));
  BOOST_TEST(result["power"]["mode"] == "vivado-default");
  BOOST_TEST(result["configuration"]["camera.rate"] == "none");
}

BOOST_AUTO_TEST_SUITE_END()
