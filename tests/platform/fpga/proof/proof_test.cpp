// RTL in the place of an IP: proved equal, found different, or refused with what to declare.
#include <fpga/proof/equivalence.h>

#include <boost/test/unit_test.hpp>
#include <cstdlib>
#include <filesystem>

#include <vp/error.h>

#include "temporary_files.h"

using namespace platform::proof;
namespace synthesis = platform::synthesis;

namespace {

struct Rtl {
  /// That of an IP as it comes along, with one text replaced by another.
  void copy(const std::string& ip, const std::string& right = "", const std::string& wrong = "") {
    std::string text = kit::read_file(std::string(MARKERVP_MODELS "/") + ip + "/rtl/" + ip + ".sv");
    if (!right.empty()) {
      const std::size_t at = text.find(right);
      BOOST_TEST_REQUIRE(at != std::string::npos, right);
      text.replace(at, right.size(), wrong);
    }
    kit::write_file(folder / "own.sv", text);
  }

  Answer ask(const std::string& ip, std::uint64_t depth = 0) const {
    Claim claim;
    claim.ip = ip;
    claim.theirs = synthesis::Design{ip, ip, synthesis::sources_in(folder.path()), {}};
    claim.depth = depth;
    claim.folder = out.path();
    return prove(claim);
  }
  std::string refusal(const std::string& ip) const {
    try {
      ask(ip);
    } catch (const vp::InputError& error) {
      return error.what();
    }
    return "";
  }

  kit::TemporaryFolder folder, out;
};

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Another form of frame_status: it counts upwards, and says `done` by other logic.
const char* const other_form = R"(module frame_status (
  input wire clk, rst, frame_ena, idle, corner_out, blob_out, output wire busy, done);
  reg [3:0] passed = 0;
  reg seen = 0;
  always @(posedge clk)
    if (rst) begin passed <= 0; seen <= 0; end
    else if (frame_ena) begin passed <= 0; seen <= 1; end
    else if (seen && passed != 15) passed <= passed + 1;
  wire drained = passed == 15;
  assign busy = seen & ~(drained & idle & ~frame_ena);
  assign done = seen & drained & idle & ~frame_ena & ~(corner_out | blob_out);
endmodule
)";

}  // namespace

BOOST_FIXTURE_TEST_SUITE(proof, Rtl)

BOOST_AUTO_TEST_CASE(another_form_of_an_ip_is_proved_equal_on_every_clock) {
  kit::write_file(folder / "own.v", other_form);
  const Answer answer = ask("frame_status");
  BOOST_TEST((answer.verdict == Verdict::proved), answer.why);
  BOOST_TEST(answer.compared.size() == 2u);
  BOOST_TEST(!std::filesystem::exists(out / trace_name));
}

BOOST_AUTO_TEST_CASE(a_bug_has_its_clock_its_port_a_trace_and_a_stimulus) {
  copy("axi_threshold_bridge", "in_packet == LAST_WORD;", "in_packet == LAST_WORD - 1'b1;");
  const Answer answer = ask("axi_threshold_bridge");
  BOOST_TEST_REQUIRE((answer.verdict == Verdict::different), answer.why);
  BOOST_TEST_REQUIRE(answer.differences.size() == 1u);
  BOOST_TEST(answer.differences.front().name == "m_tlast");
  BOOST_TEST(answer.differences.front().ours == "0");
  BOOST_TEST(answer.differences.front().theirs == "1");
  BOOST_TEST(answer.parameters.at("BURST_WORDS") == 4);
  const std::string stimulus = kit::read_file(out / stimulus_name);
  BOOST_TEST(stimulus.rfind("ena m_tready rst thresh_data thresh_in\n", 0) == 0u, stimulus);
  const auto lines = static_cast<std::uint64_t>(std::count(stimulus.begin(), stimulus.end(), '\n'));
  BOOST_TEST(lines == answer.clocks + 2);  // the names, and the clocks from 0 on
  BOOST_TEST(contains(kit::read_file(out / trace_name), "$var"));
}

// Gates read 0 there, and a simulation x.
BOOST_AUTO_TEST_CASE(reading_outside_of_a_memory_is_a_difference) {
  copy("feature_packaging", "PAIR_BITS'(PAIRS - 1) ? '0", "PAIR_BITS'(PAIRS) ? '0");
  const Answer answer = ask("feature_packaging");
  BOOST_TEST_REQUIRE((answer.verdict == Verdict::different), answer.why);
  BOOST_TEST(!answer.differences.empty());
}

// An assumption of the RTL's own would hide the bug.
BOOST_AUTO_TEST_CASE(what_the_rtl_assumes_is_no_condition) {
  copy("frame_status", "assign busy = started &&",
       "always_comb assume (!frame_ena);\n  assign busy = started && !frame_ena &&");
  BOOST_TEST((ask("frame_status").verdict == Verdict::different));
}

BOOST_AUTO_TEST_CASE(what_holds_with_some_parameters_need_not_hold_with_others) {
  copy("axi_threshold_bridge", "in_packet == LAST_WORD;",
       "in_packet == LAST_WORD && BURST_WORDS != 32;");
  BOOST_TEST((ask("axi_threshold_bridge").verdict == Verdict::proved));
  Claim claim;
  claim.ip = "axi_threshold_bridge";
  claim.theirs = synthesis::Design{claim.ip, claim.ip, synthesis::sources_in(folder.path()), {}};
  claim.parameters = {{"BURST_WORDS", 32}};
  claim.folder = out.path();
  BOOST_TEST((prove(claim).verdict == Verdict::different));
}

BOOST_AUTO_TEST_CASE(ports_that_differ_are_refused_with_what_to_declare) {
  copy("frame_status", "output logic busy", "output logic [1:0] busy");
  BOOST_TEST(contains(refusal("frame_status"), "own.sv:"));
  BOOST_TEST(contains(refusal("frame_status"), "port 'busy': declare 'output logic busy'"));
  copy("frame_status", "input  logic idle", "input  logic idle, more");
  BOOST_TEST(contains(refusal("frame_status"), "the IP has no port 'more': remove it"));
  copy("frame_status", "    output logic done\n", "    output logic finished\n");
  BOOST_TEST(contains(refusal("frame_status"), "'finished'"));
}

BOOST_AUTO_TEST_CASE(a_second_clock_is_refused_where_it_is) {
  copy("frame_status", "always_ff @(posedge clk)", "always_ff @(negedge clk)");
  BOOST_TEST(contains(refusal("frame_status"), "own.sv:"));
  BOOST_TEST(contains(refusal("frame_status"), "the rising edge of 'clk'"));
  BOOST_TEST(contains(refusal("stream_crossing"), "a proof has one clock"));
  BOOST_TEST(contains(refusal("frame"), "of an IP 'frame': name "));
}

BOOST_AUTO_TEST_CASE(streams_of_ours_keep_their_rules) {
  Claim claim;
  claim.ip = "axi_threshold_bridge";
  const Answer answer = prove(claim);
  BOOST_TEST((answer.verdict == Verdict::proved), answer.why);
  BOOST_TEST(answer.compared.front() == "AXI4STREAM_ERRM_TVALID_RESET");
  claim.ip = "frame_status";
  BOOST_CHECK_THROW(prove(claim), vp::InputError);
}

BOOST_AUTO_TEST_CASE(parameters_are_found_in_every_form) {
  kit::write_file(folder / "own.v", R"(// parameter NOTE = 1
module own #(parameter A = 1, B = 2, localparam C = 3) (input clk);
  parameter D = 4;
  localparam E = D == 4 ? A : B;
endmodule
module other #(parameter F = 1) (input clk);
endmodule
)");
  const synthesis::Design design{"own", "own", synthesis::sources_in(folder.path()), {}};
  for (const char* name : {"A", "B", "D"}) BOOST_TEST(synthesis::has_parameter(design, name), name);
  for (const char* name : {"C", "E", "F", "NOTE", "G"})
    BOOST_TEST(!synthesis::has_parameter(design, name), name);
}

BOOST_AUTO_TEST_SUITE_END()
