// `markervp rtl prove`: verdicts, exit codes, files, and what is refused.
#include <boost/test/unit_test.hpp>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "executable.h"

using namespace integration;

namespace {

struct Prove : Workplace {
  kit::Outcome prove(const Arguments& more) const {
    Arguments all{"rtl", "prove"};
    all.insert(all.end(), more.begin(), more.end());
    return kit::run_process(MARKERVP_EXECUTABLE, all, path());
  }
  void check_refused(const Arguments& arguments, const std::string& why) const {
    const kit::Outcome outcome = prove(arguments);
    BOOST_TEST(outcome.exit_code == 2);
    BOOST_TEST(outcome.err.find(why) != std::string::npos, outcome.err << " without " << why);
  }
  /// frame_status, whose `busy` is wrong while `wrong` is true. A counter of 40 bits lies beside
  /// it.
  kit::Outcome prove_frame_status(const std::string& wrong, const Arguments& more = {}) const {
    std::filesystem::create_directories(*this / "rtl");
    kit::write_file(*this / "rtl/own.v", R"(module frame_status (
  input clk, rst, frame_ena, idle, corner_out, blob_out, output busy, done);
  reg [3:0] left = 0;
  reg started = 0;
  reg [39:0] clocks = 0;
  always @(posedge clk) begin
    clocks <= clocks + 1;
    if (rst) begin left <= 15; started <= 0; end
    else if (frame_ena) begin left <= 15; started <= 1; end
    else if (started && left != 0) left <= left - 1;
  end
  wire works = started && (left != 0 || !idle || frame_ena);
  assign busy = works ^ ()" + wrong + R"();
  assign done = started && !works && !corner_out && !blob_out;
endmodule
)");
    Arguments all{"frame_status", "--rtl", "rtl"};
    all.insert(all.end(), more.begin(), more.end());
    return prove(all);
  }
  nlohmann::json report() const {
    return nlohmann::json::parse(kit::read_file(*this / "out/prove.json"));
  }
  bool has(const std::string& file) const { return std::filesystem::exists(*this / file); }
};

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(rtl_prove, Prove)

BOOST_AUTO_TEST_CASE(what_cannot_be_proved_is_refused) {
  kit::write_file(*this / "own.v", "module own(input a);\nendmodule\n");
  std::filesystem::create_directories(*this / "empty");
  check_refused({"frame", "--rtl", "."}, "of an IP 'frame': name ");
  check_refused({"frame_status", "--rtl", "own.so"}, "reads sources; give their folder");
  check_refused({"frame_status", "--rtl", "empty"}, "no file of Verilog (.v, .sv) or VHDL");
  check_refused({"frame_status", "--top", "own"}, "--top is a module of --rtl");
  check_refused({"frame_status"}, "no stream whose rules");
  check_refused({"frame_status", "--rtl", ".", "--parameter", "WIDTH"}, "give NAME=NUMBER");
  check_refused({"frame_status", "--rtl", ".", "--parameter", "N(=3"}, "give NAME=NUMBER");
  check_refused({"frame_status", "--rtl", ".", "--depth", "0"}, "--depth");
  check_refused({}, "name an IP; or give --rtl and --top");
  check_refused({"--rtl", "own.v"}, "name an IP; or give --rtl and --top");
  check_refused({"frame_status", "--interface", "a: wire"}, "--interface is for RTL without an IP");
  check_refused({"frame_status", "--tie", "a=1"}, "--tie is for RTL without an IP");
}

#ifdef MARKERVP_PROOFS

BOOST_AUTO_TEST_CASE(links_of_any_rtl_are_proved_to_keep_their_rules) {
  const auto write = [&](const char* next) {
    kit::write_file(*this / "own.v",
                    std::string("module own(input clk, input rst, output reg [31:0] m_tdata = 0,\n"
                                "  output reg m_tvalid = 0, input m_tready);\n"
                                "  always @(posedge clk) begin\n    m_tvalid <= !rst;\n    if (") +
                        next + ") m_tdata <= m_tdata + 1;\n  end\nendmodule\n");
  };
  const Arguments links{"--rtl", "own.v", "--top", "own", "--interface", "rst: reset high"};
  write("m_tvalid && m_tready");
  check_refused({"--rtl", "own.v", "--top", "own"}, "own.v:1: reset 'rst'");
  check_refused({"--rtl", "own.v", "--top", "own"}, "say --interface \"rst: reset high\"");
  check_refused({"--rtl", "own.v", "--top", "own", "--interface", "rst"}, "<port or prefix>");
  kit::Outcome outcome = prove(links);
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  BOOST_TEST(says(outcome.out, "PROVED: links of 'own' of 'own.v', on every clock"), outcome.out);
  BOOST_TEST(report()["compared"].size() == 3u);
  write("m_tvalid");
  outcome = prove(links);
  BOOST_TEST(outcome.exit_code == 1);
  BOOST_TEST(says(outcome.err, "BROKEN behind clock"), outcome.err);
  BOOST_TEST(says(outcome.err, "m_AXI4STREAM_ERRM_TDATA_STABLE"), outcome.err);
  BOOST_TEST(has("out/prove.vcd"));
  kit::write_file(*this / "own.v", "module own(input clk, output x);\nassign x = 0;\nendmodule\n");
  check_refused({"--rtl", "own.v", "--top", "own"}, "no AXI4, AXI4-Lite or AXI4-Stream link");
}

BOOST_AUTO_TEST_CASE(inputs_may_be_tied) {
  kit::write_file(*this / "own.v",
                  "module own(input clk, input rst, input [1:0] wild, output reg m_tvalid = 0,\n"
                  "  output reg [7:0] m_tdata = 0, input m_tready);\n"
                  "  always @(posedge clk) begin\n    m_tvalid <= !rst;\n"
                  "    if ((m_tvalid && m_tready) || wild == 2) m_tdata <= m_tdata + 1;\n"
                  "  end\nendmodule\n");
  const auto with = [](const Arguments& more) {
    Arguments all{"--rtl", "own.v", "--top", "own", "--interface", "rst: reset high"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  kit::Outcome outcome = prove(with({}));
  BOOST_TEST(outcome.exit_code == 1);
  BOOST_TEST(says(outcome.err, "m_AXI4STREAM_ERRM_TDATA_STABLE"), outcome.err);
  outcome = prove(with({"--tie", "wild=0x2"}));
  BOOST_TEST(outcome.exit_code == 1);
  outcome = prove(with({"--tie", "wild=1"}));
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  BOOST_TEST(says(outcome.out, "  wild is 0x1 on every clock\n"), outcome.out);
  check_refused(with({"--tie", "wild"}), "--tie 'wild': give PORT=NUMBER");
  check_refused(with({"--tie", "wild=-1"}), "--tie 'wild=-1': give PORT=NUMBER");
  check_refused(with({"--tie", "wild=1", "--tie", "wild=2"}), "--tie gives 'wild' two values");
  check_refused(with({"--tie", "wilt=1"}), "--tie: the RTL has no port 'wilt'");
  check_refused(with({"--tie", "wild=4"}),
                "own.v:1: --tie: 'wild' has 2 bits, and 0x00000004 does not fit");
  check_refused(with({"--tie", "m_tdata=1"}), "'m_tdata' is an output");
  check_refused(with({"--tie", "clk=1"}), "'clk' is the clock");
  check_refused(with({"--tie", "rst=0"}), "'rst' is a reset");
}

// A message says what the option is, and leaves names as they are.
BOOST_AUTO_TEST_CASE(a_port_may_be_called_as_an_option_of_cmake) {
  kit::write_file(*this / "own.v",
                  "module own(input clk, input INTERFACES, output [7:0] m_tdata, output m_tvalid,\n"
                  "  input m_tready);\n  assign m_tdata = 0, m_tvalid = 0;\nendmodule\n");
  check_refused({"--rtl", "own.v", "--top", "own", "--interface", "INTERFACES: reset"},
                "reset 'INTERFACES' does not say at which level it resets: the vendor's tools take "
                "it for low, most sources mean high; say --interface \"INTERFACES: reset high\"");
}

BOOST_AUTO_TEST_CASE(vhdl_is_proved_equal) {
  std::filesystem::create_directories(*this / "rtl");
  const auto write = [&](const char* busy) {
    kit::write_file(*this / "rtl/own.vhd", std::string(R"(library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
entity frame_status is
  port (clk, rst, frame_ena, idle, corner_out, blob_out : in std_logic; busy, done : out std_logic);
end;
architecture rtl of frame_status is
  signal left : unsigned(3 downto 0) := (others => '0');
  signal started : std_logic := '0';
  signal works : std_logic;
begin
  process (clk) begin
    if rising_edge(clk) then
      if rst = '1' then
        left <= to_unsigned(15, 4);
        started <= '0';
      elsif frame_ena = '1' then
        left <= to_unsigned(15, 4);
        started <= '1';
      elsif started = '1' and left /= 0 then
        left <= left - 1;
      end if;
    end if;
  end process;
  works <= '1' when started = '1' and (left /= 0 or idle = '0' or frame_ena = '1') else '0';
  busy <= )") + busy + R"(;
  done <= started and not works and not corner_out and not blob_out;
end;
)");
  };
  write("works");
  const kit::Outcome equal = prove({"frame_status", "--rtl", "rtl"});
  BOOST_TEST(equal.exit_code == 0, equal.err);
  BOOST_TEST(says(equal.out, "PROVED EQUAL"), equal.out);
  write("works and not blob_out");
  const kit::Outcome different = prove({"frame_status", "--rtl", "rtl"});
  BOOST_TEST(different.exit_code == 1, different.out);
  BOOST_TEST(says(different.err, "busy is 0x1 in ours, 0x0 in the RTL"), different.err);
}

BOOST_AUTO_TEST_CASE(equal_rtl_passes) {
  const kit::Outcome outcome = prove_frame_status("1'b0");
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  BOOST_TEST(says(outcome.out, "PROVED EQUAL: frame_status of 'rtl' and ours"), outcome.out);
  BOOST_TEST(says(outcome.out, "rst high on the first clock"), outcome.out);
  BOOST_TEST(report()["verdict"] == "proved");
  BOOST_TEST(!has("out/prove.vcd"));
}

BOOST_AUTO_TEST_CASE(a_difference_does_not_pass_and_leaves_its_files) {
  const kit::Outcome outcome = prove_frame_status("started && clocks == 5");
  BOOST_TEST(outcome.exit_code == 1);
  BOOST_TEST(says(outcome.err, "DIFFERENT behind clock 5: busy is 0x"), outcome.err);
  BOOST_TEST(report()["verdict"] == "different");
  BOOST_TEST(report()["clocks"] == 5);
  BOOST_TEST(report()["differences"][0]["name"] == "busy");
  BOOST_TEST(has("out/prove.vcd"));
  BOOST_TEST(has("out/stimulus.txt"));
  // What a later proof does not make does not stay.
  BOOST_TEST(prove_frame_status("1'b0").exit_code == 0);
  BOOST_TEST(!has("out/stimulus.txt"));
}

BOOST_AUTO_TEST_CASE(a_bound_passes_only_where_it_is_said_to_be_enough) {
  const std::string at_the_end = "started && &clocks";
  const kit::Outcome bounded = prove_frame_status(at_the_end, {"--time", "4"});
  BOOST_TEST(bounded.exit_code == 1);
  BOOST_TEST(says(bounded.out, "EQUAL for "), bounded.out);
  BOOST_TEST(says(bounded.err, "that is no proof"), bounded.err);
  BOOST_TEST(report()["verdict"] == "bounded");
  const kit::Outcome enough = prove_frame_status(at_the_end, {"--time", "4", "--depth", "20"});
  BOOST_TEST(enough.exit_code == 0, enough.err);
  BOOST_TEST(says(enough.out, "EQUAL for 20 clocks"), enough.out);
}

#endif

BOOST_AUTO_TEST_SUITE_END()
