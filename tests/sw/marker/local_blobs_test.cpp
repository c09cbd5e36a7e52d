#include <marker/local_blobs.h>
#include <marker/scene/renderer.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <random>
#include <set>
#include <vector>

#include <blob_stream.h>

#include <boost/test/unit_test.hpp>

#include "pictures.h"

using marker::GreyImage;
using Reaches = std::array<int, 8>;

namespace {

/// 0 where a pixel is darker than the 11 x 11 around it by an eighth of their mean and two levels,
/// else 255: pixel by pixel.
platform::GreyImage made_binary(const platform::GreyImage& picture) {
  platform::GreyImage binary = picture;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      int sum = 0, count = 0;
      for (int j = std::max(y - 5, 0); j <= std::min(y + 5, picture.height - 1); ++j) {
        for (int i = std::max(x - 5, 0); i <= std::min(x + 5, picture.width - 1); ++i, ++count)
          sum += picture.pixels[static_cast<std::size_t>(j * picture.width + i)];
      }
      std::uint8_t& pixel = binary.pixels[static_cast<std::size_t>(y * picture.width + x)];
      pixel = count * pixel + std::max(2 * count, sum / 8) <= sum ? 0 : 255;
    }
  }
  return binary;
}

/// How far out each blob is in the eight directions: which of equals is the extreme says nothing.
std::multiset<Reaches> in_any_order(const std::uint32_t* words, std::size_t count) {
  std::multiset<Reaches> all;
  for (std::size_t i = 0; i < count; ++i, words += 8) {
    const auto x = [&](unsigned k) { return static_cast<int>(blob_stream::x(words[k])); };
    const auto y = [&](unsigned k) { return static_cast<int>(blob_stream::y(words[k])); };
    all.insert({y(0), x(1) - y(1), x(2), x(3) + y(3), y(4), x(5) - y(5), x(6), x(7) + y(7)});
  }
  return all;
}

void is_as_pixel_by_pixel(const platform::GreyImage& picture, std::uint32_t least) {
  const platform::GreyImage binary = made_binary(picture);
  const std::vector<std::uint32_t> words =
      pictures::words_of(pictures::find_blobs(pictures::view(binary), 127, 8));
  const auto local = std::make_unique<marker::LocalBlobs>();
  const marker::BlobList found = local->find(pictures::view(picture), 9);
  BOOST_TEST(found.count >= least);
  BOOST_TEST(local->lost() == 0u);
  BOOST_TEST(
      (in_any_order(found.words, found.count) == in_any_order(words.data(), words.size() / 8)));
}

}  // namespace

BOOST_AUTO_TEST_SUITE(local_blobs)

BOOST_AUTO_TEST_CASE(blobs_are_those_of_the_rule_pixel_by_pixel) {
  is_as_pixel_by_pixel(platform::render(pictures::ten_markers()), 10);
  is_as_pixel_by_pixel(
      platform::render(platform::make_scene("z2.0@markers=4,light=0.05,noise=0.01")), 4);
}

BOOST_AUTO_TEST_CASE(noise_of_any_size_is_as_good) {
  std::mt19937 random(3);
  for (const int width : {32, 64, 96}) {
    platform::GreyImage noise{width, 40, {}};
    for (int i = 0; i < width * 40; ++i)
      noise.pixels.push_back(static_cast<std::uint8_t>(random() % 256));
    is_as_pixel_by_pixel(noise, 1);
  }
}

BOOST_AUTO_TEST_CASE(a_grey_picture_has_none) {
  const std::vector<std::uint8_t> grey(64 * 48, 90);
  const auto local = std::make_unique<marker::LocalBlobs>();
  BOOST_TEST(local->find({grey.data(), 64, 48}, 9).count == 0u);
}

BOOST_AUTO_TEST_CASE(blobs_without_room_are_counted) {
  // Rings of 9 px, 12 px apart: more than there is room for.
  constexpr std::uint32_t side = 1200, step = 12;
  std::vector<std::uint8_t> pixels(side * side, 200);
  for (std::uint32_t y = 0; y < side; ++y) {
    for (std::uint32_t x = 0; x < side; ++x) {
      const std::uint32_t i = x % step, j = y % step;
      const bool is_ring = i < 9 && j < 9 && (i == 0 || i == 8 || j == 0 || j == 8);
      if (is_ring) pixels[y * side + x] = 20;
    }
  }
  const auto local = std::make_unique<marker::LocalBlobs>();
  const std::uint32_t rings = side / step * (side / step);
  BOOST_TEST(local->find({pixels.data(), side, side}, 9).count == marker::LocalBlobs::most_blobs);
  BOOST_TEST(local->lost() == rings - marker::LocalBlobs::most_blobs);
}

BOOST_AUTO_TEST_SUITE_END()
