#include <marker/picture/page_view.h>

#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include <marker/report/marker_frame.h>
#include <vp/text.h>

using Json = nlohmann::json;

BOOST_AUTO_TEST_SUITE(page_view)

BOOST_AUTO_TEST_CASE(a_frame_with_image_and_features) {
  const platform::GreyImage image{64, 48, std::vector<std::uint8_t>(64 * 48, 90)};
  platform::facts::UnitReport frame;
  platform::Features& features = platform::marker_frame(frame).features;
  features.corners.push_back({10, 20, 5, marker::Direction::west, 0});
  features.blobs.push_back({});
  features.candidates.push_back({{{1, 2}, {3, 2}, {3, 4}, {1, 4}}});
  const Json view = Json::parse(platform::picture::page_view(image, frame));
  BOOST_TEST(view["width"] == 64);
  BOOST_TEST(view["height"] == 48);
  BOOST_TEST(view["camera"]["fx"] == 381.36);
  BOOST_TEST(view["corners"] == Json::parse("[[10,20,3]]"));
  BOOST_TEST(view["candidates"] == Json::parse("[[[1,2],[3,2],[3,4],[1,4]]]"));
  BOOST_TEST(view["blobs"].size() == 1);
  BOOST_TEST(view["png"].get<std::string>().rfind("iVBORw0KGgo", 0) == 0, "a PNG file");
}

BOOST_AUTO_TEST_SUITE_END()
