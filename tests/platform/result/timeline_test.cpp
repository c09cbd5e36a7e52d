#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include <facts/timeline.h>

namespace facts = platform::facts;
using Json = nlohmann::json;

namespace {

facts::Timeline small() {
  facts::Timeline timeline;
  const std::uint32_t frame = timeline.name("frame");
  const std::uint32_t odd = timeline.name("a \"b\" \\ \n");
  timeline.tracks = {{"PL", "Sensor input", {{1'000'000, 2'500'001, frame, true}}},
                     {"PS", "Program", {{0, 123, odd, false}, {200, 1, frame, false}}}};
  timeline.counters = {{"Corner buffer", "words", 100, {{5'000, 1}, {6'000, 2}}}};
  timeline.frames = {{7, 1'000'000, 3'500'001}};
  return timeline;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(timeline)

BOOST_AUTO_TEST_CASE(a_name_is_kept_once) {
  facts::Timeline timeline;
  BOOST_TEST(timeline.empty());
  BOOST_TEST(timeline.name("a") == 0u);
  BOOST_TEST(timeline.name("b") == 1u);
  BOOST_TEST(timeline.name("a") == 0u);
  BOOST_TEST(timeline.names.size() == 2u);
}

BOOST_AUTO_TEST_CASE(trace_events_to_the_picosecond) {
  const std::string text = facts::trace_event_json(small());
  BOOST_TEST(text.find("\"ts\":1.000000,\"dur\":2.500001,") != std::string::npos, text);
  const Json json = Json::parse(text);
  BOOST_TEST(json["displayTimeUnit"] == "ns");
  std::vector<Json> spans;
  std::vector<std::string> threads;
  std::size_t counters = 0;
  for (const Json& event : json["traceEvents"]) {
    if (event["ph"] == "X") spans.push_back(event);
    if (event["ph"] == "C") ++counters;
    if (event["name"] == "thread_name") threads.push_back(event["args"]["name"]);
  }
  BOOST_TEST(threads == (std::vector<std::string>{"PL: Sensor input", "PS: Program"}),
             boost::test_tools::per_element());
  BOOST_REQUIRE(spans.size() == 3u);
  BOOST_TEST(spans[0]["tid"] == 1);
  BOOST_TEST(spans[0]["cat"] == "critical");
  BOOST_TEST(spans[1]["tid"] == 2);
  BOOST_TEST(spans[1]["name"] == "a \"b\" \\ \n");
  BOOST_TEST(counters == 2u);
}

BOOST_AUTO_TEST_CASE(the_page_gets_nanoseconds) {
  const Json json = Json::parse(facts::page_json(small()));
  BOOST_TEST(json["tracks"][0]["spans"] == Json::parse("[[1.0,2.5,0,1]]"));
  BOOST_TEST(json["tracks"][1]["spans"] == Json::parse("[[0.0,0.0,1,0],[0.0,0.0,0,0]]"));
  BOOST_TEST(json["counters"][0]["points"] == Json::parse("[[0.005,1],[0.006,2]]"));
  BOOST_TEST(json["frames"] == Json::parse(R"([{"index":7,"start":1.0,"end":3.5}])"));
}

BOOST_AUTO_TEST_CASE(nothing_recorded_is_still_a_file) {
  const Json json = Json::parse(facts::trace_event_json({}));
  BOOST_TEST(json["traceEvents"].size() == 1u, "the process' name");
}

BOOST_AUTO_TEST_SUITE_END()
