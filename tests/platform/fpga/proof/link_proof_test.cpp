// The rules of AXI4-Lite and AXI4-Stream, proved of RTL alone; a planted bug of each is found.
#include <fpga/proof/equivalence.h>
#include <fpga/proof/miter.h>

#include <boost/test/unit_test.hpp>
#include <string>
#include <utility>
#include <vector>

#include "temporary_files.h"

using namespace platform::proof;
namespace synthesis = platform::synthesis;

namespace {

/// A subordinate that takes address and data of a write in any order, and one of each at a time.
const char* const lite = R"(module lite (
  input aclk, aresetn,
  input [3:0] s_awaddr, input s_awvalid, output s_awready,
  input [31:0] s_wdata, input [3:0] s_wstrb, input s_wvalid, output s_wready,
  output [1:0] s_bresp, output reg s_bvalid, input s_bready,
  input [3:0] s_araddr, input s_arvalid, output s_arready,
  output reg [31:0] s_rdata, output [1:0] s_rresp, output reg s_rvalid, input s_rready);
  reg [31:0] words[0:3];
  reg has_address, has_data;
  reg [1:0] place;
  reg [31:0] data;
  assign s_awready = !has_address, s_wready = !has_data, s_arready = !s_rvalid;
  assign s_bresp = 2'b00, s_rresp = 2'b00;
  always @(posedge aclk)
    if (!aresetn) begin
      has_address <= 0; has_data <= 0;
      s_bvalid <= 0;
      s_rvalid <= 0;
    end else begin
      if (s_awvalid && s_awready) begin has_address <= 1; place <= s_awaddr[3:2]; end
      if (s_wvalid && s_wready) begin has_data <= 1; data <= s_wdata; end
      if (s_bvalid && s_bready) s_bvalid <= 0;
      if (has_address && has_data && !s_bvalid) begin
        words[place] <= data; s_bvalid <= 1; has_address <= 0; has_data <= 0;
      end
      if (s_arvalid && s_arready) begin s_rvalid <= 1; s_rdata <= words[s_araddr[3:2]]; end
      else if (s_rready) s_rvalid <= 0;
    end
endmodule
)";

/// A register of a stream, whose bytes beyond TKEEP may change.
const char* const stream = R"(module stream (
  input clk, rst, input [15:0] in_tdata, input in_tvalid, output in_tready,
  output [15:0] out_tdata, output [1:0] out_tkeep, output out_tlast, output reg out_tvalid,
  input out_tready);
  reg [15:0] word;
  reg [2:0] count, beats;
  assign in_tready = !out_tvalid || out_tready;
  assign out_tkeep = {!out_tlast, 1'b1}, out_tlast = beats == 7;
  assign out_tdata = out_tlast ? {word[15:11], count, word[7:0]} : word;
  always @(posedge clk) begin
    count <= count + 1;
    if (rst) begin out_tvalid <= 0; beats <= 0; end
    else if (in_tready) begin
      out_tvalid <= in_tvalid; word <= in_tdata; beats <= beats + (out_tvalid && out_tready);
    end
  end
endmodule
)";

struct Rtl {
  /// One text of it replaced by another.
  Answer ask(std::string text, const std::string& right = "", const std::string& wrong = "") const {
    if (!right.empty()) {
      const std::size_t at = text.find(right);
      BOOST_TEST_REQUIRE(at != std::string::npos, right);
      text.replace(at, right.size(), wrong);
    }
    kit::write_file(folder / "own.v", text);
    const std::string top = text.substr(7, text.find(' ', 7) - 7);
    Claim claim;
    claim.theirs = synthesis::Design{"", top, synthesis::sources_in(folder.path()), {}};
    claim.folder = out.path();
    claim.find_pins = [&](const std::vector<Port>& ports) {
      Pins pins;
      pins.clock = top == "lite" ? "aclk" : "clk";
      pins.resets = {top == "lite" ? Pins::Reset{"aresetn", true} : Pins::Reset{"rst", false}};
      if (top == "lite") {
        pins.links = {link(ports, Link::Kind::axi_lite, "s", true)};
      } else {
        pins.links = {link(ports, Link::Kind::axi_stream, "in", true),
                      link(ports, Link::Kind::axi_stream, "out", false)};
      }
      return pins;
    };
    return prove(claim);
  }
  static Link link(const std::vector<Port>& ports, Link::Kind kind, const std::string& name,
                   bool slave) {
    Link link{kind, name, slave};
    for (const Port& port : ports) {
      if (port.name.find(name + "_") == 0)
        link.ports[port.name.substr(name.size() + 1)] = port.name;
    }
    return link;
  }
  /// The rules that a bug breaks; "proved" if none.
  std::string broken(const char* text, const std::string& right = "",
                     const std::string& wrong = "") const {
    const Answer answer = ask(text, right, wrong);
    if (answer.verdict == Verdict::proved) return "proved";
    std::string rules = answer.verdict == Verdict::different ? "" : "undecided " + answer.why;
    for (const Difference& difference : answer.differences) rules += difference.name + " ";
    return rules;
  }

  kit::TemporaryFolder folder, out;
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(link_proof, Rtl)

BOOST_AUTO_TEST_CASE(links_that_keep_their_rules_are_proved_on_every_clock) {
  const Answer answer = ask(lite);
  BOOST_TEST((answer.verdict == Verdict::proved), answer.why);
  BOOST_TEST(answer.compared.size() == 12u);
  BOOST_TEST(broken(stream) == "proved");
}

BOOST_AUTO_TEST_CASE(each_rule_of_axi4_lite_finds_its_bug) {
  const struct {
    const char *rule, *right, *wrong;
  } bugs[] = {
      {"BVALID_RESET", "      s_bvalid <= 0;\n", ""},
      {"RVALID_RESET", "      s_rvalid <= 0;\n", ""},
      {"BVALID_STABLE", "s_bvalid && s_bready", "s_bvalid"},
      {"RVALID_STABLE", "else if (s_rready)", "else"},
      {"BRESP_STABLE", "s_bresp = 2'b00", "s_bresp = {s_awvalid, 1'b0}"},
      {"RRESP_STABLE", "s_rresp = 2'b00", "s_rresp = {s_arvalid, 1'b0}"},
      {"RDATA_STABLE", "else if (s_rready)",
       "else if (s_wvalid) s_rdata <= s_wdata; else if (s_rready)"},
      {"BRESP_AW", "has_address && has_data &&", "has_data &&"},
      {"BRESP_WLAST", "has_address && has_data &&", "has_address &&"},
      {"RID", "s_arvalid && s_arready", "!s_rvalid && s_araddr == 5"},
      {"BRESP_EXOKAY", "s_bresp = 2'b00", "s_bresp = 2'b01"},
      {"RRESP_EXOKAY", "s_rresp = 2'b00", "s_rresp = 2'b01"},
  };
  for (const auto& bug : bugs) {
    const std::string rules = broken(lite, bug.right, bug.wrong);
    BOOST_TEST(rules.find(std::string("s_AXI4_ERRS_") + bug.rule + " ") != std::string::npos,
               bug.rule << ": " << rules);
  }
}

BOOST_AUTO_TEST_CASE(each_rule_of_axi4_stream_finds_its_bug) {
  const std::string prefix = "out_AXI4STREAM_ERRM_";
  BOOST_TEST(broken(stream, "out_tvalid <= 0;", "") == prefix + "TVALID_RESET ");
  BOOST_TEST(broken(stream, "= !out_tvalid || out_tready", "= 1") == prefix + "TVALID_STABLE ");
  BOOST_TEST(broken(stream, "out_tlast = beats == 7", "out_tlast = count == 7") ==
             prefix + "TDATA_STABLE " + prefix + "TKEEP_STABLE " + prefix + "TLAST_STABLE ");
  BOOST_TEST(broken(stream, "{!out_tlast, 1'b1}", "2'b11") == prefix + "TDATA_STABLE ");
}

BOOST_AUTO_TEST_SUITE_END()
