// The timing file: what is installed, what is refused, and the arithmetic of a path.
#include <fpga/synthesis/path_timing.h>

#include <boost/test/unit_test.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include <vp/error.h>

#include "temporary_files.h"

using namespace platform::synthesis;
using Json = nlohmann::ordered_json;

namespace {

const std::string committed = std::string(MARKERVP_DATA) + "/rtl/xc7.json";

/// 1 ns a net, 2 for the root of the fan-out, half of the slack up to 2 ns; a band of 0.5 to 2
/// around 1.2.
Json simple() {
  Json json = Json::parse(std::ifstream(committed));
  json["nets"] = {{"per_net_ns", 1.0},  {"fan_out_ns", 2.0}, {"slack_share", 0.5},
                  {"most_slack_ns", 2}, {"tight", 1.2},      {"low", 0.5},
                  {"high", 2.0},        {"skew_ns", -0.1},   {"uncertainty_ns", 0.2}};
  return json;
}

PathTiming load(const Json& json) {
  const kit::TemporaryFolder folder;
  kit::write_file(folder / "own.json", json.dump());
  return PathTiming::load(folder / "own.json");
}

std::string refusal(const Json& json) {
  try {
    load(json);
  } catch (const vp::InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

BOOST_AUTO_TEST_SUITE(path_timing)

BOOST_AUTO_TEST_CASE(nets_take_twice_their_base_until_none_has_more_to_spare) {
  const PathTiming timing = load(simple());
  BOOST_TEST(timing.net_ns() == 2.0);
  BOOST_TEST(timing.nets_ns(3, 1) == 6.0);  // base 3, half of 6
  BOOST_TEST(timing.nets_ns(3, 8) == 8.0);  // base 5, but no more than half of 3 x 2
  BOOST_TEST(timing.nets_ns(0, 1) == timing.nets_ns(1, 1));  // a path has a net
}

BOOST_AUTO_TEST_CASE(fmax_is_a_range_of_the_data_path_and_ends_are_added) {
  const PathTiming timing = load(simple());
  Path path;
  path.cells_ns = 4;
  path.nets = 3;
  path.setup_ns = 0.7;
  const FmaxRange fmax = timing.fmax(path);  // data path 10 ns; ends 0.7 + 0.2 + 0.1
  BOOST_TEST(timing.period_ns(path) == 11.0, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(fmax.nominal == 1000 / 13.0, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(fmax.low == 1000 / 21.0, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(fmax.high == 1000 / 6.0, boost::test_tools::tolerance(1e-12));
}

// No figure that is kept is beyond what a clock buffer of the chip can do.
BOOST_AUTO_TEST_CASE(no_committed_figure_is_above_the_limit_of_a_clock_buffer) {
  const double most = PathTiming::load(committed).limit_mhz("global_buffer");
  const Json figures =
      Json::parse(std::ifstream(std::string(MARKERVP_DATA) + "/rtl/synthesis.json"));
  for (const Json& entry : figures["entries"]) {
    if (entry.contains("fmax_mhz")) BOOST_TEST(entry["fmax_mhz"]["high"] <= most, entry["ip"]);
  }
}

BOOST_AUTO_TEST_CASE(what_is_committed_is_read) {
  const PathTiming timing = PathTiming::load(committed);
  BOOST_TEST(timing["ff_out"] == 0.456);
  BOOST_TEST(timing.net_ns() > 0.3);
}

// The thesis' own figures (4.6.1), which nothing here was fitted to.
BOOST_AUTO_TEST_CASE(what_the_thesis_reached_is_in_the_committed_ranges) {
  const Json figures =
      Json::parse(std::ifstream(std::string(MARKERVP_DATA) + "/rtl/synthesis.json"));
  BOOST_TEST(figures["tool"] == "Yosys 0.23");
  unsigned found = 0;
  for (const Json& entry : figures["entries"]) {
    const Json& parameters = entry["parameters"];
    if (entry["ip"] == "blob_detection" && parameters["LABELS"] == 128) {
      BOOST_TEST(entry["fmax_mhz"]["low"].get<double>() < 55);
      BOOST_TEST(entry["fmax_mhz"]["high"].get<double>() > 55);
      ++found;
    }
    const bool comfortable =
        (entry["ip"] == "global_threshold" && parameters["PIXELS_PER_CLOCK"] == 1) ||
        (entry["ip"] == "corner_detection" && parameters["LEAN"] == 0);
    if (comfortable) {
      BOOST_TEST(entry["fmax_mhz"]["high"].get<double>() > 100, entry["ip"]);
      ++found;
    }
  }
  BOOST_TEST(found == 3u);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_is_refused_by_name) {
  Json json = simple();
  json["cells_ns"].erase("lut");
  BOOST_TEST(refusal(json).find("'cells_ns.lut' is to be a number") != std::string::npos);
  json = simple();
  json["nets"]["slack_share"] = 1.0;
  BOOST_TEST(refusal(json).find("'nets.slack_share'") != std::string::npos);
  json = simple();
  json["nets"]["tight"] = 2.5;  // beyond the band
  BOOST_TEST(refusal(json).find("'nets.tight'") != std::string::npos);
  json = simple();
  json["nets"]["high"] = "much";
  BOOST_TEST(refusal(json).find("'nets.high'") != std::string::npos);
  json = simple();
  json.erase("cells_ns");
  BOOST_TEST(refusal(json).find("'cells_ns' is missing") != std::string::npos);
  json = simple();
  json["limits_mhz"].erase("bram");
  BOOST_TEST(refusal(json).find("'limits_mhz.bram' is to be a number") != std::string::npos);
  json = simple();
  json["limits_mhz"]["dsp"] = 0;
  BOOST_TEST(refusal(json).find("'limits_mhz.dsp'") != std::string::npos);
  BOOST_TEST(refusal(Json::array()).find("not a JSON object") != std::string::npos);
  BOOST_CHECK_THROW(PathTiming::load("not/there.json"), vp::InputError);
}

BOOST_AUTO_TEST_SUITE_END()
