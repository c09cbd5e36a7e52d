// Any image: files of many formats, folders, videos, other sizes, with and without a marker.
#include <cmath>

#include <boost/test/unit_test.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "executable.h"
#include "pictures.h"

using namespace integration;

namespace {

using Names = std::vector<std::string>;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// The frames of a run that must go well.
Json frames_of(const Workplace& place, const Arguments& arguments) {
  Arguments all{"--quiet", "--no-pictures"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  const kit::Outcome outcome = place.run(all);
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  return place.result()["frames"];
}

/// Counts and markers, without what only scenes have.
Json finds(Json frame) {
  for (Json& marker : frame["markers"]) {
    marker.erase("truth");
    marker.erase("error");
  }
  return {frame["counts"], frame["markers"]};
}

void check_marker(const Json& frame, int id) {
  BOOST_TEST_CONTEXT(frame["input"].get<std::string>()) {
    BOOST_TEST_REQUIRE(frame["markers"].size() == 1u);
    BOOST_TEST(frame["markers"][0]["id"] == id);
  }
}

Names inputs_of(const Json& frames) {
  Names names;
  for (const Json& frame : frames) names.push_back(frame["input"]);
  return names;
}

cv::Mat sixteen_bits(const cv::Mat& picture) {
  cv::Mat wide;
  picture.convertTo(wide, CV_16U, 257);
  return wide;
}

void write_video(const std::string& path, const std::vector<cv::Mat>& pictures) {
  cv::VideoWriter writer(path, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 25, pictures[0].size());
  BOOST_TEST_REQUIRE(writer.isOpened());
  for (const cv::Mat& picture : pictures) writer.write(picture);
}

cv::Mat coloured(const cv::Mat& grey) {
  cv::Mat colour;
  cv::cvtColor(grey, colour, cv::COLOR_GRAY2BGR);
  return colour;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(other_images)

BOOST_AUTO_TEST_CASE(no_marker_is_a_result) {
  const Workplace place;
  write_picture(place / "wall.png", empty_wall());
  const Json frames = frames_of(place, {"wall.png"});
  BOOST_TEST_REQUIRE(frames.size() == 1u);
  BOOST_TEST(frames[0]["markers"].empty());
  BOOST_TEST(!frames[0].contains("warnings"));
  BOOST_TEST(place.result()["summary"]["detected"] == 0);
}

BOOST_AUTO_TEST_CASE(a_required_marker_that_is_missing_is_exit_code_1) {
  const Workplace place;
  write_picture(place / "wall.png", empty_wall());
  const kit::Outcome outcome = place.run({"demo", "wall.png", "--require-marker"});
  BOOST_TEST(outcome.exit_code == 1);
  BOOST_TEST(contains(outcome.err, "markervp: no marker in 1 of 2 frames, first in wall.png\n"),
             outcome.err);
  BOOST_TEST(place.entries() == (Names{"out", "wall.png"}), boost::test_tools::per_element());
  BOOST_TEST(place.result()["frames"].size() == 2u);
  BOOST_TEST(Workplace().run({"demo", "--require-marker"}).exit_code == 0);
}

BOOST_AUTO_TEST_CASE(formats_of_the_same_picture_have_the_same_result) {
  const Workplace place;
  const cv::Mat grey = scene_picture("yaw30");
  cv::Mat with_alpha;
  cv::cvtColor(grey, with_alpha, cv::COLOR_GRAY2BGRA);
  write_picture(place / "grey.png", grey);
  write_picture(place / "colour.png", coloured(grey));
  write_picture(place / "alpha.png", with_alpha);
  write_picture(place / "deep.png", sixteen_bits(grey));
  write_picture(place / "plain.pgm", grey);
  write_picture(place / "plain.bmp", grey);
  write_picture(place / "plain.tiff", grey);
  const Json scene = frames_of(place, {"yaw30"})[0];
  check_marker(scene, 0);
  for (const char* file : {"grey.png", "colour.png", "alpha.png", "deep.png", "plain.pgm",
                           "plain.bmp", "plain.tiff"}) {
    const Json frame = frames_of(place, {file})[0];
    BOOST_TEST(frame["input"] == file);
    BOOST_TEST(finds(frame) == finds(scene), file);
    // A still image is shown twice, so its stages begin at another phase of the 100 MHz clock.
    const Json &times = frame["time_us"], &others = scene["time_us"];
    BOOST_TEST(times.size() == others.size(), file);
    for (const auto& [stage, time] : times.items()) {
      BOOST_TEST_CONTEXT(file << ": " << stage) {
        BOOST_TEST(std::abs(time.get<double>() - others.at(stage).get<double>()) <= 0.01);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(photographs_have_the_right_marker) {
  const Workplace place;
  for (const char* scene : {"z1.0", "yaw30", "id99", "roll90"}) {
    const cv::Mat picture = photograph(scene);
    const std::string name = scene;
    write_picture(place / (name + ".png"), picture);
    write_picture(place / (name + ".jpg"), picture);
    write_picture(place / (name + "_16.png"), sixteen_bits(picture));
    for (const Json& frame :
         frames_of(place, {"./" + name + ".png", name + ".jpg", name + "_16.png"})) {
      check_marker(frame, name == "id99" ? 99 : 0);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_folder_is_its_images_in_natural_order) {
  const Workplace place;
  std::filesystem::create_directories(place / "shots/more");
  write_picture(place / "shots/shot10.png", scene_picture("id7"));
  write_picture(place / "shots/shot9.jpg", scene_picture("id99"));
  write_picture(place / "shots/shot100.png", scene_picture("id36"));
  write_picture(place / "shots/more/shot1.png", scene_picture("id15"));
  kit::write_file(place / "shots/notes.txt", "no image");
  const Json frames = frames_of(place, {"shots"});
  BOOST_TEST(inputs_of(frames) == (Names{"shot9.jpg", "shot10.png", "shot100.png"}),
             boost::test_tools::per_element());
  check_marker(frames[0], 99);
  check_marker(frames[1], 7);
  check_marker(frames[2], 36);
}

BOOST_AUTO_TEST_CASE(a_video_is_its_pictures) {
  const Workplace place;
  write_video(place / "clip.avi", {coloured(scene_picture("id99")), photograph("z1.0"),
                                   coloured(scene_picture("id7"))});
  const Json frames = frames_of(place, {"clip.avi", "id36"});
  BOOST_TEST(inputs_of(frames) == (Names{"clip.avi#0", "clip.avi#1", "clip.avi#2", "id36"}),
             boost::test_tools::per_element());
  check_marker(frames[0], 99);
  check_marker(frames[1], 0);
  check_marker(frames[2], 7);
  check_marker(frames[3], 36);
}

/// What can be read is a result; the user learns that it is not all.
BOOST_AUTO_TEST_CASE(a_video_that_breaks_off_runs_as_far_as_it_goes) {
  const Workplace place;
  write_video(place / "whole.avi", std::vector<cv::Mat>(6, coloured(scene_picture("id99"))));
  const std::size_t size = kit::read_file(place / "whole.avi").size();
  kit::write_part(place / "whole.avi", place / "part.avi", size / 2);
  const kit::Outcome outcome = place.run({"part.avi", "--no-pictures"});
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  BOOST_TEST(contains(outcome.err, "part.avi"), outcome.err);
  const Json frames = place.result()["frames"];
  BOOST_TEST(frames.size() >= 1u);
  BOOST_TEST(frames.size() < 6u);
  for (const Json& frame : frames) check_marker(frame, 99);
}

BOOST_AUTO_TEST_CASE(crop_takes_the_middle) {
  const Workplace place;
  cv::Mat large(600, 800, CV_8UC1, cv::Scalar(178));
  scene_picture("yaw30").copyTo(large(cv::Rect(80, 60, 640, 480)));
  write_picture(place / "large.png", large);
  const Json cropped = frames_of(place, {"large.png", "--fit", "crop"})[0];
  const Json scene = frames_of(place, {"yaw30"})[0];
  BOOST_TEST(cropped["counts"] == scene["counts"]);
  BOOST_TEST(cropped["markers"][0]["corners_px"] == scene["markers"][0]["corners_px"]);
  // The thesis' camera with 800 pixels over the same view has a focal length 800/640 times as long.
  const double far = cropped["markers"][0]["pose"]["translation_m"][2];
  const double near = scene["markers"][0]["pose"]["translation_m"][2];
  BOOST_TEST(far > 1.1 * near);
}

BOOST_AUTO_TEST_CASE(scale_keeps_the_view) {
  const Workplace place;
  write_picture(place / "double.png", scene_picture("yaw30", 1280, 960));
  write_picture(place / "half.png", scene_picture("z1.0", 320, 240));
  const Json frames = frames_of(place, {"double.png", "half.png", "--fit", "scale"});
  const Json scenes = frames_of(place, {"yaw30", "z1.0"});
  for (std::size_t i = 0; i < 2; ++i) {
    check_marker(frames[i], 0);
    const Json& found = frames[i]["markers"][0]["corners_px"];
    const Json& expected = scenes[i]["markers"][0]["truth"]["corners_px"];
    for (std::size_t corner = 0; corner < 4; ++corner) {
      for (std::size_t axis = 0; axis < 2; ++axis) {
        const double distance =
            found[corner][axis].get<double>() - expected[corner][axis].get<double>();
        BOOST_TEST(std::abs(distance) < 3);
      }
    }
  }
}

/// A picture and the same in a fifth of its light, which the threshold of the first one makes dark.
struct Light : Workplace {
  Light() {
    const cv::Mat bright = scene_picture("z1.0");
    write_picture(*this / "bright.png", bright);
    write_picture(*this / "dim.png", bright * 0.2);
  }
};

BOOST_AUTO_TEST_CASE(still_images_have_a_threshold_of_their_own) {
  const Light place;
  for (const auto& [design, showings] : {std::pair("improved", 2), std::pair("thesis", 1)}) {
    // The thesis' peaks lie on both sides of 127, so its threshold is never below 64.
    const bool finds = design == std::string("improved");
    const Json alone = frames_of(place, {"dim.png", "--design", design})[0];
    if (finds) check_marker(alone, 0);
    BOOST_TEST(alone["settling_showings"] == showings);
    const Json frames = frames_of(place, {"bright.png", "dim.png", "dim.png", "--design", design});
    BOOST_TEST_REQUIRE(frames.size() == 3u);
    for (std::size_t i = 0; i < 3; ++i) BOOST_TEST(frames[i]["index"] == i);
    if (finds) check_marker(frames[1], 0);
    BOOST_TEST(frames[1]["threshold"] == alone["threshold"]);
    BOOST_TEST(frames[1]["settling_showings"] == showings);
    BOOST_TEST(!frames[2].contains("settling_showings"), "it is the picture before it");
    BOOST_TEST(frames[2]["threshold"] == alone["threshold"]);
    if (finds) BOOST_TEST(frames[0]["threshold"] > frames[1]["threshold"]);
    const Json clocked = frames_of(
        place, {"bright.png", "dim.png", "dim.png", "--design", design, "--fidelity", "clocked"});
    BOOST_TEST(clocked == frames, "both fidelities settle alike");
  }
}

// What lies around a pixel decides: no picture before it matters.
BOOST_AUTO_TEST_CASE(a_threshold_of_each_pixel_needs_no_picture_before) {
  const Light place;
  for (const Json& frame : frames_of(place, {"bright.png", "dim.png", "--design", "careful"})) {
    check_marker(frame, 0);
    BOOST_TEST(!frame.contains("settling_showings"));
  }
}

BOOST_AUTO_TEST_CASE(settling_is_in_no_rate_and_no_energy) {
  const Light place;
  const auto summary = [&](const Arguments& arguments) {
    frames_of(place, arguments);
    return place.result()["summary"];
  };
  const Arguments design{"--design", "improved", "--set", "profile=a9-O2"};
  const auto with = [&](Arguments inputs) {
    inputs.insert(inputs.end(), design.begin(), design.end());
    return inputs;
  };
  // Each of two pictures in turn, and one all the time: they take the same work.
  const Json turns = summary(with({"bright.png", "dim.png", "--repeat", "5"}));
  const Json steady = summary(with({"bright.png", "--repeat", "10"}));
  BOOST_TEST(turns["frames"] == 10);
  BOOST_TEST(turns["fps"]["mean"].get<double>() == steady["fps"]["mean"].get<double>(),
             boost::test_tools::tolerance(0.02));
  BOOST_TEST(
      turns["energy_per_frame_mj"].get<double>() == steady["energy_per_frame_mj"].get<double>(),
      boost::test_tools::tolerance(0.02));
}

BOOST_AUTO_TEST_CASE(at_a_rate_an_image_waits_until_it_has_settled) {
  const Light place;
  const Json frames = frames_of(place, {"bright.png", "dim.png", "--design", "improved", "--rate",
                                        "20 fps", "--set", "profile=a9-O2"});
  BOOST_TEST_REQUIRE(frames.size() == 2u);
  check_marker(frames[1], 0);
  const Json camera = place.result()["camera"];
  BOOST_TEST(camera["dropped"] == 0);
}

/// A picture's levels are a camera's: what light they stand for is found, unless it is given.
BOOST_AUTO_TEST_CASE(a_response_curve_is_found_or_given) {
  Workplace place;
  cv::Mat picture = scene_picture("z1.0@yaw=30deg");
  for (auto pixel = picture.begin<std::uint8_t>(); pixel != picture.end<std::uint8_t>(); ++pixel)
    *pixel = static_cast<std::uint8_t>(std::lround(255 * std::pow(*pixel / 255.0, 1 / 2.2)));
  write_picture(place / "curved.png", picture);
  const auto depth_mm = [&](const Arguments& settings, const char* origin) {
    Arguments arguments{"curved.png", "--design", "improved"};
    arguments.insert(arguments.end(), settings.begin(), settings.end());
    const Json frame = frames_of(place, arguments)[0];
    BOOST_TEST_REQUIRE(frame["markers"].size() == 1u);
    const std::string said =
        frame.contains("response") ? std::string(frame["response"]["origin"]) : "";
    BOOST_TEST(said == origin);
    return 1000 * double(frame["markers"][0]["pose"]["translation_m"][2]);
  };
  const Json scene = frames_of(place, {"z1.0@yaw=30deg", "--design", "improved"})[0];
  BOOST_TEST(!scene.contains("response"), "a scene's levels are light");
  const double true_mm = 1000 * double(scene["markers"][0]["truth"]["pose"]["translation_m"][2]);
  BOOST_TEST(std::abs(depth_mm({"--set", "sw.response=linear"}, "") - true_mm) > 1);
  BOOST_TEST(std::abs(depth_mm({}, "found") - true_mm) < 0.5);
  BOOST_TEST(std::abs(depth_mm({"--set", "sw.response=exponent"}, "given") - true_mm) < 0.5);
}

BOOST_AUTO_TEST_CASE(scenes_do_not_settle_unless_behind_an_image) {
  const Light place;
  for (const Json& frame : frames_of(place, {"z1.0", "z1.5@light=0.3", "--design", "improved"}))
    BOOST_TEST(!frame.contains("settling_showings"));
  const Json frames = frames_of(place, {"dim.png", "z1.0", "--design", "improved"});
  BOOST_TEST(frames[1]["settling_showings"] == 2);
}

// As a camera's program sends them.
BOOST_AUTO_TEST_CASE(the_standard_input_is_an_image_or_a_video) {
  const Workplace place;
  write_picture(place / "a.pgm", scene_picture("z1.0"));
  const auto sent = [&](const std::string& command) {
    return kit::run_process("/bin/sh", {"-c", command + " | " MARKERVP_EXECUTABLE " run --quiet -"},
                            place.path());
  };
  const kit::Outcome two = sent("cat a.pgm a.pgm");
  BOOST_TEST(two.exit_code == 0, two.err);
  const Json frames = place.result()["frames"];
  BOOST_TEST(inputs_of(frames) == (Names{"-#0", "-#1"}));
  check_marker(frames[1], 0);
  BOOST_TEST(sent("cat a.pgm").exit_code == 0);
  BOOST_TEST(inputs_of(place.result()["frames"]) == Names{"-"});
  const kit::Outcome nothing = sent("true");
  BOOST_TEST(nothing.exit_code == 2);
  BOOST_TEST(contains(nothing.err, "input '-' is empty"), nothing.err);
}

BOOST_AUTO_TEST_SUITE_END()
