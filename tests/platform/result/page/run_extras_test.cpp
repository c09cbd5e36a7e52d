#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include <result/page/report_page.h>

namespace page = platform::page;
using Json = nlohmann::json;

namespace {

platform::GreyImage image_of(int width, int height) {
  platform::GreyImage image;
  image.width = width;
  image.height = height;
  image.pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  std::uint32_t noise = 1;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    noise = noise * 1664525u + 1013904223u;
    image.pixels[i] = static_cast<std::uint8_t>(noise >> 24);
  }
  return image;
}

platform::facts::FrameReport frame(std::uint32_t index) {
  platform::facts::FrameReport result;
  result.index = index;
  result.features.corners.push_back({10, 20, 5, marker::Direction::west, 0});
  result.features.blobs.push_back({});
  result.features.candidates.push_back({{{1, 2}, {3, 2}, {3, 4}, {1, 4}}});
  return result;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(run_extras)

BOOST_AUTO_TEST_CASE(frames_with_image_and_features) {
  page::RunExtras extras;
  extras.add(image_of(64, 48), frame(3));
  const Json json = Json::parse(extras.json({}));
  const Json& view = json["frames"]["3"];
  BOOST_TEST(view["width"] == 64);
  BOOST_TEST(view["height"] == 48);
  BOOST_TEST(view["camera"]["fx"] == 381.36);
  BOOST_TEST(view["corners"] == Json::parse("[[10,20,3]]"));
  BOOST_TEST(view["candidates"] == Json::parse("[[[1,2],[3,2],[3,4],[1,4]]]"));
  BOOST_TEST(view["blobs"].size() == 1);
  BOOST_TEST(view["png"].get<std::string>().rfind("iVBORw0KGgo", 0) == 0, "a PNG file");
}

BOOST_AUTO_TEST_CASE(only_the_first_frames_and_never_none) {
  page::RunExtras many;
  for (std::uint32_t i = 0; i < 100; ++i) many.add(image_of(16, 16), frame(i));
  BOOST_TEST(Json::parse(many.json({}))["frames"].size() == page::RunExtras::most_frames);
  page::RunExtras large;
  for (std::uint32_t i = 0; i < 3; ++i) large.add(image_of(2048, 1600), frame(i));
  BOOST_TEST(Json::parse(large.json({}))["frames"].size() == 1);
}

BOOST_AUTO_TEST_CASE(parameters_and_members) {
  page::RunExtras extras;
  extras.add_member("timeline", R"({"tracks":[]})");
  const Json json = Json::parse(extras.json(
      {{"pl.width", "320 px", "640 px", "", vp::Source::published, "width of a \"frame\""}}));
  BOOST_TEST(json["parameters"] ==
             Json::parse(R"([["pl.width","640 px","published","width of a \"frame\""]])"));
  BOOST_TEST(json["timeline"]["tracks"].empty());
}

BOOST_AUTO_TEST_SUITE_END()
