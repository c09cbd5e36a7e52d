#pragma once

#include <boost/test/unit_test.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include <marker/scene/grey_image.h>
#include <vp/error.h>

namespace input_test {

/// A picture in which every pixel tells its place.
inline cv::Mat pattern(int width, int height, int type = CV_8UC1) {
  cv::Mat picture(height, width, type);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width * picture.channels(); ++x) {
      const int value = (x * 7 + y * 13 + (x * y) % 11) % 256;
      if (picture.depth() == CV_16U) {
        picture.ptr<ushort>(y)[x] = static_cast<ushort>(value * 256 + 77);
      } else {
        picture.ptr(y)[x] = static_cast<uchar>(value);
      }
    }
  }
  return picture;
}

inline bool same(const platform::GreyImage& image, const cv::Mat& expected) {
  return image.width == expected.cols && image.height == expected.rows && expected.isContinuous() &&
         std::equal(image.pixels.begin(), image.pixels.end(), expected.ptr());
}

/// The message of the vp::InputError that `call` must throw; one line, or the test fails.
template <typename Call>
std::string refusal(Call call) {
  try {
    call();
  } catch (const vp::InputError& error) {
    const std::string message = error.what();
    BOOST_TEST(message.find('\n') == std::string::npos, message);
    return message;
  }
  BOOST_ERROR("nothing was refused");
  return "";
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// One check: the call is refused in words that hold `part`.
#define CHECK_REFUSED(call, part)                                    \
  do {                                                               \
    const std::string message_ = input_test::refusal([&] { call; }); \
    BOOST_TEST(input_test::contains(message_, part),                 \
               "'" << message_ << "' lacks '" << part << "'");       \
  } while (false)

}  // namespace input_test
