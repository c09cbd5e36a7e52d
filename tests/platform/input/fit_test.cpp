#include <input/frame_source.h>

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

BOOST_AUTO_TEST_CASE(scale_keeps_the_aspect_ratio_and_cuts_the_sides) {
  // 160x60 to 40x30: the middle 80x60 is halved.
  cv::Mat whole(60, 160, CV_8UC1, cv::Scalar(0));
  whole(cv::Rect(40, 0, 80, 60)) = cv::Scalar(200);
  const GreyImage scaled = fit_image(image_of(whole), {40, 30}, Fit::scale);
  BOOST_TEST(same(scaled, cv::Mat(30, 40, CV_8UC1, cv::Scalar(200))));
  const Camera camera = fit_camera({160, 60, 100, 100, 80, 30}, {40, 30}, Fit::scale);
  BOOST_TEST(camera.fx == 50.0);
  BOOST_TEST(camera.cx == 20.0);
  BOOST_TEST(camera.cy == 15.0);
}

BOOST_AUTO_TEST_CASE(scale_enlarges_small_images) {
  const GreyImage scaled = fit_image(image_of(pattern(32, 24)), {64, 48}, Fit::scale);
  BOOST_TEST(scaled.pixels.size() == 64u * 48u);
  BOOST_TEST(fit_camera({32, 24, 10, 10, 16, 12}, {64, 48}, Fit::scale).fx == 20.0);
}

BOOST_AUTO_TEST_SUITE_END()
