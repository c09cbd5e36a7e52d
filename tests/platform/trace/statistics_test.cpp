// Numbers of waveforms that were counted by hand. The clock has 10 ns; edges see what stood before.
#include <boost/test/unit_test.hpp>

#include <marker/designs/marker/marker_design.h>
#include <trace/statistics.h>

#include <map>
#include <tuple>

#include "waves.h"

namespace {

using platform::trace::Table;

struct Numbers {
  explicit Numbers(const Waves& waves, std::uint64_t hertz = 100'000'000) {
    platform::trace::TraceFile file(waves.file);
    tables = platform::trace::statistics(file, platform::marker_words(), {hertz});
  }
  Numbers(const Waves& waves, const platform::trace::StatisticsOptions& options) {
    platform::trace::TraceFile file(waves.file);
    tables = platform::trace::statistics(file, platform::marker_words(), options);
  }
  Table::Cell at(const std::string& table, std::size_t row, const std::string& column) const {
    for (const Table& t : tables) {
      if (t.name != table) continue;
      for (std::size_t c = 0; c < t.columns.size(); ++c) {
        if (t.columns[c] == column) return t.rows.at(row).at(c);
      }
    }
    throw std::runtime_error("no " + table + "." + column);
  }
  std::uint64_t whole(const std::string& table, std::size_t row, const std::string& column) const {
    return std::get<std::uint64_t>(at(table, row, column));
  }
  double real(const std::string& table, std::size_t row, const std::string& column) const {
    return std::get<double>(at(table, row, column));
  }
  std::string text(const std::string& table, std::size_t row, const std::string& column) const {
    return std::get<std::string>(at(table, row, column));
  }
  std::size_t rows(const std::string& table) const {
    for (const Table& t : tables) {
      if (t.name == table) return t.rows.size();
    }
    return 0;
  }
  std::vector<Table> tables;
};

/// A clock that rises at `first`, first + period, …, and what else happens, in time's order.
std::string with_clocks(const std::vector<std::tuple<char, unsigned, unsigned>>& clocks,
                        std::multimap<unsigned, std::string> changes, unsigned end) {
  for (const auto& [code, first, period] : clocks) {
    changes.emplace(0, std::string("0") + code);
    for (unsigned at = first; at < end; at += period) {
      changes.emplace(at, std::string("1") + code);
      changes.emplace(at + period / 2, std::string("0") + code);
    }
  }
  std::string text;
  for (const auto& [at, change] : changes) text += "#" + std::to_string(at) + " " + change + "\n";
  return text + "#" + std::to_string(end + 100) + "\n";
}

const std::string link_signals = "pl.s.tvalid 1, pl.s.tready 1, pl.s.tlast 1, pl.s.tdata 32";

}  // namespace

BOOST_AUTO_TEST_SUITE(statistics)

// tvalid from 10 on, tready from 40 to 70: edges 20, 30, 40 stall; beats at 50, 60, 70; tlast on
// the last; then tready alone from 100 to 120: two starved edges.
BOOST_AUTO_TEST_CASE(a_link) {
  const Waves waves(link_signals,
                    "#0 0! 0\" 0# b0 $\n#10 1!\n#40 1\"\n#60 1#\n#70 0! 0\" 0#\n#100 1\"\n#120 "
                    "0\"\n#130\n");
  const Numbers n(waves);
  BOOST_TEST(n.whole("links", 0, "beats") == 3u);
  BOOST_TEST(n.whole("links", 0, "packets") == 1u);
  BOOST_TEST(n.whole("links", 0, "stalls") == 3u);
  BOOST_TEST(n.whole("links", 0, "starved") == 2u);
  BOOST_TEST(n.whole("links", 0, "longest_stall_cycles") == 3u);
  BOOST_TEST(n.real("links", 0, "longest_stall_at_us") == 0.01, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(n.whole("bursts", 0, "beats") == 3u);
  BOOST_TEST(n.whole("waits", 0, "wait_cycles") == 0u);
  BOOST_TEST(n.whole("waits", 0, "beats") == 2u);
  BOOST_TEST(n.whole("waits", 1, "wait_cycles") == 3u);
}

// tlast lasts for three beats: each is a packet of its own.
BOOST_AUTO_TEST_CASE(packets_of_one_beat) {
  const Waves waves(link_signals, "#0 0! 0\" 0# b0 $\n#10 1! 1\" 1#\n#40 0! 0\" 0#\n#60\n");
  const Numbers n(waves);
  BOOST_TEST(n.whole("links", 0, "beats") == 3u);
  BOOST_TEST(n.whole("links", 0, "packets") == 3u);
  BOOST_TEST(n.whole("bursts", 0, "beats") == 1u);
  BOOST_TEST(n.whole("bursts", 0, "bursts") == 3u);
}

// Two stalls of two edges each, from 10 and from 40 on.
BOOST_AUTO_TEST_CASE(of_equally_long_stalls_the_first_is_told) {
  const Waves waves(link_signals,
                    "#0 0! 0\" 0# b0 $\n#10 1!\n#30 1\"\n#40 0\"\n#60 1\"\n#70 0! 0\"\n#90\n");
  const Numbers n(waves);
  BOOST_TEST(n.whole("links", 0, "stalls") == 4u);
  BOOST_TEST(n.whole("links", 0, "longest_stall_cycles") == 2u);
  BOOST_TEST(n.real("links", 0, "longest_stall_at_us") == 0.01, boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(the_clocks_wire_counts_if_it_is_there) {
  const Waves waves("pl.s.tvalid 1, pl.s.tready 1, ps.fclk_clk0.clk 1",
                    "#0 0! 1\" 0#\n#7 1! 1#\n#9 0#\n#21 1#\n#22 0#\n#50 1# 0!\n#60\n");
  BOOST_TEST(Numbers(waves).whole("links", 0, "beats") == 2u);
}

BOOST_AUTO_TEST_CASE(links_that_do_not_run_on_the_clock_are_refused) {
  const Waves waves(link_signals, "#0 0! 0\" 0#\n#13 1!\n#26 0!\n#39 1!\n#52 0!\n");
  BOOST_TEST(complaint([&] { Numbers{waves}; }).find("--clock") != std::string::npos);
  BOOST_TEST(complaint([&] { Numbers{waves, 1'000'000'000}; }) == "");
}

// Codes: ! and " clocks, # $ the first link, % & the second.
BOOST_AUTO_TEST_CASE(every_link_has_its_own_clock) {
  const std::string signals =
      "top.a.aclk 1, top.b.bus_clk 1, top.a.m_axis_tvalid 1, top.a.m_axis_tready 1, "
      "top.b.m_axis_tvalid 1, top.b.m_axis_tready 1";
  const Waves waves(signals, with_clocks({{'!', 5, 10}, {'"', 7, 14}},
                                         {{0, "0#"},
                                          {0, "1$"},
                                          {0, "0%"},
                                          {0, "1&"},
                                          {15, "1#"},
                                          {45, "0#"},
                                          {21, "1%"},
                                          {63, "0%"}},
                                         200));
  const Numbers n(waves);
  BOOST_TEST_REQUIRE(n.rows("links") == 2u);
  BOOST_TEST(n.text("links", 0, "link") == "top.a.m_axis");
  BOOST_TEST(n.text("links", 0, "clock") == "top.a.aclk");
  BOOST_TEST(n.whole("links", 0, "beats") == 3u);
  BOOST_TEST(n.text("links", 1, "clock") == "top.b.bus_clk");
  BOOST_TEST(n.whole("links", 1, "beats") == 3u);
  // Four bytes each 10 ns and 14 ns are all that the wires allow.
  BOOST_TEST(n.real("links", 0, "mb_per_s") == 400.0, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(n.real("links", 1, "mb_per_s") == 4000.0 / 14, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(n.rows("links_left_out") == 0u);
}

BOOST_AUTO_TEST_CASE(edges_tell_which_of_two_clocks_it_is) {
  const Waves waves(
      "top.clk_fast 1, top.clk_slow 1, top.s_tvalid 1, top.s_tready 1",
      with_clocks({{'!', 5, 10}, {'"', 8, 30}},
                  {{0, "0#"}, {0, "1$"}, {38, "1#"}, {98, "0#"}, {128, "1#"}, {158, "0#"}}, 300));
  const Numbers n(waves);
  BOOST_TEST(n.text("links", 0, "clock") == "top.clk_slow");
  BOOST_TEST(n.whole("links", 0, "beats") == 3u);
}

BOOST_AUTO_TEST_CASE(benches_drive_on_the_other_edge_or_some_time_after_it) {
  const std::string signals = "top.clk 1, top.x 1, top.s_tvalid 1, top.s_tready 1";
  const auto beats = [&](unsigned delay) {
    const Waves waves(signals, with_clocks({{'!', 5, 10}},
                                           {{0, "0#"},
                                            {0, "1$"},
                                            {15 + delay, "1#"},
                                            {45 + delay, "0#"},
                                            {65 + delay, "1#"},
                                            {75 + delay, "0#"}},
                                           200));
    return Numbers(waves).whole("links", 0, "beats");
  };
  BOOST_TEST(beats(0) == 4u);
  BOOST_TEST(beats(1) == 4u);
  BOOST_TEST(beats(5) == 4u);
}

BOOST_AUTO_TEST_CASE(a_link_without_a_clock_refuses_no_other) {
  const std::string signals =
      "top.clk 1, top.x 1, top.a_tvalid 1, top.a_tready 1, top.b_tvalid 1, top.b_tready 1";
  const std::string changes = with_clocks({{'!', 5, 10}},
                                          {{0, "0#"},
                                           {0, "1$"},
                                           {0, "0%"},
                                           {0, "1&"},
                                           {15, "1#"},
                                           {45, "0#"},
                                           {16, "1%"},
                                           {28, "0%"},
                                           {39, "1%"},
                                           {51, "0%"},
                                           {62, "1%"},
                                           {74, "0%"}},
                                          200);
  const Waves waves(signals, changes);
  const Numbers n(waves);
  BOOST_TEST_REQUIRE(n.rows("links") == 1u);
  BOOST_TEST(n.text("links", 0, "link") == "top.a");
  BOOST_TEST_REQUIRE(n.rows("links_left_out") == 1u);
  BOOST_TEST(n.text("links_left_out", 0, "link") == "top.b");
}

BOOST_AUTO_TEST_CASE(clocks_can_be_named) {
  const Waves waves("top.clk 1, top.tick 1, top.s_tvalid 1, top.s_tready 1",
                    with_clocks({{'!', 5, 10}, {'"', 5, 20}},
                                {{0, "0#"}, {0, "1$"}, {5, "1#"}, {65, "0#"}}, 200));
  platform::trace::StatisticsOptions options;
  BOOST_TEST(Numbers(waves, options).whole("links", 0, "beats") == 6u);
  options.clock_of_link = {{"s", {"tick", false}}};
  BOOST_TEST(Numbers(waves, options).whole("links", 0, "beats") == 3u);
  options.clock_of_link.clear();
  options.clock = platform::trace::parse_clock_edge("tick falling");
  const Numbers falling(waves, options);
  BOOST_TEST(falling.text("links", 0, "clock") == "top.tick falling");
  BOOST_TEST(falling.whole("links", 0, "beats") == 3u);
  options.clock = platform::trace::parse_clock_edge("nothing");
  BOOST_TEST(complaint([&] { Numbers(waves, options); }).find("nothing") != std::string::npos);
  BOOST_TEST(complaint([&] {
               platform::trace::parse_clock_edge("clk up");
             }).find("'rising' or 'falling'") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(the_channels_of_axi_are_one_interface) {
  const Waves waves(
      "top.aclk 1, top.x 1, top.S_AXI_AWVALID 1, top.S_AXI_AWREADY 1, top.S_AXI_WVALID 1, "
      "top.S_AXI_WREADY 1",
      with_clocks({{'!', 5, 10}},
                  {{0, "0#"},
                   {0, "1$"},
                   {0, "0%"},
                   {0, "1&"},
                   {15, "1#"},
                   {25, "0#"},
                   {25, "1%"},
                   {45, "0%"}},
                  100));
  const Numbers n(waves);
  BOOST_TEST_REQUIRE(n.rows("links") == 2u);
  BOOST_TEST(n.text("links", 0, "interface") == "top.S_AXI");
  BOOST_TEST(n.text("links", 1, "interface") == "top.S_AXI");
  BOOST_TEST(n.whole("links", 1, "beats") == 2u);
}

BOOST_AUTO_TEST_CASE(a_buffer_with_its_overflow) {
  const Waves waves(
      "pl.feature_packaging.corner_count 16, pl.feature_packaging.depth 17, "
      "pl.feature_packaging.feature_overflow 32",
      "#0 b0 ! b10 \" b0 #\n#10 b1 !\n#30 b10 !\n#40 b1 #\n#50 b11 #\n#60 b0 !\n#70 b0 #\n#100\n");
  const Numbers n(waves);
  BOOST_TEST(n.whole("buffers", 0, "depth") == 2u);
  BOOST_TEST(n.whole("buffers", 0, "high_water") == 2u);
  BOOST_TEST(n.real("buffers", 0, "high_water_at_us") == 0.03, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(n.real("buffers", 0, "first_full_at_us") == 0.03, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(n.real("buffers", 0, "full_us") == 0.03, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(n.real("buffers", 0, "empty_us") == 0.05, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(n.real("buffers", 0, "mean") == 0.8, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(n.whole("overflows", 0, "lost") == 3u);
  BOOST_TEST(std::get<double>(n.at("overflows", 0, "first_at_us")) == 0.04,
             boost::test_tools::tolerance(1e-9));
}

// The level reaches 3 at 20 and again at 60: the first time counts. 64 deep, as the trace does not
// say.
BOOST_AUTO_TEST_CASE(a_high_water_mark_has_the_time_of_its_first) {
  const Waves waves("pl.axi_threshold_bridge.fifo_count 16",
                    "#0 b0 !\n#10 b10 !\n#20 b11 !\n#30 b1 !\n#60 b11 !\n#80 b0 !\n#100\n");
  const Numbers n(waves);
  const auto same = boost::test_tools::tolerance(1e-9);
  BOOST_TEST(n.whole("buffers", 0, "depth") == 64u);
  BOOST_TEST(n.whole("buffers", 0, "high_water") == 3u);
  BOOST_TEST(n.real("buffers", 0, "high_water_at_us") == 0.02, same);
  BOOST_TEST(std::get<std::string>(n.at("buffers", 0, "first_full_at_us")) == "never");
  BOOST_TEST(n.real("buffers", 0, "full_us") == 0.0);
  BOOST_TEST(n.real("buffers", 0, "empty_us") == 0.03, same);
  BOOST_TEST(n.real("buffers", 0, "mean") == 1.4, same);
  const double us[] = {0.03, 0.03, 0.01, 0.03};  // at level 0, 1, 2 and 3
  for (std::size_t level = 0; level < 4; ++level) {
    BOOST_TEST(n.whole("occupancy", level, "level") == level);
    BOOST_TEST(n.real("occupancy", level, "us") == us[level], same);
    BOOST_TEST(n.real("occupancy", level, "percent") == 1000 * us[level], same);
  }
}

BOOST_AUTO_TEST_CASE(a_buffer_is_full_again_but_was_so_first) {
  const Waves waves("pl.feature_packaging.blob_count 16, pl.feature_packaging.depth 17",
                    "#0 b0 ! b10 \"\n#10 b10 !\n#20 b1 !\n#30 b10 !\n#40 b0 !\n#50\n");
  const Numbers n(waves);
  const auto same = boost::test_tools::tolerance(1e-9);
  BOOST_TEST(n.real("buffers", 0, "first_full_at_us") == 0.01, same);
  BOOST_TEST(n.real("buffers", 0, "full_us") == 0.02, same);
}

BOOST_AUTO_TEST_CASE(a_buffer_without_depth_in_the_trace_has_the_usual_one) {
  const Waves waves(
      "pl.feature_packaging.corner_count 16, pl.feature_packaging.blob_count 16, "
      "pl.axi_threshold_bridge.fifo_count 16",
      "#0 b0 ! b0 \" b0 #\n#10\n");
  const Numbers n(waves);
  BOOST_TEST(n.whole("buffers", 0, "depth") == 100u);
  BOOST_TEST(n.whole("buffers", 1, "depth") == 100u);
  BOOST_TEST(n.whole("buffers", 2, "depth") == 64u);
}

// Two were lost before the trace began, one more at 20; a new frame clears the counter at 40, then
// two more are lost at 60.
BOOST_AUTO_TEST_CASE(what_a_counter_shows_at_first_was_not_lost_in_the_trace) {
  const Waves waves("pl.clock_crossing.crossing_overflow 32",
                    "#0 b10 !\n#20 b11 !\n#40 b0 !\n#60 b10 !\n#80\n");
  const Numbers n(waves);
  BOOST_TEST(n.whole("overflows", 0, "lost") == 3u);
  BOOST_TEST(n.real("overflows", 0, "first_at_us") == 0.02, boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(interrupts_from_line_to_acknowledgement) {
  const Waves waves("pl.axi_dma_0.mm2s_introut 1, ps.gic.active 10",
                    "#0 0! b1111111111 \"\n#10 1!\n#25 b111101 \"\n#30 0! b1111111111 \"\n"
                    "#40 1!\n#45 b111101 \"\n#60\n");
  const Numbers n(waves);
  BOOST_TEST(n.whole("interrupts", 0, "served") == 2u);
  BOOST_TEST(n.real("interrupts", 0, "min_us") == 0.005, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(n.real("interrupts", 0, "max_us") == 0.015, boost::test_tools::tolerance(1e-9));
}

// The second line rises before the first is served; the first one's latencies are 15, 5 and 15 ns;
// the third line is high when the trace begins.
BOOST_AUTO_TEST_CASE(interrupts_are_told_apart_by_their_number) {
  const Waves waves(
      "pl.axi_dma_0.mm2s_introut 1, pl.axi_dma_1.s2mm_introut 1, ps.private_timer.irq 1, "
      "ps.gic.active 10",
      "#0 0! 0\" 1# b1111111111 $\n#10 1!\n#12 1\"\n#25 b111101 $\n#30 b111110 $\n"
      "#32 0! 0\" b1111111111 $\n#40 1!\n#45 b111101 $\n#50 0! b1111111111 $\n#60 1!\n"
      "#75 b111101 $\n#90\n");
  const Numbers n(waves);
  const auto same = boost::test_tools::tolerance(1e-9);
  BOOST_TEST(n.whole("interrupts", 0, "raised") == 3u);
  BOOST_TEST(n.whole("interrupts", 0, "served") == 3u);
  BOOST_TEST(n.real("interrupts", 0, "min_us") == 0.005, same);
  BOOST_TEST(n.real("interrupts", 0, "mean_us") == 0.035 / 3, same);
  BOOST_TEST(n.real("interrupts", 0, "max_us") == 0.015, same);
  BOOST_TEST(n.real("interrupts", 0, "max_at_us") == 0.01, same);
  BOOST_TEST(n.whole("interrupts", 1, "served") == 1u);
  BOOST_TEST(n.real("interrupts", 1, "min_us") == 0.018, same);
  BOOST_TEST(n.real("interrupts", 1, "max_at_us") == 0.012, same);
  BOOST_TEST(n.whole("interrupts", 2, "raised") == 0u);
}

// Rates go from result to result without the upload: 50 ns, then 30 ns of which 5 are the upload's.
BOOST_AUTO_TEST_CASE(rate_and_latency_of_two_frames) {
  const Waves waves(
      "ps.cpu.frame 32, ps.cpu.results 32, ps.cpu.function 32, ps.cpu.function_name string, "
      "pl.control_block.ena 1, pl.feature_packaging.feature 32",
      "#0 b0 ! b0 \" b0 # s $ 0% b0 &\n#10 b1 !\n#20 1%\n#30 b10000000000000000000000000000001 &\n"
      "#31 b0 &\n#32 b10000000000000000000000000000001 &\n#70 b10 ! b1 \"\n"
      "#72 b1 # supload $\n#77 b0 # s $ 0%\n#80 1%\n#100 b10 \"\n#110\n");
  const Numbers n(waves);
  const auto same = boost::test_tools::tolerance(1e-9);
  BOOST_TEST(n.whole("summary", 0, "frames") == 2u);
  BOOST_TEST(n.real("summary", 0, "fps_mean") == 2 / 75e-9, same);
  BOOST_TEST(n.real("summary", 0, "latency_mean_us") == 0.035, same);
  BOOST_TEST(n.real("summary", 0, "latency_max_us") == 0.05, same);
  BOOST_TEST(n.whole("frames", 0, "feature_words") == 2u, "0 is what a reset shows");
}

// The software gives up the second of three frames: no result, but its time counts.
BOOST_AUTO_TEST_CASE(a_frame_that_was_given_up_has_no_result) {
  const Waves waves(
      "ps.cpu.frame 32, ps.cpu.results 32, ps.cpu.function 32, ps.cpu.function_name string, "
      "pl.control_block.ena 1",
      "#0 b0 ! b0 \" b0 # s $ 0%\n#10 b1 !\n#20 1%\n#70 b10 ! b1 \"\n"
      "#72 b1 # supload $\n#77 b0 # s $ 0%\n#80 1%\n#100 b11 !\n"
      "#102 b1 # supload $\n#107 b0 # s $ 0%\n#110 1%\n#130 b10 \"\n#140\n");
  const Numbers n(waves);
  const auto same = boost::test_tools::tolerance(1e-9);
  BOOST_TEST(n.whole("summary", 0, "frames") == 2u);
  BOOST_TEST(n.whole("frames", 1, "frame") == 2u);
  BOOST_TEST(n.real("summary", 0, "latency_mean_us") == 0.035, same);
  BOOST_TEST(n.real("summary", 0, "fps_mean") == 2 / 100e-9, same);
}

// Without the PL a frame begins with `capture`.
BOOST_AUTO_TEST_CASE(stages_of_a_frame_that_software_captures) {
  const Waves waves(
      "ps.cpu.frame 32, ps.cpu.results 32, ps.cpu.function 32, ps.cpu.function_name string",
      "#0 b0 ! b0 \" b0 # s $\n#10 b1 !\n#20 b1 # scapture $\n#40 b0 # s $\n"
      "#50 b10 # sfeature_evaluation $\n#60 b0 # s $\n#70 b1 \"\n#80\n");
  const Numbers n(waves);
  const auto same = boost::test_tools::tolerance(1e-9);
  BOOST_TEST(n.real("stages", 0, "feature_extraction_us") == 0.03, same);
  BOOST_TEST(n.real("stages", 0, "evaluation_us") == 0.01, same);
  BOOST_TEST(n.real("stages", 0, "identification_us") == 0.01, same);
  BOOST_TEST(n.real("stages", 0, "latency_us") == 0.05, same);
}

BOOST_AUTO_TEST_CASE(frames_words_and_functions) {
  const Waves waves(
      "ps.cpu.frame 32, ps.cpu.results 32, ps.cpu.function 32, ps.cpu.function_name string, "
      "pl.control_block.ena 1, pl.feature_packaging.feature 32",
      "#0 b0 ! b0 \" b0 # s $ 0% b0 &\n#10 b1 ! b1 # sload $\n#20 1% b10 # srun $\n"
      "#30 b10000000000000000000000000000001 &\n#31 b1000000000000000000000000000001 &\n"
      "#32 b1 &\n#33 b11111111111111111111111111111111 &\n#60 b0 # s $ b1 \"\n#70\n");
  const Numbers n(waves);
  BOOST_TEST(n.whole("frames", 0, "corners") == 1u);
  BOOST_TEST(n.whole("frames", 0, "blobs") == 1u);
  BOOST_TEST(n.whole("frames", 0, "feature_words") == 4u);
  BOOST_TEST(n.real("frames", 0, "latency_us") == 0.04, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(n.real("summary", 0, "fps_mean") == 25e6, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(std::get<std::string>(n.at("functions", 0, "function")) == "load");
  BOOST_TEST(n.real("functions", 1, "self_us") == 0.04, boost::test_tools::tolerance(1e-9));
}

// The software publishes a frame and takes the next without time passing.
BOOST_AUTO_TEST_CASE(the_next_frame_comes_in_the_instant_of_the_result) {
  const Waves waves(
      "ps.cpu.frame 32, ps.cpu.results 32, ps.cpu.function 32, ps.cpu.function_name string, "
      "pl.control_block.ena 1, pl.axi_threshold_bridge.bridge_overflow 32",
      "#0 b0 ! b0 \" b0 # s $ 0% b0 &\n#10 b1 !\n#12 b1 # supload $\n#14 b0 # s $\n#20 1% b1 &\n"
      "#21 b10 # sreceive $\n#25 b11 # sdma_interrupt $\n#27 b10 # sreceive $\n#40 b0 # s $\n"
      "#45 b100 # sfeature_evaluation $\n#52 b101 # srectification $\n"
      "#60 b0 # s $\n#61 b110 # spose_estimation $\n"
      "#70 b10 ! b1 \" b0 # s $\n#71 0% b0 &\n#80 1%\n#100 b10 \"\n#110\n");
  const Numbers n(waves);
  BOOST_TEST(n.whole("frames", 0, "frame") == 0u);
  BOOST_TEST(n.whole("frames", 1, "frame") == 1u);
  const auto same = boost::test_tools::tolerance(1e-9);
  BOOST_TEST(n.real("frames", 0, "latency_us") == 0.05, same);
  BOOST_TEST(n.real("frames", 1, "latency_us") == 0.02, same);
  BOOST_TEST(n.whole("frames", 0, "bridge_overflow") == 1u);
  BOOST_TEST(n.whole("frames", 1, "bridge_overflow") == 0u);
  BOOST_TEST(n.real("stages", 0, "upload_us") == 0.002, same);
  BOOST_TEST(n.real("stages", 0, "feature_extraction_us") == 0.02, same);
  BOOST_TEST(n.real("stages", 0, "receive_us") == 0.005, same);
  BOOST_TEST(n.real("stages", 0, "evaluation_us") == 0.007, same);
  BOOST_TEST(n.real("stages", 0, "identification_us") == 0.009, same);
  BOOST_TEST(n.real("stages", 0, "pose_us") == 0.009, same);
  BOOST_TEST(n.real("stages", 0, "latency_us") == 0.05, same);
  BOOST_TEST(n.real("stages", 1, "latency_us") == 0.02, same);
}

BOOST_AUTO_TEST_CASE(a_trace_of_something_else_is_refused_with_what_is_missing) {
  const Waves waves("top.a 1, top.b 2", "#0 0! b0 \"\n");
  const std::string message = complaint([&] { Numbers{waves}; });
  BOOST_TEST(message.find("has nothing that markervp knows") != std::string::npos);
  BOOST_TEST(message.find("top.a, top.b") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(tables_in_three_forms) {
  const std::vector<Table> tables = {
      {"t", "Title", {"name", "n", "x"}, {{std::string("a,b"), std::uint64_t{7}, 1.5}}, false}};
  BOOST_TEST(tables_as_text(tables) == "Title\n  name  n      x\n  a,b   7  1.500\n");
  BOOST_TEST(tables_as_csv(tables) == "t\nname,n,x\n\"a,b\",7,1.500000\n");
  BOOST_TEST(tables_as_json(tables).find("\"n\": 7") != std::string::npos);
}

// As the trace shows them: the second bit of IRQ_F2P is the first DMA's, 62; both lines at once say
// nothing new.
BOOST_AUTO_TEST_CASE(numbers_of_interrupts_follow_the_vector) {
  const Waves waves(
      "pl.axi_dma_0.mm2s_introut 1, pl.axi_dma_1.s2mm_introut 1, pl.concat.dout 9, ps.gic.active "
      "10",
      "#0 0! 0\" b0 # b1111111111 $\n#10 1! b10 #\n#25 b111110 $\n#30 0! b0 # b1111111111 $\n"
      "#40 1\" b100000000 #\n#45 b1010100 $\n#50 0\" b0 # b1111111111 $\n"
      "#60 1! 1\" b100000010 #\n#70 b111110 $\n#90\n");
  const Numbers n(waves);
  BOOST_TEST(n.whole("interrupts", 0, "id") == 62u);
  BOOST_TEST(n.whole("interrupts", 0, "served") == 2u);
  BOOST_TEST(n.whole("interrupts", 1, "id") == 84u);
  BOOST_TEST(n.whole("interrupts", 1, "served") == 1u);
}

BOOST_AUTO_TEST_SUITE_END()
