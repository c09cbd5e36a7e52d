#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include <result/page/report_page.h>

namespace page = platform::page;
using Json = nlohmann::json;

BOOST_AUTO_TEST_SUITE(run_extras)

BOOST_AUTO_TEST_CASE(only_the_first_units_and_never_none) {
  page::RunExtras many;
  for (std::uint32_t i = 0; i < 100; ++i) many.add(i, R"({"seen":true})");
  const Json json = Json::parse(many.json({}));
  BOOST_TEST(json["frames"].size() == page::RunExtras::most_frames);
  BOOST_TEST(json["frames"]["3"]["seen"] == true);
  page::RunExtras large;
  const std::string text = "\"" + std::string(page::RunExtras::most_bytes, 'x') + "\"";
  for (std::uint32_t i = 0; i < 3; ++i) large.add(i, text);
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
