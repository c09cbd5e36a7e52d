// The timeline: the same at both fidelities, and one that ui.perfetto.dev shows whole.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <filesystem>
#include <map>

#include "executable.h"

using namespace integration;

namespace {

Json timeline(const Arguments& arguments) {
  const Workplace place;
  Arguments all{"--no-report", "--no-pictures", "--quiet", "--timeline", "timeline.json"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  const kit::Outcome outcome = place.run(all);
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  return Json::parse(kit::read_file(place / "timeline.json"));
}

struct Span {
  double start, end;
};

/// Perfetto drops what neither nests nor stays apart.
bool nests(const std::vector<Span>& spans) {
  constexpr double tolerance_us = 1e-6;
  std::vector<Span> open;
  for (const Span& span : spans) {
    while (!open.empty() && open.back().end <= span.start + tolerance_us) open.pop_back();
    if (!open.empty() && span.end > open.back().end + tolerance_us) return false;
    open.push_back(span);
  }
  return true;
}

std::map<int, std::vector<Span>> tracks(const Json& json) {
  std::map<int, std::vector<Span>> result;
  for (const Json& event : json["traceEvents"]) {
    if (event["ph"] != "X") continue;
    const double start = event["ts"];
    result[event["tid"]].push_back({start, start + event["dur"].get<double>()});
  }
  return result;
}

std::size_t count(const Json& json, const std::string& name) {
  std::size_t found = 0;
  for (const Json& event : json["traceEvents"])
    found += event["ph"] == "X" && event["name"] == name;
  return found;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(timeline_file)

BOOST_AUTO_TEST_CASE(the_check_finds_overlaps) {
  BOOST_TEST(nests({{0, 10}, {1, 2}, {2, 3}, {10, 11}}));
  BOOST_TEST(!nests({{0, 10}, {5, 11}}));
}

BOOST_AUTO_TEST_CASE(both_fidelities_give_the_same) {
  const Json tlm = timeline({"demo", "roll30"});
  BOOST_TEST((tlm == timeline({"demo", "roll30", "--fidelity", "clocked"})));
}

// The bridge keeps up at 100 MHz; at 20 MHz words wait in its FIFO.
BOOST_AUTO_TEST_CASE(the_bridge_fifo_is_the_same_at_both_fidelities) {
  const Arguments slow{"demo", "--set", "ps.fclk_clk0.frequency=20MHz", "--set",
                       "ps.fclk_clk1.frequency=75MHz"};
  double most[2] = {};
  for (const Arguments& arguments : {Arguments{"demo"}, slow}) {
    Arguments clocked = arguments;
    clocked.insert(clocked.end(), {"--fidelity", "clocked"});
    const Json json = timeline(arguments);
    BOOST_TEST((json == timeline(clocked)));
    double& peak = most[arguments.size() > 1];
    for (const Json& event : json["traceEvents"]) {
      if (event["ph"] == "C" && event["name"] == "Bridge FIFO, most in a burst, words")
        peak = std::max(peak, event["args"]["value"].get<double>());
    }
  }
  BOOST_TEST(most[0] >= 1);
  BOOST_TEST(most[0] < most[1]);
  BOOST_TEST(most[1] <= 64);
}

// The handshake is in the page only.
BOOST_AUTO_TEST_CASE(the_page_has_the_same_handshake_at_both_fidelities) {
  std::string found[2];
  for (const bool clocked : {false, true}) {
    const Workplace place;
    place.run({"demo", "--no-pictures", "--quiet", "--fidelity", clocked ? "clocked" : "tlm"});
    if (!std::filesystem::exists(place / "out/report.html")) return;  // built without it
    const std::string page = kit::read_file(place / "out/report.html");
    const std::size_t at = page.find(R"("handshakes":[{"name":"Feature words")");
    BOOST_REQUIRE(at != std::string::npos);
    found[clocked] = page.substr(at, page.find("}]}]", at) - at);
  }
  BOOST_TEST(found[0] == found[1]);
}

BOOST_AUTO_TEST_CASE(nothing_overlaps_on_a_track) {
  for (const char* system : {"hybrid", "ps-only"}) {
    const Json json = timeline({"demo", "roll30", "--program", system});
    for (const auto& [track, spans] : tracks(json)) {
      BOOST_TEST(nests(spans), system << ", track " << track);
    }
  }
}

BOOST_AUTO_TEST_CASE(what_a_frame_is_made_of) {
  const Json json = timeline({"demo", "roll30", "z2.0", "--timeline-frames", "1"});
  BOOST_TEST(count(json, "upload") > 0u);
  BOOST_TEST(count(json, "identification") >= 1u);
  // 307 200 bytes in packets of 128, 307 200 bits in packets of 32 words (thesis 4.4).
  BOOST_TEST(count(json, "transfer") == 2400u + 300u);
  std::size_t frames = 0;
  for (const Json& event : json["traceEvents"]) {
    frames += event["ph"] == "X" && event["tid"] == 1 && event["name"] == "frame";
  }
  BOOST_TEST(frames == 1u);
}

BOOST_AUTO_TEST_CASE(a_file_that_cannot_be_written) {
  const Workplace place;
  const kit::Outcome outcome = place.run({"demo", "--timeline", "missing/t.json"});
  BOOST_TEST(outcome.exit_code == 2);
  BOOST_TEST(outcome.err.find("missing/t.json") != std::string::npos, outcome.err);
}

BOOST_AUTO_TEST_SUITE_END()
