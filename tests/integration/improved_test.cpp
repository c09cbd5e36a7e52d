// The design `improved`, logic and software: the same at both fidelities, whatever it is shown, and
// honest about what it lost.
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <string>
#include <vector>

#include "improved_runs.h"

using namespace integration;
using namespace integration::improved_runs;

BOOST_AUTO_TEST_SUITE(improved)

BOOST_AUTO_TEST_CASE(both_fidelities_are_equal) {
  BOOST_TEST(difference(scenes) == "");
  BOOST_TEST(difference(with(scenes, "sw.overlap=0")) == "");
  BOOST_TEST(difference(with(scenes, "pl.threshold_rule=global")) == "");
  BOOST_TEST(difference(with(scenes, "pl.threshold_rule=local")) == "");
}

BOOST_AUTO_TEST_CASE(both_fidelities_are_equal_at_other_clocks_and_sizes) {
  BOOST_TEST(difference(with({"demo", "z1.0"}, "ps.fclk_clk0.frequency=31.25 MHz")) == "");
  BOOST_TEST(difference(with(with({"demo", "z1.0"}, "pl.width=1280 px"), "pl.height=720 px")) ==
             "");
  BOOST_TEST(difference(with({"demo", "z1.0"}, "pl.camera.frame_blanking=1000 cycles")) == "");
}

// Nothing, everything, noise, one blob of 640x480 px, and 540 blobs that are no markers.
BOOST_AUTO_TEST_CASE(both_fidelities_are_equal_on_pictures_of_nothing) {
  const kit::TemporaryFolder folder;
  std::uint32_t noise = 1;
  const Arguments files{
      picture_in(folder, "black", [](int, int) { return 0; }),
      picture_in(folder, "white", [](int, int) { return 255; }),
      picture_in(folder, "noise",
                 [&](int, int) {
                   noise = noise * 1'664'525 + 1'013'904'223;
                   return static_cast<int>(noise >> 24);
                 }),
      picture_in(folder, "chess", [](int x, int y) { return (x / 12 + y / 12) % 2 * 255; }),
      picture_in(folder, "squares",
                 [](int x, int y) { return x % 24 < 14 && y % 24 < 14 ? 0 : 255; })};
  BOOST_TEST(difference(files) == "");
  const Json result = run_of(files);
  BOOST_TEST(result["summary"]["detected"] == 0);
  BOOST_TEST(result["frames"][4]["counts"]["blobs"] == 27 * 20);
}

BOOST_AUTO_TEST_CASE(of_three_hundred_markers_those_without_room_are_told) {
  const kit::TemporaryFolder folder;
  // 20 columns and 15 rows of 24 px; the last 50 IDs are there twice.
  const Arguments files{picture_in(folder, "300", [](int x, int y) {
    return grey_of_marker(y / 32 * 20 + x / 32, x % 32 - 4, y % 32 - 4, 24);
  })};
  BOOST_TEST(difference(files) == "");
  const Json frame = run_of(files)["frames"][0];
  BOOST_TEST(frame["counts"]["blobs"] == 300);
  BOOST_TEST(frame["markers"].size() == 256u);
  BOOST_TEST(frame["counts"]["lost_markers"] == 44);
  BOOST_TEST(frame["warnings"].dump().find("44 markers without room") != std::string::npos);
  for (std::size_t i = 0; i < 256; ++i) BOOST_TEST(frame["markers"][i]["id"] == i % 250);
}

BOOST_AUTO_TEST_CASE(a_marker_is_found_up_to_the_border_and_not_beyond_it) {
  const kit::TemporaryFolder folder;
  // Nine that go beyond the border by a cell, or touch it, and one in the middle.
  const int places[][2] = {{-10, 200}, {590, 200}, {300, -10}, {300, 430}, {-10, -10},
                           {590, 430}, {0, 100},   {580, 100}, {100, 420}, {290, 210}};
  const Arguments files{picture_in(folder, "cut",
                                   [&](int x, int y) {
                                     for (int i = 0; i < 10; ++i) {
                                       const int u = x - places[i][0], v = y - places[i][1];
                                       if (u >= -10 && u < 70 && v >= -10 && v < 70)
                                         return grey_of_marker(i, u, v, 60);
                                     }
                                     return 220;
                                   }),
                        picture_in(folder, "full", [](int x, int y) {
                          return grey_of_marker(9, x - 86, y - 6, 468);
                        })};
  BOOST_TEST(difference(files) == "");
  const Json frames = run_of(files)["frames"];
  BOOST_TEST(frames.size() == files.size());
  for (const Json& frame : frames) {
    BOOST_REQUIRE(frame["markers"].size() == 1u);
    BOOST_TEST(frame["markers"][0]["id"] == 9);
  }
}

BOOST_AUTO_TEST_CASE(a_camera_that_is_too_fast_loses_whole_frames) {
  const Arguments fast{"z1.0", "--repeat", "10", "--rate", "1000 fps"};
  for (const Arguments& arguments : {fast, with(fast, "pl.camera.line_blanking=100 cycles")}) {
    BOOST_TEST(difference(arguments) == "");
    const Json result = run_of(arguments);
    const Json& camera = result["camera"];
    BOOST_TEST(camera["dropped"] > 5);
    BOOST_TEST(int(camera["offered"]) - int(camera["dropped"]) == result["summary"]["delivered"]);
    for (const Json& frame : result["frames"]) BOOST_TEST(frame["markers"].size() == 1u);
  }
}

// The lever that the report names makes frames come faster, and the lever of what it does not name
// leaves them as they are.
BOOST_AUTO_TEST_CASE(the_limit_has_the_lever_that_raises_the_rate) {
  struct Case {
    Arguments arguments;
    std::vector<std::string> stages;
    const char* lever;
    const char* other;
  };
  const Arguments many{"z2.0@markers=10", "--repeat", "12"};
  const Case cases[] = {
      {{"roll"}, {"capture"}, "pl.pixels_per_clock=2", "sw.second_core=1"},
      {many, {"detection", "pose"}, "sw.second_core=1", "pl.pixels_per_clock=2"},
      {with(many, "sw.second_core=1"), {"capture"}, "pl.pixels_per_clock=2", "sw.overlap=1"},
      {with({"z1.0", "--repeat", "12"}, "camera.rate=60 fps"),
       {},
       "camera.rate=none",
       "pl.pixels_per_clock=2"}};
  for (const Case& each : cases) {
    const Json result = run_of(each.arguments);
    const Json& limit = result["limit"];
    BOOST_TEST(limit["stages"] == Json(each.stages), limit);
    BOOST_TEST_REQUIRE(limit["levers"] == Json{each.lever}, limit);
    // Sustained: the first frame has nothing that overlaps with it.
    const auto rise = [&](const std::string& lever) {
      const Json pulled = run_of(with(each.arguments, lever))["limit"];
      return double(limit["period_us"]) / double(pulled["period_us"]);
    };
    BOOST_TEST(rise(limit["levers"][0]) > 1.04, limit);
    BOOST_TEST(rise(each.other) < 1.01, limit);
  }
}

BOOST_AUTO_TEST_CASE(what_takes_most_of_the_capture_is_its_lever) {
  const auto lever = [](const char* setting) {
    return run_of(with({"z1.0", "--repeat", "4"}, setting))["limit"];
  };
  const Json exposed = lever("pl.camera.exposure=8 ms");
  BOOST_TEST(exposed["stages"] == Json{"capture"});
  BOOST_TEST(exposed["levers"] == Json{"pl.camera.exposure=4000000000 ps"});
  BOOST_TEST(!exposed.contains("clock"), "the clock is not what takes the time");
  BOOST_TEST(lever("pl.camera.line_blanking=2000 cycles")["levers"] ==
             Json{"pl.camera.line_blanking=1000 cycles"});
  BOOST_TEST(lever("pl.camera.frame_blanking=900000 cycles")["levers"] ==
             Json{"pl.camera.frame_blanking=450000 cycles"});
  const Json fastest = lever("pl.pixels_per_clock=4");
  BOOST_TEST(fastest["levers"] == Json::array());
  BOOST_TEST(fastest["faster_with"] == "a higher ps.fclk_clk0.frequency");
}

// The DMA cannot keep up with bursts of two words: pictures end early, and the software says so.
BOOST_AUTO_TEST_CASE(a_picture_that_the_dma_cannot_take_is_cut_and_told) {
  const Arguments slow =
      with(with({"z1.0", "z2.0"}, "pl.burst_words=2"), "pl.pixel_stream.fifo_depth=2");
  BOOST_TEST(difference(slow, 1) == "");
  const Json result = run_of(slow, 1);
  for (const Json& frame : result["frames"]) {
    BOOST_TEST(frame["counts"]["cut_pictures"] == 1);
    BOOST_TEST(frame["markers"].empty());
    BOOST_TEST(frame["warnings"].dump().find("picture cut short") != std::string::npos);
  }
  BOOST_TEST(!result["summary"].contains("fps"), "no result was delivered");
}

BOOST_AUTO_TEST_CASE(too_few_labels_are_told) {
  const Json result = run_of(with({"squares15"}, "pl.blob_labelling.label_count=4"));
  BOOST_TEST(result["frames"][0]["counts"]["lost_in_logic"] > 0);
  BOOST_TEST(result["frames"][0]["warnings"].dump().find("label_count") != std::string::npos);
}

// Issue 17: 320 frames a second, a millisecond from the last pixel to the pose.
BOOST_AUTO_TEST_CASE(one_marker_is_found_as_fast_as_pixels_come) {
  // The first frame has none before it that hides its work.
  const Json result = run_of({"z1.0", "--repeat", "60"});
  BOOST_TEST(result["summary"]["detected"] == 60);
  BOOST_TEST(result["frames"].back()["counts"]["lost_in_logic"] == 0);
  const double fps = result["summary"]["fps"]["mean"], best = 100e6 / (640 * 480);
  BOOST_TEST(fps > 320);
  BOOST_TEST(fps < best, "one pixel a clock");
  for (const Json& frame : result["frames"]) {
    BOOST_TEST(latency_us(frame) < 1000);
    BOOST_TEST(frame["markers"][0]["reprojection_px"] < 0.01);
    BOOST_TEST(frame["markers"][0]["corrected"] == 0);
  }
  BOOST_TEST(result["timing"]["met"] == true);
}

BOOST_AUTO_TEST_CASE(settings_of_a_design_are_defaults) {
  const Json usual = run_of({"demo"}, 0, "eco");
  BOOST_TEST(usual["configuration"]["power.ddr.width"] == "16");
  BOOST_TEST(usual["configuration"]["ps.cpu_clk.frequency"] == "333.333333 MHz");
  const Json own = run_of(with({"demo"}, "power.ddr.width=32"), 0, "eco");
  BOOST_TEST(own["configuration"]["power.ddr.width"] == "32");
  BOOST_TEST(own["configuration"]["ps.cpu_clk.frequency"] == "333.333333 MHz");
  BOOST_TEST(run_of({"demo"})["configuration"]["power.ddr.width"] == "32");
}

BOOST_AUTO_TEST_CASE(hd_is_the_same_in_another_size) {
  Json hd = run_of({"demo"}, 0, "hd"),
       larger = run_of({"demo", "--set", "pl.width=1280 px", "--set", "pl.height=720 px", "--set",
                        "ps.fclk_clk0.frequency=111.111111 MHz"});
  for (const char* key : {"configuration", "design", "provenance"}) {
    hd.erase(key);
    larger.erase(key);
  }
  BOOST_TEST(hd == larger);
  BOOST_TEST(hd["summary"]["detected"] == 1);
}

BOOST_AUTO_TEST_CASE(a_frame_overlaps_the_work_on_the_last) {
  const Json overlap = run_of({"squares15", "--repeat", "10"});
  const Json serial = run_of({"squares15", "--repeat", "10", "--set", "sw.overlap=0"});
  const double work_us = mean_us(serial, "detection") + mean_us(serial, "pose");
  // All that is left of the software's work is what does not fit into the next frame.
  const double hidden_us = period_us(serial) - period_us(overlap);
  BOOST_TEST(hidden_us > 0.8 * std::min(work_us, 3072.0));
  for (std::size_t i = 0; i < 10; ++i)
    BOOST_TEST(overlap["frames"][i]["markers"] == serial["frames"][i]["markers"]);
}

// The same packets, whether the program tells the engine of each or leaves it a ring of
// descriptors.
BOOST_AUTO_TEST_CASE(packets_through_a_ring_of_descriptors) {
  const Arguments plain{"demo", "squares15", "z2.0@markers=10", "--repeat", "20"};
  const Arguments ring = with(plain, "pl.axi_dma_1.include_sg=true");
  const Json direct = run_of(plain), through = run_of(ring);
  BOOST_TEST(through["frames"].size() == 60u);
  for (std::size_t i = 0; i < 60; ++i) {
    for (const char* key : {"markers", "counts", "warnings"})
      BOOST_TEST(direct["frames"][i].value(key, Json()) == through["frames"][i].value(key, Json()));
  }
  const Arguments few = with({"demo", "squares15"}, "pl.axi_dma_1.include_sg=true");
  BOOST_TEST(difference(few) == "");
  BOOST_TEST(difference(with(few, "ps.fclk_clk0.frequency=25 MHz")) == "");
}

// More than 5000 features of one frame, 4 px each, and the next frame is under way meanwhile.
BOOST_AUTO_TEST_CASE(five_thousand_features_of_a_frame_pass_whole) {
  const kit::TemporaryFolder folder;
  const Arguments dots =
      with({picture_in(folder, "dots",
                       [](int x, int y) { return x % 10 < 4 && y % 6 < 4 && x < 636 ? 20 : 220; }),
            "--repeat", "3"},
           "pl.blob_labelling.minimum_side=1 px");
  for (const char* sg : {"false", "true"}) {
    const Arguments built = with(dots, std::string("pl.axi_dma_1.include_sg=") + sg);
    const Json result = run_of(built);
    BOOST_REQUIRE(result["frames"].size() == 3u);
    for (const Json& frame : result["frames"]) {
      BOOST_TEST(frame["counts"]["blobs"] == 64 * 80);
      BOOST_TEST(frame["counts"]["lost_in_logic"] == 0);
      BOOST_TEST(!frame.contains("warnings"));
    }
    BOOST_TEST(difference(built) == "");
  }
}

BOOST_AUTO_TEST_SUITE_END()
