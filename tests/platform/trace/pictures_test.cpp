// Pictures of traces: what a plot may not hide, and timing diagrams for WaveDrom.
#include <boost/test/unit_test.hpp>

#include <trace/tools.h>
#include <trace/wavedrom.h>
#include <nlohmann/json.hpp>

#include "waves.h"

using namespace platform::trace;

namespace {

std::string plotted(const std::string& signals, const std::string& changes,
                    const std::vector<std::string>& shown, std::uint64_t to_ps) {
  const Waves waves(signals, changes);
  TraceFile file(waves.file);
  PlotOptions options;
  options.signals = shown;
  options.to_ps = to_ps;
  return plot_as_svg(file, options);
}

nlohmann::json diagram(const std::string& changes, std::uint64_t from_ns, std::uint64_t to_ns) {
  const Waves waves("t.clk 1, t.valid 1, t.word 8", changes);
  TraceFile file(waves.file);
  WaveDromOptions options;
  options.signals = {"valid", "word"};
  options.every = parse_clock_edge("clk");
  options.from_ps = from_ns * 1000;
  options.to_ps = to_ns * 1000;
  return nlohmann::json::parse(wavedrom_json(file, options));
}

/// A clock that rises at 5, 15 … ns; `others` by the ns at which they happen.
std::string clocked(const std::map<unsigned, std::string>& others, unsigned clocks) {
  std::string text = "#0 0! x\" bz #\n";
  for (unsigned ns = 1; ns < clocks * 10; ++ns) {
    const auto other = others.find(ns);
    if (other == others.end() && ns % 5 != 0) continue;
    text += "#" + std::to_string(ns) + "\n";
    if (ns % 10 == 5) text += "1!\n";
    if (ns % 10 == 0) text += "0!\n";
    if (other != others.end()) text += other->second + "\n";
  }
  return text;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(pictures)

BOOST_AUTO_TEST_CASE(a_pulse_narrower_than_a_pixel_is_a_spike) {
  const std::string pulse = "#0 0!\n#20000 1!\n#20010 0!\n#100000\n";
  const std::string svg = plotted("t.p 1", pulse, {"p"}, 100'000'000);
  const std::string flat = plotted("t.p 1", "#0 0!\n#100000\n", {"p"}, 100'000'000);
  // A vertical line over the whole height of the wave.
  const auto spike = [](const std::string& text) {
    return text.find(" 58.0V40.0\" fill=\"none\" stroke=\"#0072b2\"") != std::string::npos;
  };
  BOOST_TEST(spike(svg), svg);
  BOOST_TEST(!spike(flat));
}

BOOST_AUTO_TEST_CASE(an_event_is_a_spike_and_no_level) {
  const kit::TemporaryFolder folder;
  kit::write_file(folder / "t.vcd",
                  "$timescale 1ns $end $var event 1 ! go $end $enddefinitions $end\n"
                  "#0\n#40 1!\n#60 1!\n#100\n");
  TraceFile file(folder / "t.vcd");
  PlotOptions options;
  options.signals = {"go"};
  options.from_ps = 50'000;
  options.to_ps = 100'000;
  const std::string svg = plot_as_svg(file, options);
  const auto count = [&](const std::string& part) {
    std::size_t times = 0;
    for (auto at = svg.find(part); at != std::string::npos; at = svg.find(part, at + 1)) ++times;
    return times;
  };
  // The one in the window from the line at 0 to the top, and back.
  BOOST_TEST(count(" 58.0V40.0\" fill=\"none\" stroke=\"#0072b2\"") == 1u, svg);
  BOOST_TEST(count("V40.0H") == 0u, svg);
}

BOOST_AUTO_TEST_CASE(unknown_undriven_and_unset_differ) {
  const auto with = [](const std::string& value) {
    return plotted("t.p 1, t.w 4", "#0 " + value + "! b" + value + " \"\n#100\n", {"p", "w"},
                   100'000);
  };
  const std::string x = "#d55e00", z = "#b07d00", u = "#e4e4e4";
  const auto shows = [](const std::string& svg, const std::string& colour) {
    const auto first = svg.find(colour);
    return first != std::string::npos && svg.find(colour, first + 1) != std::string::npos;
  };
  BOOST_TEST((shows(with("x"), x) && !shows(with("x"), z) && !shows(with("x"), u)));
  BOOST_TEST((shows(with("z"), z) && !shows(with("z"), x) && !shows(with("z"), u)));
  BOOST_TEST((shows(with("u"), u) && !shows(with("u"), x) && !shows(with("u"), z)));
}

BOOST_AUTO_TEST_CASE(curves_have_a_scale_and_labels_stay_inside) {
  const std::string svg = plotted("t.r real", "#0 r-1.5 !\n#50 r12.25 !\n#100\n", {"r"}, 100'000);
  BOOST_TEST(svg.find(">12.25</text>") != std::string::npos);
  BOOST_TEST(svg.find(">-1.5</text>") != std::string::npos);
  BOOST_TEST(svg.find("x=\"1098.0\" y=\"16\" text-anchor=\"end\"") != std::string::npos, svg);
}

BOOST_AUTO_TEST_CASE(a_diagram_samples_before_the_edges) {
  const auto json = diagram(
      clocked({{6, "0\""}, {16, "1\"\nb1010 #"}, {26, "b1011 #"}, {36, "0\""}, {46, "z\""}}, 6), 0,
      60);
  BOOST_TEST(json["signal"][0]["wave"] == "p.....");
  BOOST_TEST(json["signal"][1]["wave"] == "x01.0z");
  BOOST_TEST(json["signal"][2]["wave"] == "z.==..");
  BOOST_TEST(json["signal"][2]["data"] == (std::vector<std::string>{"A", "B"}));
  BOOST_TEST(json["signal"][1]["name"] == "t.valid");
}

BOOST_AUTO_TEST_CASE(long_waits_are_a_gap) {
  const auto json = diagram(clocked({{6, "0\""}, {806, "1\""}}, 90), 10, 900);
  BOOST_TEST(json["signal"][0]["wave"] == "p...|....|");
  BOOST_TEST(json["signal"][1]["wave"] == "0...|1...|");
  const std::string why = complaint([] {
    std::map<unsigned, std::string> toggles;
    for (unsigned i = 0; i < 150; ++i) toggles[6 + i * 10] = i % 2 != 0 ? "1\"" : "0\"";
    diagram(clocked(toggles, 160), 0, 1600);
  });
  BOOST_TEST(why.find("more than 100 columns") != std::string::npos);
  BOOST_TEST(complaint([] { diagram(clocked({}, 3), 26, 30); }).find("has no edge in the window") !=
             std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
