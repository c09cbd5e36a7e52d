// What a trace says is what the simulation counted.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <set>
#include <sstream>
#include <vector>

#include "executable.h"

namespace {

using integration::Json;

// The software's stamps lie a reading of the timer beside the edges of the trace.
constexpr double stamp_us = 0.3;

struct Traced : integration::Workplace {
  kit::Outcome ask(const integration::Arguments& arguments) const {
    integration::Arguments all{"trace"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return kit::run_process(MARKERVP_EXECUTABLE, all, path());
  }
  void record(integration::Arguments arguments) const {
    arguments.insert(arguments.end(), {"-q", "--no-pictures", "--no-report", "--trace", "t.vcd"});
    BOOST_TEST_REQUIRE(run(arguments).exit_code == 0);
  }
  const integration::Arguments overflowing{"demo",
                                           "z0.5",
                                           "z1.0",
                                           "--set",
                                           "pl.feature_packaging.buffer_depth=2",
                                           "--set",
                                           "ps.m_axi_gp0.read_time=5 us"};
  const std::string checks = MARKERVP_SOURCE "/traces/checks/system.checks";
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(traces, Traced)

BOOST_AUTO_TEST_CASE(statistics_are_the_simulations_own_numbers_overflows_too) {
  record(overflowing);
  const kit::Outcome outcome = ask({"stats", "t.vcd", "--json"});
  BOOST_TEST_REQUIRE(outcome.exit_code == 0, outcome.err);
  const Json stats = Json::parse(outcome.out);
  const Json run = result();
  BOOST_TEST_REQUIRE(stats["frames"].size() == 3u);
  BOOST_TEST(run["frames"][0]["counts"]["feature_overflow"].get<int>() > 0);
  BOOST_TEST(run["frames"][2]["counts"]["feature_overflow"].get<int>() == 0);
  for (std::size_t i = 0; i < 3; ++i) {
    BOOST_TEST_CONTEXT("frame " << i) {
      const Json& counts = run["frames"][i]["counts"];
      BOOST_TEST(stats["frames"][i]["frame"] == i);
      for (const char* count : {"corners", "blobs", "feature_words", "feature_overflow",
                                "label_overflow", "bridge_overflow", "crossing_overflow"}) {
        BOOST_TEST(stats["frames"][i][count] == counts[count], count);
      }
      BOOST_TEST(stats["stages"][i]["frame"] == i);
      const Json& times = run["frames"][i]["time_us"];
      for (const char* stage :
           {"upload", "feature_extraction", "receive", "evaluation", "identification", "pose"}) {
        const double seen = stats["stages"][i][std::string(stage) + "_us"].get<double>();
        BOOST_TEST(std::abs(seen - times[stage].get<double>()) < stamp_us, stage);
      }
      const double latency = stats["stages"][i]["latency_us"].get<double>();
      BOOST_TEST(std::abs(latency - times["frame"].get<double>()) < stamp_us);
      BOOST_TEST(stats["frames"][i]["latency_us"].get<double>() == latency);
    }
  }
  BOOST_TEST(
      stats["summary"][0]["fps_mean"].get<double>() == run["summary"]["fps"]["mean"].get<double>(),
      boost::test_tools::tolerance(1e-4));
  BOOST_TEST(stats["links"][0]["beats"] == 3 * 640 * 480 / 4);
  BOOST_TEST(stats["links"][0]["packets"] == 3 * 2400);
  BOOST_TEST(stats["links"][1]["beats"] == 3 * 640 * 480 / 32);
  BOOST_TEST(stats["links"][1]["packets"] == 3 * 300);
}

BOOST_AUTO_TEST_CASE(our_checks_pass_and_say_where_something_is_lost) {
  record({"z1.0"});
  const kit::Outcome good = ask({"check", checks, "t.vcd"});
  BOOST_TEST(good.exit_code == 0, good.out);
  record(overflowing);
  const kit::Outcome bad = ask({"check", checks, "t.vcd"});
  BOOST_TEST(bad.exit_code == 1);
  BOOST_TEST(bad.out.find("FAIL no_feature_lost at ") != std::string::npos);
  BOOST_TEST(kit::read_file(*this / "t.vcd.failed.gtkw").find("feature_overflow[31:0]") !=
             std::string::npos);
}

BOOST_AUTO_TEST_CASE(each_check_that_fails_has_a_page_with_what_is_around_it) {
  kit::write_file(*this / "t.vcd",
                  "$timescale 10ns $end\n$scope module top $end\n$var wire 1 c clk $end\n"
                  "$scope module a $end\n$var wire 1 ! x $end\n$var wire 8 n fill_level $end\n"
                  "$var wire 1 o other $end\n$upscope $end\n$scope module b $end\n"
                  "$var wire 1 y y $end\n$upscope $end\n$upscope $end\n$enddefinitions $end\n"
                  "#0 0c 0! b0 n 0o 0y #5 1c #10 0c 1y #20 1!\n#30 1c\n");
  kit::write_file(*this / "t.checks", "late: never top.a.x\nearly: never top.b.y\n");
  const kit::Outcome outcome = ask({"check", "t.checks", "t.vcd"});
  BOOST_TEST(outcome.exit_code == 1, outcome.err);
  BOOST_TEST(kit::read_file(*this / "t.vcd.failed.gtkw").find("early: ") != std::string::npos);
  BOOST_TEST(kit::read_file(*this / "t.vcd.failed.sucl") ==
             "divider_add Check\nvariable_add top.b.y\ndivider_add Clock\nvariable_add top.clk\n"
             "cursor_set 10\ngoto_cursor\n");
  BOOST_TEST(kit::read_file(*this / "t.vcd.failed.vaporview.json").find("\"markerTime\": 10,") !=
             std::string::npos);
  BOOST_TEST(kit::read_file(*this / "t.vcd.failed.late.sucl") ==
             "divider_add Check\nvariable_add top.a.x\ndivider_add Clock\nvariable_add top.clk\n"
             "divider_add Buffers\nvariable_add top.a.fill_level\n"
             "divider_add Beside\nvariable_add top.a.other\ncursor_set 20\ngoto_cursor\n");
}

BOOST_AUTO_TEST_CASE(pages_of_similar_names_stay_apart_and_lie_where_it_is_said) {
  kit::write_file(*this / "t.vcd",
                  "$timescale 10ns $end\n$var wire 1 ! x $end\n$enddefinitions $end\n"
                  "#0 0! #10 1! #20 0!\n");
  kit::write_file(*this / "t.checks", "first: never x == 0\na b: never x\na_b: never x rises\n");
  std::filesystem::create_directory(*this / "sub");
  const kit::Outcome outcome = ask({"check", "t.checks", "t.vcd", "-o", "sub/p.sucl"});
  BOOST_TEST(outcome.exit_code == 1, outcome.err);
  BOOST_TEST(outcome.out.find("the others have pages of their own: sub/p.CHECK.gtkw\n") !=
             std::string::npos);
  const std::array<std::string, 3> names{"sub/p", "sub/p.a_b", "sub/p.a_b_2"};
  const std::array<std::string, 3> checks_of{"first: ", "a b: ", "a_b: "};
  for (std::size_t i = 0; i < names.size(); ++i) {
    BOOST_TEST(kit::read_file(*this / (names[i] + ".gtkw")).find(checks_of[i]) !=
               std::string::npos);
    BOOST_TEST(kit::read_file(*this / (names[i] + ".sucl")).find("divider_add Check") == 0u);
  }
}

BOOST_AUTO_TEST_CASE(a_page_takes_a_moment_and_no_clock) {
  kit::write_file(*this / "t.vcd",
                  "$timescale 10ns $end\n$var wire 1 ! x $end\n$enddefinitions $end\n"
                  "#0 0! #10 1! #20 0!\n");
  const kit::Outcome page = ask({"plot", "t.vcd", "--marker", "100ns", "-o", "t.html"});
  BOOST_TEST_REQUIRE(page.exit_code == 0, page.err);
  BOOST_TEST(kit::read_file(*this / "t.html").find("\"cursor\":100000") != std::string::npos);
  const kit::Outcome refused = ask({"plot", "t.vcd", "x", "--every", "x", "-o", "u.html"});
  BOOST_TEST(refused.exit_code == 2);
  BOOST_TEST(refused.err.find("--every makes a timing diagram") != std::string::npos);
  BOOST_TEST(!std::filesystem::exists(*this / "u.html"));
  const kit::Outcome alone = ask({"view", "t.vcd", "--at", "100ns", "--port", "1"});
  BOOST_TEST(alone.exit_code == 2);
  BOOST_TEST(alone.err.find("no viewer listens on port 1") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_run_does_not_differ_from_itself_but_from_another) {
  record({"z1.0", "--trace-filter", "pl.feature_packaging"});
  std::filesystem::rename(*this / "t.vcd", *this / "a.vcd");
  record({"z1.0", "--trace-filter", "pl.feature_packaging"});
  BOOST_TEST(ask({"diff", "a.vcd", "t.vcd"}).exit_code == 0);
  record({"demo", "--trace-filter", "pl.feature_packaging"});
  BOOST_TEST(ask({"diff", "a.vcd", "t.vcd"}).exit_code == 1);
}

BOOST_AUTO_TEST_CASE(a_trace_converted_and_back_is_the_same) {
  record({"z1.0", "--trace-level", "everything", "--trace-window", "7ms:8ms"});
  for (const char* other : {"u.vcd", "t.fst"}) {
    const kit::Outcome converted = ask({"convert", "t.vcd", other});
    BOOST_TEST(converted.exit_code == 0, converted.err);
    BOOST_TEST(ask({"diff", "t.vcd", other}).exit_code == 0);
    BOOST_TEST(ask({"convert", other, "back.vcd"}).exit_code == 0);
    BOOST_TEST(ask({"diff", "t.vcd", "back.vcd"}).exit_code == 0);
    BOOST_TEST(ask({"stats", "t.vcd", "--csv"}).out == ask({"stats", "back.vcd", "--csv"}).out);
  }
}

// A simulator that was killed leaves an empty last block, and the names beside the file.
BOOST_AUTO_TEST_CASE(a_file_that_was_not_finished_is_read_with_a_warning) {
  using namespace std::string_literals;
  kit::write_file(*this / "one.vcd",
                  "$timescale 1ps $end $var wire 1 ! flag $end $enddefinitions $end #0 0! #5 1! ");
  BOOST_TEST(ask({"convert", "one.vcd", "one.fst"}).exit_code == 0);
  BOOST_TEST(ask({"list", "one.fst"}).err.empty());
  std::string bytes = kit::read_file(*this / "one.fst");
  constexpr std::size_t block = 330;
  std::size_t length = 0;
  for (std::size_t i = 1; i < 9; ++i) {
    length = length << 8 | static_cast<unsigned char>(bytes[block + i]);
  }
  bytes.resize(block + 1 + length);
  kit::write_file(*this / "cut.fst", bytes + '\xff' + std::string(8, '\0'));
  const kit::Outcome nameless = ask({"list", "cut.fst"});
  BOOST_TEST(nameless.exit_code == 2);
  BOOST_TEST(nameless.err.find("its names are missing") != std::string::npos, nameless.err);
  kit::write_file(*this / "cut.fst.hier", "\x10\0flag\0\x01\0"s);
  const kit::Outcome outcome = ask({"diff", "one.fst", "cut.fst"});
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  BOOST_TEST(outcome.err.find("warning: trace 'cut.fst': was not finished") != std::string::npos,
             outcome.err);
}

// A trace from before the first frame: most checks find nothing to look at, which is no pass.
BOOST_AUTO_TEST_CASE(checks_that_look_at_nothing_are_counted_apart) {
  record({"z1.0", "--trace-window", "100us:101us"});
  const kit::Outcome outcome = ask({"check", checks, "t.vcd"});
  BOOST_TEST(outcome.exit_code == 0, outcome.out);
  BOOST_TEST(outcome.out.find("NOT EXERCISED end_word_before_result: at ps.cpu.results rises ") !=
                 std::string::npos,
             outcome.out);
  BOOST_TEST(outcome.out.find("PASS end_word_before_result") == std::string::npos);
  BOOST_TEST(outcome.out.find(" passed, 0 failed, ") != std::string::npos, outcome.out);
  BOOST_TEST(outcome.out.find(" not exercised\n") != std::string::npos, outcome.out);
  BOOST_TEST(ask({"check", checks, "t.vcd", "--require-exercised"}).exit_code == 1);
  kit::write_file(*this / "one.checks", "one: never pl.feature_packaging.feature_overflow > 0\n");
  const kit::Outcome good = ask({"check", "one.checks", "t.vcd", "--require-exercised"});
  BOOST_TEST(good.exit_code == 0, good.out);
  BOOST_TEST(good.out.find("1 passed, 0 failed\n") != std::string::npos, good.out);
  kit::write_file(*this / "two.checks",
                  "one: never pl.feature_packaging.feature_overflow > 0\ntwo: never nowhere\n");
  BOOST_TEST(ask({"check", "two.checks", "t.vcd", "--skip-missing"}).exit_code == 0);
  BOOST_TEST(
      ask({"check", "two.checks", "t.vcd", "--skip-missing", "--require-exercised"}).exit_code ==
      1);
}

BOOST_AUTO_TEST_CASE(a_trace_that_holds_nothing_is_not_said_to_be_written) {
  for (const integration::Arguments& nothing :
       {integration::Arguments{"--trace-window", "2s:3s"},
        integration::Arguments{"--trace-trigger", "ps.cpu.frame == 77"}}) {
    integration::Arguments arguments{"z1.0", "--no-pictures", "--trace", "t.vcd"};
    arguments.insert(arguments.end(), nothing.begin(), nothing.end());
    const kit::Outcome outcome = run(arguments);
    BOOST_TEST(outcome.exit_code == 0, outcome.err);
    BOOST_TEST(outcome.out.find("wrote out/result.json") != std::string::npos, outcome.out);
    BOOST_TEST(outcome.out.find("t.vcd") == std::string::npos, outcome.out);
    BOOST_TEST(outcome.err.find("no trace 't.vcd'") != std::string::npos, outcome.err);
    BOOST_TEST(!std::filesystem::exists(*this / "t.vcd"));
  }
  const kit::Outcome outcome =
      run({"z1.0", "--no-pictures", "--trace", "t.vcd", "--trace-window", "1us:2us"});
  BOOST_TEST(outcome.out.find(", t.vcd\n") != std::string::npos, outcome.out);
}

/// Pixels of one colour in a PNG, by red, green, blue.
std::size_t pixels_of(const std::string& file, const std::array<int, 3>& colour) {
  const cv::Mat picture = cv::imread(file, cv::IMREAD_COLOR);
  std::size_t count = 0;
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      const auto& pixel = picture.at<cv::Vec3b>(y, x);
      count += pixel[2] == colour[0] && pixel[1] == colour[1] && pixel[0] == colour[2];
    }
  }
  return count;
}

constexpr std::array<int, 3> wave_green = {0, 255, 0}, dark_blue = {0, 0, 139},
                             dark_green = {0, 100, 0}, dark_red = {139, 0, 0};

bool has_display() {
  return std::filesystem::exists("/usr/bin/xvfb-run");
}

/// The signals of a VCD file that change after the first instant.
std::set<std::string> moving(const std::string& file) {
  std::istringstream lines(kit::read_file(file));
  std::map<std::string, std::string> paths;  // by code
  std::map<std::string, int> changes;
  std::vector<std::string> scopes;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string first, kind, width, code, name;
    words >> first;
    if (first == "$scope") {
      words >> kind >> name;
      scopes.push_back(name);
    } else if (first == "$upscope") {
      scopes.pop_back();
    } else if (first == "$var") {
      words >> kind >> width >> code >> name;
      for (auto scope = scopes.rbegin(); scope != scopes.rend(); ++scope)
        name = *scope + "." + name;
      paths[code] = name;
    } else if (!first.empty() && first[0] != '#' && first[0] != '$') {
      const bool vector = (words >> code) && true;
      ++changes[vector ? code : first.substr(1)];
    }
  }
  std::set<std::string> moved;
  for (const auto& [code, path] : paths) {
    if (changes[code] > 1) moved.insert(path);
  }
  return moved;
}

BOOST_AUTO_TEST_CASE(a_run_says_which_fidelity_a_trace_chose_and_what_tlm_does_not_play) {
  const auto said = [&](const std::string& file, integration::Arguments more) {
    more.insert(more.begin(), {"demo", "-q", "--no-pictures", "--no-report", "--trace", file});
    const kit::Outcome outcome = run(more);
    BOOST_TEST(outcome.exit_code == 0, outcome.err);
    return outcome.out;
  };
  const std::string chose = "--trace chose fidelity clocked";
  BOOST_TEST(said("c.vcd", {}).find(chose) != std::string::npos);
  const std::string asked = said("a.vcd", {"--fidelity", "clocked", "--trace-window", "0us:1us"});
  BOOST_TEST(asked.find("fidelity clocked") == std::string::npos, asked);
  const std::string tlm = said("t.vcd", {"--fidelity", "tlm"});
  BOOST_TEST(tlm.find("fidelity tlm does not play pl.sensor_input.pixel, .pixel_x, .pixel_y, "
                      "pl.image_stream.*, pl.global_threshold.thresh_*, .binary_*, "
                      "pl.clock_crossing.binary.*, pl.axi_threshold_bridge.thresh_seen, "
                      ".fifo_count, pl.binary_stream.*, pl.always: --fidelity clocked does") !=
                 std::string::npos,
             tlm);
  const std::set<std::string> clocked = moving(*this / "c.vcd"), frames = moving(*this / "t.vcd");
  std::set<std::string> still;
  std::set_difference(clocked.begin(), clocked.end(), frames.begin(), frames.end(),
                      std::inserter(still, still.end()));
  const std::set<std::string> expected{"pl.axi_threshold_bridge.fifo_count",
                                       "pl.axi_threshold_bridge.thresh_seen",
                                       "pl.binary_stream.tdata",
                                       "pl.binary_stream.tlast",
                                       "pl.binary_stream.tvalid",
                                       "pl.clock_crossing.binary.toggle",
                                       "pl.clock_crossing.binary.word",
                                       "pl.global_threshold.binary_out",
                                       "pl.global_threshold.binary_x",
                                       "pl.global_threshold.binary_y",
                                       "pl.global_threshold.thresh_data",
                                       "pl.global_threshold.thresh_out",
                                       "pl.image_stream.tdata",
                                       "pl.image_stream.tlast",
                                       "pl.image_stream.tvalid",
                                       "pl.sensor_input.pixel",
                                       "pl.sensor_input.pixel_x",
                                       "pl.sensor_input.pixel_y"};
  BOOST_TEST(still == expected, boost::test_tools::per_element());
}

// What GTKWave itself says of the pages as they open.
BOOST_AUTO_TEST_CASE(gtkwave_opens_where_there_is_something_to_see,
                     *boost::unit_test::precondition([](boost::unit_test::test_unit_id) {
                       return has_display();
                     })) {
  record({"z1.0", "--trace-window", "7995us:8005us"});
  const auto opens_on = [&](const std::string& trace, const std::string& page) {
    kit::write_file(*this / "p.tcl",
                    "set f [open shown w]\nputs $f \"[gtkwave::getWindowStartTime] "
                    "[gtkwave::getWindowEndTime] [gtkwave::getMarker]\"\nclose $f\n"
                    "gtkwave::/File/Quit\n");
    kit::run_process("/usr/bin/xvfb-run",
                     {"-a", "-s", "-screen 0 1400x900x24", "gtkwave", "-S", "p.tcl", trace, page},
                     path());
    std::istringstream shown(kit::read_file(*this / "shown"));
    std::array<double, 3> times{};
    for (double& time : times) shown >> time;
    BOOST_TEST_REQUIRE(!shown.fail());
    return times;
  };
  BOOST_TEST_REQUIRE(ask({"gtkw", "t.vcd"}).exit_code == 0);
  const auto whole = opens_on("t.vcd", "t.vcd.gtkwave/system.gtkw");
  BOOST_TEST(whole[0] == 7995e6);
  BOOST_TEST(whole[1] > 8004e6, "the whole trace");

  // Traces of other tools count in other units: GTKWave's times are in ps, ns and ns.
  kit::write_file(*this / "n.checks", "n: never pl.n == 20\n");
  const struct {
    const char* timescale;
    const char *fails, *ends;
    double us;
  } traces[] = {{"1ps", "#8000000000", "#9000000000", 1e6},
                {"1ns", "#8000000", "#9000000", 1e3},
                {"10ns", "#800000", "#900000", 1e3}};
  for (const auto& t : traces) {
    BOOST_TEST_CONTEXT(t.timescale) {
      kit::write_file(*this / "n.vcd",
                      std::string("$timescale ") + t.timescale +
                          " $end\n$scope module pl $end\n$var wire 10 ! n $end\n$upscope $end\n"
                          "$enddefinitions $end\n#0\nb0 !\n" +
                          t.fails + "\nb10100 !\n" + t.ends + "\n");
      BOOST_TEST_REQUIRE(ask({"check", "n.checks", "n.vcd"}).exit_code == 1);
      const auto failed = opens_on("n.vcd", "n.vcd.failed.gtkw");
      BOOST_TEST(failed[2] == 8000 * t.us);
      BOOST_TEST(failed[0] < failed[2] - 0.9 * t.us, "100 clocks before the marker");
      BOOST_TEST(failed[1] > failed[2] + 0.9 * t.us, "and after it");
      BOOST_TEST(failed[1] - failed[0] < 3 * t.us);
    }
  }
}

// Around the instant at which two corners arrive and a packet's interrupt is served. The boxes in
// colours come from the translate files: function, feature, interrupt.
BOOST_AUTO_TEST_CASE(gtkwave_shows_our_page_with_names_in_place_of_numbers,
                     *boost::unit_test::precondition([](boost::unit_test::test_unit_id) {
                       return has_display();
                     })) {
  record({"z1.0", "--trace-window", "7995us:8005us"});
  BOOST_TEST(ask({"gtkw", "t.vcd", "-o", "out/pages"}).exit_code == 0);
  const auto grab = [&](const std::string& name) {
    kit::write_file(*this / "p.tcl", "gtkwave::/Time/Zoom/Zoom_Full\ngtkwave::/File/Grab_To_File " +
                                         name +
                                         "\nset f [open shown w]\n"
                                         "puts $f [gtkwave::getDisplayedSignals]\nclose $f\n"
                                         "gtkwave::/File/Quit\n");
    kit::run_process("/usr/bin/xvfb-run",
                     {"-a", "-s", "-screen 0 1400x900x24", "gtkwave", "-S", "p.tcl", "t.vcd",
                      "out/pages/system.gtkw"},
                     path());
    return *this / name;
  };
  const std::string picture = grab("p.png");
  const std::string shown = kit::read_file(*this / "shown");
  for (const char* name : {"ps.cpu.function_name", "ps.gic.active", "feature_overflow"}) {
    BOOST_TEST(shown.find(name) != std::string::npos, name);
  }
  BOOST_TEST(pixels_of(picture, wave_green) > 20'000u);
  BOOST_TEST(pixels_of(picture, dark_blue) > 10'000u, "function and features");
  BOOST_TEST(pixels_of(picture, dark_green) > 300u, "the handler's function");
  BOOST_TEST(pixels_of(picture, dark_red) > 300u, "the interrupt");
  for (const char* file : {"function.flt", "feature.flt", "interrupt.flt"}) {
    std::filesystem::remove(*this / ("out/pages/" + std::string(file)));
  }
  const std::string without = grab("w.png");
  BOOST_TEST(pixels_of(without, wave_green) > 20'000u);
  BOOST_TEST(pixels_of(without, dark_blue) == 0u);
}

BOOST_AUTO_TEST_SUITE_END()
