#include <marker/picture/picture.h>

#include <marker/scene/renderer.h>
#include <boost/test/unit_test.hpp>
#include <opencv2/imgcodecs.hpp>

#include <vp/error.h>

#include "../../result/report_kit.h"
#include "temporary_files.h"

using namespace platform;
using namespace platform::picture;

namespace {

/// The colour of the picture at an image coordinate, px.
std::array<int, 3> colour(const Picture& picture, double x, double y) {
  const int scale = picture.width / 640;
  const auto column = static_cast<std::size_t>(x * scale);
  const auto row = static_cast<std::size_t>(y * scale);
  const std::size_t at = (row * static_cast<std::size_t>(picture.width) + column) * 3;
  return {picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]};
}

using Rgb = std::array<int, 3>;
const Rgb yellow{240, 228, 66};
const Rgb reddish_purple{204, 121, 167};
const Rgb sky_blue{86, 180, 233};

bool is_grey(const Rgb& c) {
  return c[0] == c[1] && c[1] == c[2];
}

struct Example {
  GreyImage image = render(make_scene("z1.0"));
  facts::UnitReport frame = report_test::found_frame("z1.0");

  Example() {
    marker_frame(frame).markers[0].corners_px = marker_frame(frame).truth->corners_px;
    marker_frame(frame).features.corners.push_back({100, 100, 50, marker::Direction::north, 0});
    marker_frame(frame).features.blobs.push_back({50, 300, 119, 359, 0});
  }
};

}  // namespace

BOOST_AUTO_TEST_SUITE(picture_of_a_frame)

BOOST_AUTO_TEST_CASE(features_stand_where_they_were_found) {
  const Example example;
  const Picture picture = annotate(example.image, example.frame);
  BOOST_TEST(picture.width == 1280);
  BOOST_TEST(picture.height > 960, "the strip is below the image");
  BOOST_TEST(colour(picture, 100.6, 100.6) == sky_blue);
  BOOST_TEST(colour(picture, 85, 299.9) == reddish_purple, "the box encloses its pixels");
  BOOST_TEST(colour(picture, 85, 360.1) == reddish_purple);
  const auto& corners = marker_frame(example.frame).markers[0].corners_px;
  BOOST_TEST(colour(picture, (corners[1].x + corners[2].x) / 2,
                    (corners[1].y + corners[2].y) / 2) == yellow);
  BOOST_TEST(is_grey(colour(picture, 200, 60)));
}

BOOST_AUTO_TEST_CASE(an_empty_frame_is_the_image_alone) {
  Example example;
  marker_frame(example.frame).markers.clear();
  marker_frame(example.frame).features = {};
  const Picture picture = annotate(example.image, example.frame);
  for (std::size_t i = 0; i < 1280u * 960u * 3u; i += 3) {
    if (picture.rgb[i] != picture.rgb[i + 1]) BOOST_FAIL("colour at byte " << i);
  }
}

/// Something in the strip below the image has this tint, in the legend or left of it. What is thin
/// is blended with the ground.
bool strip_has(const Picture& picture, bool (*tint)(const std::uint8_t* rgb), bool legend) {
  for (std::size_t row = 960; row < std::size_t(picture.height); ++row) {
    for (std::size_t column = legend ? 820 : 0; column < (legend ? 1280u : 820u); ++column) {
      if (tint(&picture.rgb[(row * 1280 + column) * 3])) return true;
    }
  }
  return false;
}

bool is_yellow(const std::uint8_t* c) {
  return c[0] > c[2] + 60 && c[1] > c[2] + 60;
}
bool is_purple(const std::uint8_t* c) {
  return c[0] > c[1] + 30 && c[2] > c[1] + 15;
}
bool is_sky_blue(const std::uint8_t* c) {
  return c[2] > c[0] + 60 && c[1] > c[0] + 40;
}

BOOST_AUTO_TEST_CASE(the_legend_has_what_is_drawn_and_nothing_else) {
  Example example;
  Picture picture = annotate(example.image, example.frame);
  for (const auto tint : {is_sky_blue, is_purple, is_yellow})
    BOOST_TEST(strip_has(picture, tint, true));
  marker_frame(example.frame).features.corners.clear();
  picture = annotate(example.image, example.frame);
  BOOST_TEST(!strip_has(picture, is_sky_blue, true));
  BOOST_TEST(strip_has(picture, is_purple, true));
  marker_frame(example.frame).features.blobs.clear();
  marker_frame(example.frame).markers.clear();
  picture = annotate(example.image, example.frame);
  BOOST_TEST(!strip_has(picture, is_purple, true));
  BOOST_TEST(!strip_has(picture, is_yellow, true));
  BOOST_TEST(strip_has(picture, is_yellow, false), "the time that the frame took");
}

BOOST_AUTO_TEST_CASE(what_lies_outside_the_image_or_behind_the_camera_does_no_harm) {
  Example example;
  FoundMarker& marker = marker_frame(example.frame).markers[0];
  marker.corners_px = {{{-1e9, 5}, {1e12, -4}, {700, 1e7}, {-50, 500}}};
  annotate(example.image, example.frame);
  marker.pose.translation[2] = -1;
  annotate(example.image, example.frame);
  marker.has_pose = false;
  annotate(example.image, example.frame);
}

BOOST_AUTO_TEST_CASE(any_resolution_has_its_picture) {
  for (const auto& [width, height, scale] :
       {std::array{64, 32, 20}, std::array{1024, 512, 1}, std::array{1920, 1080, 1}}) {
    GreyImage image{width, height,
                    std::vector<std::uint8_t>(std::size_t(width) * std::size_t(height), 100)};
    const Picture picture = annotate(image, report_test::found_frame("z1.0"));
    BOOST_TEST(picture.width == width * scale);
    BOOST_TEST(picture.rgb.size() == std::size_t(picture.width) * std::size_t(picture.height) * 3);
  }
}

BOOST_AUTO_TEST_CASE(the_file_holds_the_picture_and_equal_ones_are_equal) {
  const kit::TemporaryFolder folder;
  const Example example;
  const Picture picture = annotate(example.image, example.frame);
  write_png(picture, folder / "a.png");
  write_png(annotate(example.image, example.frame), folder / "b.png");
  BOOST_TEST((kit::read_file(folder / "a.png") == kit::read_file(folder / "b.png")));
  const cv::Mat read = cv::imread(folder / "a.png");
  BOOST_TEST_REQUIRE(read.cols == picture.width);
  BOOST_TEST_REQUIRE(read.rows == picture.height);
  const cv::Vec3b bgr = read.at<cv::Vec3b>(200, 200);
  const std::size_t at = (200u * 1280u + 200u) * 3u;
  BOOST_TEST(bgr[0] == picture.rgb[at + 2]);
  BOOST_TEST(bgr[2] == picture.rgb[at]);
  BOOST_CHECK_THROW(write_png(picture, folder / "no/folder.png"), vp::InputError);
  BOOST_TEST(folder.entries().size() == 2u);
}

BOOST_AUTO_TEST_CASE(names_are_safe_and_sort) {
  facts::UnitReport frame = report_test::found_frame("z1.0", 7);
  BOOST_TEST(picture_name(frame) == "0007_z1.0.png");
  marker_frame(frame).truth.reset();
  frame.input = "my photo/1.jpeg";
  BOOST_TEST(picture_name(frame) == "0007_my_photo_1.png");
  frame.input = "clip.avi#12";
  BOOST_TEST(picture_name(frame) == "0007_clip_12.png");
  frame.input = "plain";
  BOOST_TEST(picture_name(frame) == "0007_plain.png");
  frame.input = std::string(250, 'n') + ".png";
  BOOST_TEST(picture_name(frame) == "0007_" + std::string(200, 'n') + ".png");
}

BOOST_AUTO_TEST_SUITE_END()
