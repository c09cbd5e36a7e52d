// Stimulus and response of an IP as files, and the benches that play them to RTL.
#include <systemc>

#include <boost/test/unit_test.hpp>
#include <filesystem>
#include <string>

#include "child_process.h"
#include "crossing_bench.h"
#include "pipeline.h"

namespace {

namespace fs = std::filesystem;
using Strings = std::vector<std::string>;

/// What an IP saw and did in two frames of noise behind a system reset.
struct Vectors {
  void write(const std::string& ip) {
    Strings settings = harness::frame_size(64, 32);
    settings.insert(settings.end(),
                    {"pl.blob_detection.label_count=16", "pl.blob_detection.minimum_side=2 px",
                     "pl.fidelity." + ip + "=vectors:" + folder.path()});
    harness::Pipeline pipeline({}, settings);
    pipeline.run_for(200'000);
    pipeline.driver.system_reset(true);
    pipeline.run_for(200'000);
    pipeline.driver.system_reset(false);
    for (const std::uint64_t seed : {7, 8}) {
      pipeline.load(harness::noise(64, 32, seed));
      for (const harness::Word& word : pipeline.run_frame()) words += word.kind == 'C';
    }
    sc_core::sc_stop();
  }

  /// What a stream saw and did on its way from one clock to another.
  void write_crossing() {
    harness::StreamBench bench({"fidelity.pixel_crossing=vectors:" + folder.path()},
                               {130'000'000, 100'000'000, false});
    bench.reset();
    bench.play();
    sc_core::sc_stop();
  }

  Strings lines(const std::string& file) const {
    Strings all{""};
    for (const char c : kit::read_file(folder / file)) {
      if (c == '\n') {
        all.emplace_back();
      } else {
        all.back() += c;
      }
    }
    all.pop_back();
    return all;
  }

  /// Replaces a text of a file, all of it.
  void replace(const std::string& file, const std::string& what, const std::string& with) const {
    std::string text = kit::read_file(folder / file);
    std::size_t at = text.find(what);
    BOOST_TEST_REQUIRE(at != std::string::npos, file + " has no " + what);
    for (; at != std::string::npos; at = text.find(what, at + with.size()))
      text.replace(at, what.size(), with);
    kit::write_file(folder / file, text);
  }
  void copy_rtl(const std::string& ip) const {
    for (const std::string& part : {ip, std::string("common")}) {
      for (const auto& file : fs::directory_iterator(MARKERVP_SOURCE "/models/pl/" + part + "/rtl"))
        fs::copy(file, folder.path());
    }
  }

  kit::Outcome run(const std::string& program, const Strings& arguments) const {
    return kit::run_process(program, arguments, folder.path());
  }

  kit::TemporaryFolder folder;
  unsigned words = 0;  ///< corners of both frames
};

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(vectors, Vectors)

BOOST_AUTO_TEST_CASE(a_line_is_a_clock_and_a_column_a_port) {
  write("corner_detection");
  const Strings stimulus = lines("stimulus.hex"), response = lines("response.hex");
  BOOST_TEST(stimulus.size() == response.size());
  BOOST_TEST(stimulus.size() > 2 * 64 * 32u);
  unsigned corners = 0;
  for (const std::string& line : response) {
    corners += line[0] == '1';
    const bool unknown = contains(line, "XXXXXXXX");
    BOOST_TEST(unknown == (line[0] != '1'), line);
  }
  BOOST_TEST(corners == words);
  BOOST_TEST(response.front() == "X XXXXXXXX");  // no reset yet
  BOOST_TEST(stimulus.front().size() == std::string("1 0 00 000 000").size());
}

// Which clocks rise is in front: of ten edges of one and thirteen of the other, one is common.
BOOST_AUTO_TEST_CASE(edges_of_two_clocks_share_a_line_where_they_coincide) {
  write_crossing();
  const Strings stimulus = lines("stimulus.hex");
  BOOST_TEST(stimulus.front().size() == std::string("2 0 00000000 0 0 0").size());
  std::size_t first = 0, second = 0, both = 0;
  for (const std::string& line : stimulus) {
    first += line[0] != '1';
    second += line[0] != '2';
    both += line[0] == '3';
  }
  BOOST_TEST(first + second - both == stimulus.size());
  BOOST_TEST(both > second / 10 - 2);
  BOOST_TEST(both < second / 10 + 2);
  BOOST_TEST(first * 10 / 13 + 2 > second);
  BOOST_TEST(lines("response.hex").size() == stimulus.size());
}

#ifdef IVERILOG

struct Verilog : Vectors {
  kit::Outcome simulate(const std::string& ip) const {
    Strings arguments{"-g2012", "-s", "bench", "-o", "bench.vvp", "bench.sv"};
    for (const auto& file : fs::directory_iterator(folder.path())) {
      const std::string name = file.path().filename().string();
      if (file.path().extension() == ".sv" && name != "bench.sv") arguments.push_back(name);
    }
    const kit::Outcome compiled = run(IVERILOG, arguments);
    BOOST_TEST_REQUIRE(compiled.exit_code == 0, ip + ": " + compiled.out + compiled.err);
    return run(VVP, {"-n", "bench.vvp"});
  }
};

BOOST_FIXTURE_TEST_CASE(icarus_finds_the_rtl_equal_and_a_bug_in_it, Verilog) {
  for (const std::string ip : {"corner_detection", "global_threshold", "blob_detection"}) {
    Verilog bench;
    bench.write(ip);
    bench.copy_rtl(ip);
    const kit::Outcome outcome = bench.simulate(ip);
    BOOST_TEST(outcome.exit_code == 0, ip + ": " + outcome.out + outcome.err);
    const std::string clocks = std::to_string(bench.lines("stimulus.hex").size());
    BOOST_TEST(contains(outcome.out, "PASS: equal on " + clocks + " clocks"), outcome.out);
  }
  write("corner_detection");
  copy_rtl("corner_detection");
  replace("corner_detection.sv", "centre[11-:STRENGTH_BITS]", "centre[10-:STRENGTH_BITS]");
  const kit::Outcome outcome = simulate("corner_detection");
  BOOST_TEST(outcome.exit_code != 0);
  BOOST_TEST(contains(outcome.out, "FAIL: behind clock "), outcome.out);
  BOOST_TEST(contains(outcome.out, " corner_data is "), outcome.out);
}

BOOST_FIXTURE_TEST_CASE(icarus_plays_two_clocks, Verilog) {
  write_crossing();
  copy_rtl("stream_crossing");
  kit::Outcome outcome = simulate("stream_crossing");
  BOOST_TEST(outcome.exit_code == 0, outcome.out + outcome.err);
  BOOST_TEST(contains(outcome.out, "PASS: equal on "), outcome.out);
  replace("stream_crossing.sv", "written_seen  <= written_first", "written_seen  <= written_gray");
  outcome = simulate("stream_crossing");
  BOOST_TEST(outcome.exit_code != 0);
  BOOST_TEST(contains(outcome.out, " m_tvalid is "), outcome.out);
}

BOOST_FIXTURE_TEST_CASE(icarus_does_not_pass_what_it_could_not_read, Verilog) {
  write("corner_detection");
  copy_rtl("corner_detection");
  const std::string all = kit::read_file(folder / "response.hex");
  kit::write_file(folder / "response.hex", all.substr(0, 120));
  kit::Outcome outcome = simulate("corner_detection");
  BOOST_TEST(outcome.exit_code != 0);
  BOOST_TEST(contains(outcome.out, "is not in stimulus.hex or response.hex"), outcome.out);
  fs::remove(folder / "stimulus.hex");
  outcome = simulate("corner_detection");
  BOOST_TEST(outcome.exit_code != 0);
  BOOST_TEST(!contains(outcome.out, "PASS"), outcome.out);
}

// $readmemh takes the same files: one word a port.
BOOST_FIXTURE_TEST_CASE(readmemh_reads_them, Verilog) {
  write("corner_detection");
  kit::write_file(folder / "bench.sv",
                  "module bench;\n  logic [31:0] words[0:9];\n  initial begin\n"
                  "    $readmemh(\"stimulus.hex\", words, 0, 9);\n"
                  "    $display(\"%0d %0d\", words[1], words[6]);\n  end\nendmodule\n");
  const kit::Outcome outcome = simulate("memory");
  const Strings stimulus = lines("stimulus.hex");
  BOOST_TEST(contains(outcome.out, std::string() + stimulus[0][2] + " " + stimulus[1][2]),
             outcome.out);
}

#endif

#ifdef GHDL

struct Vhdl : Vectors {
  Vhdl() {
    write("global_threshold");
    fs::copy(MARKERVP_SOURCE "/examples/07_own_rtl/global_threshold.vhd", folder.path());
  }
  kit::Outcome simulate(const std::string& file = "global_threshold.vhd") const {
    for (const Strings& step :
         {Strings{"-a", "--std=08", file, "bench.vhd"}, Strings{"-e", "--std=08", "bench"}}) {
      const kit::Outcome outcome = run(GHDL, step);
      BOOST_TEST_REQUIRE(outcome.exit_code == 0, outcome.out + outcome.err);
    }
    return run(GHDL, {"-r", "--std=08", "bench"});
  }
};

BOOST_FIXTURE_TEST_CASE(ghdl_finds_the_vhdl_equal, Vhdl) {
  const kit::Outcome outcome = simulate();
  BOOST_TEST(outcome.exit_code == 0, outcome.out + outcome.err);
  BOOST_TEST(contains(outcome.out + outcome.err, "PASS: equal on"), outcome.out + outcome.err);
}

BOOST_FIXTURE_TEST_CASE(ghdl_finds_a_bug, Vhdl) {
  replace("global_threshold.vhd", "to_unsigned(127, 8)", "to_unsigned(126, 8)");
  const kit::Outcome outcome = simulate();
  BOOST_TEST(outcome.exit_code != 0);
  BOOST_TEST(contains(outcome.out + outcome.err, "binary_out is 0, and not 1"),
             outcome.out + outcome.err);
}

// An entity that counts the edges of either clock, and takes no word.
BOOST_FIXTURE_TEST_CASE(ghdl_plays_two_clocks, Vhdl) {
  write_crossing();
  kit::write_file(folder / "stream_crossing.vhd", R"(library ieee;
use ieee.std_logic_1164.all;
entity stream_crossing is
  generic (DEPTH : positive);
  port (clk, m_clk, rst, s_tvalid, s_tlast, m_tready : in std_logic;
        s_tdata : in std_logic_vector(31 downto 0);
        s_tready, m_tvalid, m_tlast : out std_logic;
        m_tdata : out std_logic_vector(31 downto 0);
        m_tkeep : out std_logic_vector(3 downto 0));
end entity;
architecture counts of stream_crossing is
  signal edges, m_edges : natural := 0;
begin
  edges   <= edges + 1 when rising_edge(clk);
  m_edges <= m_edges + 1 when rising_edge(m_clk);
  s_tready <= '0';
  m_tvalid <= '0';
  m_tlast  <= '0';
  m_tdata  <= (others => '0');
  m_tkeep  <= "1111";
  process (s_tvalid)
  begin
    if rising_edge(s_tvalid) then
      report "first word behind " & integer'image(edges) & " and " & integer'image(m_edges);
    end if;
  end process;
end architecture;
)");
  std::size_t first = 0, second = 0;
  const Strings stimulus = lines("stimulus.hex");
  for (const std::string& line : stimulus) {
    if (line[line.size() - 5] == '1') break;  // TVALID
    first += line[0] != '1';
    second += line[0] != '2';
  }
  const kit::Outcome outcome = simulate("stream_crossing.vhd");
  const std::string said = outcome.out + outcome.err;
  BOOST_TEST(outcome.exit_code != 0);
  BOOST_TEST(contains(said, "first word behind " + std::to_string(first) + " and " +
                                std::to_string(second)),
             said);
  BOOST_TEST(contains(said, "s_tready is 0, and not 1"), said);
}

BOOST_FIXTURE_TEST_CASE(ghdl_does_not_pass_what_it_could_not_read, Vhdl) {
  const std::string all = kit::read_file(folder / "response.hex");
  kit::write_file(folder / "response.hex", all.substr(0, 120));
  const kit::Outcome outcome = simulate();
  BOOST_TEST(outcome.exit_code != 0);
  BOOST_TEST(!contains(outcome.out + outcome.err, "PASS"), outcome.out + outcome.err);
}

#endif

BOOST_AUTO_TEST_SUITE_END()
