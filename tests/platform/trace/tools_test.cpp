// diff, cut, SAIF, plot, names and save files.
#include <boost/test/unit_test.hpp>

#include <marker/designs/marker/marker_design.h>
#include <trace/tools.h>
#include <vp/wave_writer.h>
#include <nlohmann/json.hpp>

#include "waves.h"

using namespace platform::trace;

BOOST_AUTO_TEST_SUITE(tools)

namespace {

const std::string signals = "ps.cpu.frame 8, pl.x 8, pl.y 1";

Difference compare(const std::string& a, const std::string& b, bool by_frame = false) {
  const Waves left(signals, a), right(signals, b);
  TraceFile left_file(left.file), right_file(right.file);
  DifferenceOptions options;
  options.by_frame = by_frame;
  return difference(left_file, right_file, options);
}

}  // namespace

BOOST_AUTO_TEST_CASE(equal_traces_do_not_differ) {
  const std::string a = "#0 b0 ! b0 \" 0#\n#10 b1 !\n#20 b101 \"\n";
  BOOST_TEST(!compare(a, a).differ);
  BOOST_TEST(!compare(a, "#0 b0 ! b0000 \" 0#\n#10 b1 !\n#15 0#\n#20 b00000101 \"\n").differ,
             "zeros in front and values written again are no difference");
}

// The same runs have the same bits.
BOOST_AUTO_TEST_CASE(reals_differ_by_their_last_digit) {
  const auto differ = [](const std::string& a, const std::string& b) {
    const Waves left("ps.cpu.frame 8, power real", "#0 b0 ! r0 \"\n#10 r" + a + " \"\n");
    const Waves right("ps.cpu.frame 8, power real", "#0 b0 ! r0 \"\n#10 r" + b + " \"\n");
    TraceFile left_file(left.file), right_file(right.file);
    return difference(left_file, right_file, {}).differ;
  };
  BOOST_TEST(differ("0.1", "0.10000000000000002"));
  BOOST_TEST(differ("1000", "1000.0000000000001"));
  BOOST_TEST(!differ("0.1", "0.1"));
  BOOST_TEST(!differ("1", "1.0"), "the same number, written otherwise");
  BOOST_TEST(!differ("25e-1", "2.5"));
  BOOST_TEST(differ("nan", "0"));
}

BOOST_AUTO_TEST_CASE(the_first_difference_and_what_is_around_it) {
  const Difference d = compare("#0 b0 ! b0 \" 0#\n#10 b1 \"\n#20 b10 \"\n#30 b11 \"\n",
                               "#0 b0 ! b0 \" 0#\n#10 b1 \"\n#20 b100 \"\n#30 1#\n");
  BOOST_TEST(d.differ);
  BOOST_TEST(d.a_ps == 20'000u);
  BOOST_TEST(d.values.size() == 1u);
  BOOST_TEST(d.values[0].path == "pl.x");
  BOOST_TEST(d.values[0].in_a == "2");
  BOOST_TEST(d.values[0].in_b == "4");
  BOOST_TEST(d.a_before.back().value == "2");
  BOOST_TEST(d.a_after.front().ps == 30'000u);
  BOOST_TEST(d.b_after.front().path == "pl.y");
}

BOOST_AUTO_TEST_CASE(frames_are_aligned_whenever_they_begin) {
  const std::string a = "#0 b0 ! b0 \" 0#\n#10 b1 !\n#15 b1 \"\n#20 b10 !\n#27 b11 \"\n";
  const std::string later = "#0 b0 ! b0 \" 0#\n#100 b1 !\n#105 b1 \"\n#130 b10 !\n#137 b11 \"\n";
  BOOST_TEST(compare(a, later).differ);
  BOOST_TEST(!compare(a, later, true).differ);
  const Difference d =
      compare(a, "#0 b0 ! b0 \" 0#\n#100 b1 !\n#105 b1 \"\n#130 b10 !\n#138 b11 \"\n#140\n", true);
  BOOST_TEST(d.differ);
  BOOST_TEST(d.frame == 2u);
  BOOST_TEST(d.in_frame_ps == 7'000u);
  BOOST_TEST(d.a_ps == 27'000u);
  BOOST_TEST(d.b_ps == 137'000u);
}

BOOST_AUTO_TEST_CASE(traces_without_common_signals_are_refused) {
  const Waves a("x 1", "#0 0!\n"), b("y 1", "#0 0!\n");
  TraceFile left(a.file), right(b.file);
  BOOST_TEST(complaint([&] { difference(left, right); }).find("no signal in common") !=
             std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_part_has_the_values_that_stood_before_it) {
  const Waves waves(signals, "#0 b1 ! b10 \"\n#10 b11 \"\n#20 b100 \"\n#30 1#\n#40\n");
  for (const char* name : {"part.vcd", "part.fst"}) {
    TraceFile file(waves.file);
    CutOptions options;
    options.from_ps = 15'000;
    options.to_ps = 30'000;
    options.filter = vp::TraceFilter({"pl.**"});
    cut(file, waves / name, options);
    TraceFile part(waves / name);
    BOOST_TEST(part.paths().size() == 2u);
    BOOST_TEST(part.find("ps.cpu.frame") == -1);
    struct Reader : vp::WaveHandler {
      bool at(std::uint64_t ps) override {
        now = ps;
        return true;
      }
      void change(std::uint32_t net, const vp::WaveValue& value) override {
        if (net == 0) text += std::to_string(now) + ":" + std::to_string(value.bits) + " ";
        if (net == 1) known = known || value.known;
      }
      std::uint64_t now = 0;
      std::string text;
      bool known = false;
    } reader;
    part.reader().select_all();
    part.reader().read(reader);
    BOOST_TEST(reader.text == "15000:3 20000:4 ");
    BOOST_TEST(part.reader().now_ps() == 30'000u);
  }
  TraceFile file(waves.file);
  CutOptions late;
  late.from_ps = 1'000'000;
  BOOST_TEST(complaint([&] { cut(file, waves / "late.vcd", late); }).find("before the window") !=
             std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_conversion_invents_no_value) {
  const Waves waves("pl.x 8, pl.bit 1", "#0\n#10 bXX !\n#20 X\"\n#30 b1 !\n#40\n");
  TraceFile file(waves.file);
  cut(file, waves / "all.vcd");
  const std::string written = kit::read_file(waves / "all.vcd");
  BOOST_TEST(written.substr(written.find("#0")) ==
             "#0\n$dumpvars\n$end\n#10000\nbxx !\n#20000\nx\"\n#30000\nb1 !\n#40000\n");
}

// A trace that begins late, with a text that says nothing at first.
BOOST_AUTO_TEST_CASE(a_part_of_a_window_begins_where_the_window_began) {
  const Waves waves("pl.x 8, ps.text string", "#70 b1 !\n#80 sone \"\n#90 b11 !\n#95\n");
  TraceFile file(waves.file);
  cut(file, waves / "all.vcd");
  TraceFile again(waves.file), all(waves / "all.vcd");
  BOOST_TEST(!difference(again, all).differ);
  struct First : vp::WaveHandler {
    bool at(std::uint64_t ps) override {
      now = ps;
      return false;
    }
    void change(std::uint32_t, const vp::WaveValue&) override {}
    std::uint64_t now = 0;
  } first;
  TraceFile once_more(waves / "all.vcd");
  once_more.reader().select_all();
  once_more.reader().read(first);
  BOOST_TEST(first.now == 70'000u);
  TraceFile early(waves.file);
  CutOptions options;
  options.to_ps = 60'000;
  BOOST_TEST(complaint([&] {
               cut(early, waves / "none.vcd", options);
             }).find("has nothing before 60 ns") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(saif_tells_how_long_each_bit_has_which_value_and_how_often_it_turns) {
  const Waves waves("top.clk 1, top.core.word 2, top.core.note string, top.gen[0].q 1",
                    "#0 0! b0x \" z$\n#10 1! b01 \"\n#20 0! b10 \" 1$\n#25 b0 \"\n#30\n");
  TraceFile file(waves.file);
  BOOST_TEST(write_saif(file, waves / "all.saif") == 4u);
  const std::string head =
      "(SAIFILE\n(SAIFVERSION \"2.0\")\n(DIRECTION \"backward\")\n(DESIGN )\n"
      "(PROGRAM_NAME \"markervp\")\n(DIVIDER / )\n(TIMESCALE 1 ps)\n";
  BOOST_TEST(kit::read_file(waves / "all.saif") ==
             head +
                 "(DURATION 30000)\n(INSTANCE top\n(NET\n"
                 "(clk (T0 20000) (T1 10000) (TX 0) (TZ 0) (TC 2) (IG 0))\n)\n"
                 "(INSTANCE core\n(NET\n"
                 "(word\\[1\\] (T0 25000) (T1 5000) (TX 0) (TZ 0) (TC 2) (IG 0))\n"
                 "(word\\[0\\] (T0 10000) (T1 10000) (TX 10000) (TZ 0) (TC 1) (IG 0))\n)\n)\n"
                 "(INSTANCE gen\\[0\\]\n(NET\n"
                 "(q (T0 0) (T1 10000) (TX 0) (TZ 20000) (TC 0) (IG 0))\n)\n)\n)\n)\n");

  TraceFile again(waves.file);
  CutOptions part;
  part.from_ps = 15'000;  // the bit was 1 for 5 ns then, and turns at 20 ns
  part.to_ps = 25'000;    // what happens in that instant is not in the window
  part.filter = vp::TraceFilter({"**.word"});
  BOOST_TEST(write_saif(again, waves / "part.saif", part) == 2u);
  BOOST_TEST(kit::read_file(waves / "part.saif") ==
             head +
                 "(DURATION 10000)\n(INSTANCE top\n(INSTANCE core\n(NET\n"
                 "(word\\[1\\] (T0 5000) (T1 5000) (TX 0) (TZ 0) (TC 1) (IG 0))\n"
                 "(word\\[0\\] (T0 5000) (T1 5000) (TX 0) (TZ 0) (TC 1) (IG 0))\n"
                 ")\n)\n)\n)\n");
}

BOOST_AUTO_TEST_CASE(saif_of_femtoseconds_counts_them_and_what_has_no_scope_is_refused) {
  const Waves waves("top.q 1, lone 1", "#0 0! 0\"\n#500 1!\n#1500\n", "1fs");
  const auto problem = [&](const CutOptions& options) {
    TraceFile file(waves.file);
    return complaint([&] { write_saif(file, waves / "t.saif", options); });
  };
  CutOptions options;
  BOOST_TEST(problem(options).find("'lone' is in no scope") != std::string::npos);
  options.filter = vp::TraceFilter({"top.**"});
  BOOST_TEST(problem(options) == "");
  const std::string text = kit::read_file(waves / "t.saif");
  BOOST_TEST(text.find("(TIMESCALE 1 fs)\n(DURATION 1500)") != std::string::npos, text);
  BOOST_TEST(text.find("(q (T0 500) (T1 1000) (TX 0) (TZ 0) (TC 1)") != std::string::npos, text);
  options.from_ps = 1;
  options.to_ps = 1;
  BOOST_TEST(problem(options) != "");
  const Waves still("top.q 1", "#0 0!\n");
  TraceFile file(still.file);
  BOOST_TEST(complaint([&] { write_saif(file, still / "t.saif"); }).find("no duration") !=
             std::string::npos);
}

BOOST_AUTO_TEST_CASE(names_of_others_become_ours) {
  const Waves waves("ila.slot_0_tvalid 1, ila.slot_0_tready 1", "#0 0! 0\"\n");
  kit::write_file(
      waves / "m.map",
      "# ours = theirs\npl.s.tvalid = ila.slot_0_tvalid\npl.s.tready = slot_0_tready\n");
  const TraceFile file(waves.file, read_name_map(waves / "m.map"));
  BOOST_TEST(file.find("pl.s.tvalid") == 0);
  BOOST_TEST(file.find("pl.s.tready") == 1);
  const auto refused = [&](const std::string& text) {
    kit::write_file(waves / "m.map", text);
    return complaint([&] { TraceFile(waves.file, read_name_map(waves / "m.map")); });
  };
  BOOST_TEST(refused("a = slot_0_tvald\n").find("line 1: in '") != std::string::npos);
  BOOST_TEST(refused("a = slot_0_tvald\n").find("did you mean 'ila.slot_0_tvalid'") !=
             std::string::npos);
  BOOST_TEST(refused("\na\n").find("line 2: 'a' should be 'ours = theirs'") != std::string::npos);
  BOOST_TEST(refused("a = slot_0_tvalid\na = slot_0_tready\n").find("line 1 already") !=
             std::string::npos);
  BOOST_TEST(complaint([&] { read_name_map(waves / "none.map"); }).find("cannot read map") == 0u);
}

BOOST_AUTO_TEST_CASE(a_plot_shows_names_values_and_what_is_unknown) {
  const Waves waves("pl.flag 1, pl.word 16, ps.text string",
                    "#0 0! b11111111 \" sone<two #\n#40 1! bx \"\n#80 0! b1 \"\n#100\n");
  TraceFile file(waves.file);
  PlotOptions options;
  options.signals = {"flag", "pl.word", "text"};
  options.to_ps = 100'000;
  options.marker_ps = 40'000;
  const std::string svg = plot_as_svg(file, options);
  for (const char* part : {"pl.flag", ">FF<", "one&lt;two", "#f3d4c4", "#d55e00", "40 ns"}) {
    BOOST_TEST(svg.find(part) != std::string::npos, part);
  }
}

/// The line of a save file with this beginning.
std::string line_of(const std::string& page, const std::string& begin) {
  const auto at = page.find("\n" + begin);
  return at == std::string::npos ? "" : page.substr(at + 1, page.find('\n', at + 1) - at - 1);
}

// GTKWave's zoom is -log2 of the time that 200 pixels show; 840 pixels show waves here.
BOOST_AUTO_TEST_CASE(a_save_file_opens_on_its_window) {
  SaveFile page;
  page.start_ps = 1'000'000;
  page.end_ps = page.start_ps + 840 * 1024;
  page.marker_ps = 1'500'000;
  const std::string text = save_file_text(page);
  BOOST_TEST(line_of(text, "[timestart]") == "[timestart] 1000000");
  BOOST_TEST(line_of(text, "*").find("*-17.643856 1500000 -1 -1") == 0u, line_of(text, "*"));
  page.marker_ps.reset();
  BOOST_TEST(line_of(save_file_text(page), "*").find("*-17.643856 -1 -1 -1") == 0u);
  page.end_ps = page.start_ps;
  BOOST_TEST(line_of(save_file_text(page), "*").find("*2.0") == 0u, "as near as one step");
}

// Its numbers are in the unit that the trace counts in; 100 ps are ps, too.
BOOST_AUTO_TEST_CASE(a_save_file_counts_as_its_trace) {
  const struct {
    std::uint64_t timescale_fs;
    const char *start, *zoom;
  } cases[] = {{1, "[timestart] 1000000000", "*-27.609640 1500000000 "},
               {1'000, "[timestart] 1000000", "*-17.643856 1500000 "},
               {100'000, "[timestart] 1000000", "*-17.643856 1500000 "},
               {1'000'000, "[timestart] 1000", "*-7.678072 1500 "},
               {10'000'000, "[timestart] 1000", "*-7.678072 1500 "}};
  for (const auto& c : cases) {
    SaveFile page;
    page.start_ps = 1'000'000;
    page.end_ps = page.start_ps + 840 * 1024;
    page.marker_ps = 1'500'000;
    page.timescale_fs = c.timescale_fs;
    const std::string text = save_file_text(page);
    BOOST_TEST(line_of(text, "[timestart]") == c.start);
    BOOST_TEST(line_of(text, "*").find(c.zoom) == 0u, line_of(text, "*"));
  }
}

BOOST_AUTO_TEST_CASE(a_page_becomes_settings_of_vaporview) {
  SaveFile page;
  page.lines.resize(4);
  page.lines[0].path = "top.alone";
  page.lines[0].width = page.lines[3].width = 8;
  page.lines[1].path = "Group";
  page.lines[1].title = true;
  page.lines[2].path = "top.bit";
  page.lines[3].path = "top.count";
  page.lines[3].decimal = true;
  page.marker_ps = 1'500'000;
  page.timescale_fs = 1'000'000;
  BOOST_TEST(nlohmann::json::parse(vaporview_settings(page)) == nlohmann::json::parse(R"({
    "markerTime": 1500,
    "displayedSignals": [
      {"dataType": "netlist-variable", "name": "top.alone", "numberFormat": "hexadecimal"},
      {"dataType": "signal-group", "groupName": "Group", "children": [
        {"dataType": "netlist-variable", "name": "top.bit"},
        {"dataType": "netlist-variable", "name": "top.count", "numberFormat": "decimal"}]}]})"));
  page.marker_ps.reset();
  BOOST_TEST(!nlohmann::json::parse(vaporview_settings(page)).contains("markerTime"));
}

BOOST_AUTO_TEST_CASE(save_files_name_signals_that_are_there) {
  const Waves waves(
      "ps.cpu.function 32, ps.cpu.function_name string, ps.gic.active 10, "
      "pl.corner_detection.corner_out 1, pl.corner_detection.corner_data 32",
      "#0 b0 ! s \" b1 # 0$ b0 %\n#10 b11 ! swork \" b10000000010100000000110000000111 %\n"
      "#20 b11111111111111111111111111111111 %\n#21 b01000000000010000000110000000111 %\n#30\n");
  TraceFile file(waves.file);
  const kit::TemporaryFolder folder;
  write_save_files(file, platform::marker_words(), folder.path());
  const std::string system = kit::read_file(folder / "system.gtkw");
  BOOST_TEST(system.find("@2022\n^1 " + (folder / "function.flt") + "\nps.cpu.function[31:0]\n") !=
             std::string::npos);
  BOOST_TEST(system.find("pl.corner_detection.corner_out\n") != std::string::npos);
  BOOST_TEST(system.find("tvalid") == std::string::npos);
  BOOST_TEST(kit::read_file(folder / "function.flt").find("00000003 ?dark blue?work") !=
             std::string::npos);
  BOOST_TEST(
      kit::read_file(folder / "feature.flt") ==
      "00000000 -\n40080C07 ?dark green?blob 1 from 7,3\n80500C07 ?dark blue?corner 7,3 E 2\n"
      "FFFFFFFF ?dark red?end of frame\n");
  BOOST_TEST(system.find("^1 " + (folder / "feature.flt") +
                         "\npl.corner_detection.corner_data[31:0]\n") != std::string::npos);
  const std::vector<std::string> expected = {
      "corner_detection.gtkw", "cpu.gtkw",    "feature.flt", "function.flt",         "gic.gtkw",
      "interrupt.flt",         "system.gtkw", "system.sucl", "system.vaporview.json"};
  BOOST_TEST(folder.entries() == expected, boost::test_tools::per_element());
  BOOST_TEST(complaint([&] {
               TraceFile again(waves.file);
               write_save_files(again, platform::marker_words(), "/nowhere");
             }).find("cannot write") == 0u);
}

BOOST_AUTO_TEST_SUITE_END()
