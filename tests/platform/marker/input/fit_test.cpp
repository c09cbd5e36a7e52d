#include <marker/input/frame_source.h>

#include "image_kit.h"

using namespace platform;
using namespace platform::input;
using namespace input_test;

namespace {

GreyImage image_of(const cv::Mat& picture) {
  return {picture.cols, picture.rows, {picture.datastart, picture.dataend}};
}

const Camera thesis = Camera::for_resolution(640, 480);

}  // namespace

BOOST_AUTO_TEST_SUITE(fit)

BOOST_AUTO_TEST_CASE(an_image_of_the_right_size_is_left_alone) {
  for (const Fit fit : {Fit::none, Fit::crop, Fit::scale}) {
    check_fit("a.png", {64, 48}, {64, 48}, fit);
    BOOST_TEST(same(fit_image(image_of(pattern(64, 48)), {64, 48}, fit), pattern(64, 48)));
  }
  BOOST_TEST(fit_camera(thesis, {640, 480}, Fit::scale).cx == 320.0);
}

BOOST_AUTO_TEST_CASE(another_size_is_refused_with_what_to_do) {
  CHECK_REFUSED(check_fit("a.png", {800, 600}, {640, 480}, Fit::none),
                "'a.png' is 800x600 px, the platform takes 640x480: use --fit crop or --fit scale");
  CHECK_REFUSED(check_fit("a.png", {639, 600}, {640, 480}, Fit::crop), "too small to crop");
  CHECK_REFUSED(check_fit("a.png", {100'000, 1}, {640, 480}, Fit::scale),
                "'a.png' is 100000x1 px: an image has at most 16384 px a side");
  CHECK_REFUSED(check_fit("a.png", {800, 479}, {640, 480}, Fit::crop), "too small to crop");
  check_fit("a.png", {10, 10}, {640, 480}, Fit::scale);
}

BOOST_AUTO_TEST_CASE(crop_takes_the_middle) {
  const cv::Mat whole = pattern(70, 51);
  const GreyImage cropped = fit_image(image_of(whole), {64, 48}, Fit::crop);
  BOOST_TEST(same(cropped, whole(cv::Rect(3, 1, 64, 48)).clone()));
}

BOOST_AUTO_TEST_CASE(crop_moves_the_principal_point) {
  const Camera cropped = fit_camera({800, 600, 500, 510, 410, 290}, {640, 480}, Fit::crop);
  BOOST_TEST(cropped.width == 640);
  BOOST_TEST(cropped.height == 480);
  BOOST_TEST(cropped.fx == 500.0);
  BOOST_TEST(cropped.fy == 510.0);
  BOOST_TEST(cropped.cx == 330.0);
  BOOST_TEST(cropped.cy == 230.0);
}

BOOST_AUTO_TEST_CASE(scale_averages_areas) {
  cv::Mat whole(8, 8, CV_8UC1, cv::Scalar(10));
  whole(cv::Rect(0, 0, 2, 2)) = cv::Scalar(50);
  const GreyImage scaled = fit_image(image_of(whole), {4, 4}, Fit::scale);
  BOOST_TEST(scaled.at(0, 0) == 50);
  BOOST_TEST(scaled.at(1, 0) == 10);
  BOOST_TEST(scaled.at(3, 3) == 10);
}

BOOST_AUTO_TEST_CASE(scale_takes_the_whole_image_and_fills_with_bars) {
  // 160x60 to 40x30: a quarter of the size, 40x15, with bars of 7 and 8 rows.
  cv::Mat whole(60, 160, CV_8UC1, cv::Scalar(40));
  whole(cv::Rect(0, 0, 80, 60)) = cv::Scalar(200);
  const GreyImage scaled = fit_image(image_of(whole), {40, 30}, Fit::scale);
  cv::Mat expected(30, 40, CV_8UC1, cv::Scalar(200));
  expected(cv::Rect(20, 7, 20, 15)) = cv::Scalar(40);
  BOOST_TEST(same(scaled, expected), "bars are as bright as the bright half");
  const Camera camera = fit_camera({160, 60, 100, 100, 80, 30}, {40, 30}, Fit::scale);
  BOOST_TEST(camera.fx == 25.0);
  BOOST_TEST(camera.fy == 25.0);
  BOOST_TEST(camera.cx == 20.0);
  BOOST_TEST(camera.cy == 14.5);
}

/// A point of the whole image is where its camera says in the fitted one.
BOOST_AUTO_TEST_CASE(the_camera_follows_the_pixels) {
  cv::Mat whole(720, 1280, CV_8UC1, cv::Scalar(10));
  whole(cv::Rect(1240, 8, 4, 4)) = cv::Scalar(250);
  const GreyImage scaled = fit_image(image_of(whole), {640, 480}, Fit::scale);
  BOOST_TEST(scaled.at(620, 64) == 250, "half the size, and 60 rows lower");
  BOOST_TEST(scaled.at(622, 64) == 10);
  const Camera camera = fit_camera({1280, 720, 900, 910, 600, 350}, {640, 480}, Fit::scale);
  BOOST_TEST(camera.cx == 300.0);
  BOOST_TEST(camera.cy == 235.0);
  BOOST_TEST(camera.fy == 455.0);
}

BOOST_AUTO_TEST_CASE(what_is_lost_is_said) {
  BOOST_TEST(fit_text({640, 480}, {640, 480}, Fit::scale) == "");
  BOOST_TEST(fit_text({1280, 720}, {640, 480}, Fit::scale) ==
             "images of 1280x720 px are scaled to 640x360 px (50 %), whole, with bars of 120 px in "
             "all above and below");
  BOOST_TEST(fit_text({480, 640}, {640, 480}, Fit::scale) ==
             "images of 480x640 px are scaled to 360x480 px (75 %), whole, with bars of 280 px in "
             "all at their sides");
  BOOST_TEST(fit_text({1280, 720}, {640, 480}, Fit::crop) ==
             "images of 1280x720 px are cropped to their middle 640x480 px: 67 % of each is cut "
             "off");
}

BOOST_AUTO_TEST_CASE(scale_enlarges_small_images) {
  const GreyImage scaled = fit_image(image_of(pattern(32, 24)), {64, 48}, Fit::scale);
  BOOST_TEST(scaled.pixels.size() == 64u * 48u);
  BOOST_TEST(fit_camera({32, 24, 10, 10, 16, 12}, {64, 48}, Fit::scale).fx == 20.0);
}

BOOST_AUTO_TEST_SUITE_END()
