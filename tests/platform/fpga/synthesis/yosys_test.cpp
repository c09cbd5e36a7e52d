// Small modules through Yosys: figures, and what is refused with file and line.
#include <fpga/synthesis/synthesis.h>

#include <stdlib.h>
#include <sys/mount.h>

#include <host/digest.h>
#include <boost/test/unit_test.hpp>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include <vp/error.h>

#include "temporary_files.h"

using namespace platform::synthesis;

namespace {

const PathTiming timing = PathTiming::load(std::string(MARKERVP_DATA) + "/rtl/xc7.json");

struct Source {
  Design design(const std::string& text, const std::string& top,
                const Parameters& parameters = {}) {
    kit::write_file(folder / "own.sv", text);
    return {top, top, sources_in(folder.path()), parameters};
  }
  /// What Fmax does not cover of the module `own`, a line each.
  std::string not_covered(const std::string& text) {
    std::string lines;
    for (const std::string& what : synthesise(design(text, "own"), timing).netlist.not_covered)
      lines += what + "\n";
    return lines;
  }
  std::string refusal(const std::string& text, const std::string& top = "own",
                      const Parameters& parameters = {}) {
    try {
      synthesise(design(text, top, parameters), timing);
    } catch (const vp::InputError& error) {
      return error.what();
    }
    return "";
  }

  kit::TemporaryFolder folder;
};

const char* const counter = R"(module own #(parameter int BITS = 8) (
  input logic clk, output logic [BITS-1:0] count);
  always_ff @(posedge clk) count <= count + 1'b1;
endmodule
)";

void check_says(const std::string& refusal, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) {
    BOOST_TEST(refusal.find(part) != std::string::npos, refusal << " without " << part);
  }
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(yosys, Source)

BOOST_AUTO_TEST_CASE(a_counter_is_flip_flops_and_a_carry_chain_of_its_width) {
  const Figures narrow = synthesise(design(counter, "own"), timing);
  BOOST_TEST(narrow.netlist.cells.ff == 8u);
  BOOST_TEST(narrow.netlist.cells.carry4 == 2u);
  BOOST_REQUIRE(narrow.netlist.longest.has_value());
  const Figures wide = synthesise(design(counter, "own", {{"BITS", 32}}), timing);
  BOOST_TEST(wide.netlist.cells.ff == 32u);
  BOOST_TEST(wide.netlist.cells.carry4 == 8u);
  BOOST_TEST(timing.fmax(*wide.netlist.longest).nominal <
             timing.fmax(*narrow.netlist.longest).nominal);
}

// What the thesis says of its first form (4.3.4.4), which nothing here was fitted to.
BOOST_AUTO_TEST_CASE(suppression_in_one_clock_is_as_slow_as_the_thesis_found) {
  const Design nms{
      "nms_one_clock", "nms_one_clock", {MARKERVP_TEST_DATA "/rtl/nms_one_clock.sv"}, {}};
  const Figures figures = synthesise(nms, timing);
  BOOST_REQUIRE(figures.netlist.longest.has_value());
  const FmaxRange fmax = timing.fmax(*figures.netlist.longest);
  BOOST_TEST(fmax.low < 36.63);
  BOOST_TEST(fmax.high > 36.63);
}

BOOST_AUTO_TEST_CASE(figures_become_a_file) {
  const Figures figures = synthesise(design(counter, "own", {{"BITS", 12}}), timing);
  const auto json = nlohmann::json::parse(to_json({figures}, "Yosys 0.0", timing));
  BOOST_TEST(json["tool"] == "Yosys 0.0");
  const auto& entry = json["entries"].at(0);
  BOOST_TEST(entry["ip"] == "own");
  BOOST_TEST(entry["parameters"]["BITS"] == 12);
  BOOST_TEST(entry["ff"] == 12);
  BOOST_TEST(entry["fmax_mhz"]["low"].get<double>() < entry["fmax_mhz"]["high"].get<double>());
}

BOOST_AUTO_TEST_CASE(figures_say_what_they_are_of) {
  kit::write_file(folder / "width.svh", "`define STEP 1'b1\n");
  const Design whole = design(
      "`include \"width.svh\"\nmodule own #(parameter int BITS = 8, parameter OFFSET = 3) (\n"
      "  input logic clk, output logic [BITS-1:0] count);\n"
      "  always_ff @(posedge clk) count <= count + `STEP;\nendmodule\n",
      "own", {{"BITS", 12}});
  const Figures figures = synthesise(whole, timing);
  BOOST_TEST(figures.netlist.parameters.at("BITS") == 12u);
  BOOST_TEST(figures.netlist.parameters.at("OFFSET") == 3u, "its default");
  BOOST_TEST(figures.sources.at("own.sv") == platform::host::file_hash(folder / "own.sv"));
  BOOST_TEST(figures.sources.count("width.svh") == 1u);
  const auto entry =
      nlohmann::json::parse(to_json({figures}, "Yosys 0.0", timing))["entries"].at(0);
  BOOST_TEST(entry["built_with"]["BITS"] == 12);
  BOOST_TEST(entry["sources"]["own.sv"] == figures.sources.at("own.sv"));
}

/// Two words of ROM behind an address; each bit of them that differs is logic.
const char* const rom = R"(module own(input clk, at, output reg [7:0] word);
  reg [7:0] words[0:1];
  initial $readmemh("./rom.dat", words);
  always @(posedge clk) word <= words[at];
endmodule
)";

BOOST_AUTO_TEST_CASE(memories_are_read_from_files_below_the_sources) {
  std::filesystem::create_directory(folder / "data");
  kit::write_file(folder / "data/rom.dat", "00\nff\n");
  const Figures figures = synthesise(design(rom, "own"), timing);
  BOOST_TEST(figures.netlist.cells.ff > 0u);
  BOOST_TEST(figures.sources.at("rom.dat") == platform::host::file_hash(folder / "data/rom.dat"));
  kit::write_file(folder / "data/rom.dat", "00\n00\n");
  BOOST_TEST(synthesise(design(rom, "own"), timing).netlist.cells.ff < figures.netlist.cells.ff,
             "the words are those of the file");

  kit::write_file(folder / "data/rom.dat", "00\nff\n");
  const std::string displaying = std::string(rom).replace(
      std::string(rom).find("  initial"), 0, "  initial $display(\"%2d\", 1'b1 + 1);\n");
  BOOST_TEST(synthesise(design(displaying, "own"), timing).netlist.cells.ff ==
             figures.netlist.cells.ff);
}

BOOST_AUTO_TEST_CASE(a_memory_without_its_file_is_refused) {
  check_says(refusal(rom),
             {"own.sv:3: no file './rom.dat' for $readmemh", "its memory would have no words"});
  for (const char* name : {"a", "b"}) {
    std::filesystem::create_directory(folder / name);
    kit::write_file(folder / name + "/rom.dat", std::string("0") + name);
  }
  check_says(refusal(rom), {"own.sv: './rom.dat' may be '", "/a/rom.dat' or '", "which differ"});
}

// Of a type or of none: -5 is less than 0 in both.
BOOST_AUTO_TEST_CASE(a_width_in_the_format_of_a_display_is_no_obstacle) {
  const std::string text = R"(module own (input logic clk, d, output logic q);
  initial $display("width is %2d", 1);
  always_ff @(posedge clk) q <= d;
endmodule
)";
  BOOST_TEST(synthesise(design(text, "own"), timing).netlist.cells.ff == 1u);
}

BOOST_AUTO_TEST_CASE(files_to_include_are_found_or_named) {
  const std::string text =
      "`include \"level.vh\"\nmodule own (input logic clk, output logic q);\n"
      "  always_ff @(posedge clk) q <= `LEVEL ^ `MORE;\nendmodule\n";
  check_says(refusal(text), {"own.sv:1", "level.vh", "--include"});
  const kit::TemporaryFolder other;
  kit::write_file(other / "level.vh", "`define LEVEL q\n");
  Design own = design(text, "own");
  own.includes = {other.path()};
  own.defines = {"MORE=1'b1"};
  const Figures figures = synthesise(own, timing);
  BOOST_TEST(figures.netlist.cells.ff == 1u);
  BOOST_TEST(figures.sources.count("level.vh") == 1u);
  own.defines = {"MORE; shell"};
  BOOST_CHECK_THROW(synthesise(own, timing), vp::InputError);
}

BOOST_AUTO_TEST_CASE(a_memory_with_byte_enables_is_mapped_by_abc) {
  const Figures figures = synthesise(design(R"(module own (
  input logic clk, input logic [3:0] we, input logic [9:0] a, b, input logic [31:0] d,
  output logic [31:0] q);
  logic [31:0] words[1024];
  always_ff @(posedge clk) begin
    for (int i = 0; i < 4; i = i + 1) if (we[i]) words[a][8*i+:8] <= d[8*i+:8];
    q <= words[b];
  end
endmodule
)",
                                            "own"),
                                     timing);
  BOOST_TEST(figures.netlist.cells.ramb36 == 1u);
  BOOST_REQUIRE(!figures.netlist.not_covered.empty());
  check_says(figures.netlist.not_covered.back(), {"ABC9", "yosys#3384"});
}

BOOST_AUTO_TEST_CASE(a_parameter_may_be_negative) {
  for (const std::string type : {"", "int "}) {
    const std::string text =
        "module own #(parameter " + type +
        "SHIFT = 1, parameter BITS = 3) (input logic clk, d, output logic [7:0] q);\n"
        "  if (SHIFT < 0) begin\n    logic [BITS-1:0] taps;\n"
        "    always_ff @(posedge clk) begin taps <= {taps, d}; q <= {8{^taps}}; end\n"
        "  end else begin\n    always_ff @(posedge clk) q <= {8{d}};\n  end\nendmodule\n";
    const auto ff = [&](const Parameters& parameters) {
      return synthesise(design(text, "own", parameters), timing).netlist.cells.ff;
    };
    BOOST_TEST(ff({{"SHIFT", -5}, {"BITS", 4}}) == ff({{"BITS", 4}}) + 4u, type);
    BOOST_TEST(
        synthesise(design(text, "own", {{"SHIFT", -5}}), timing).netlist.parameters.at("SHIFT") ==
        0xFFFF'FFFBu);
  }
}

BOOST_AUTO_TEST_CASE(a_folder_for_temporary_files_may_have_a_space) {
  const std::string place = folder / "a place";
  std::filesystem::create_directory(place);
  const char* const before = std::getenv("TMPDIR");
  const std::string was = before ? before : "";
  ::setenv("TMPDIR", place.c_str(), 1);
  const Figures figures = synthesise(design(counter, "own"), timing);
  const std::string loop = refusal(
      "module own(input logic a, output logic y);\n"
      "  assign y = ~(y & a);\nendmodule\n");
  before ? ::setenv("TMPDIR", was.c_str(), 1) : ::unsetenv("TMPDIR");
  BOOST_TEST(figures.netlist.cells.ff == 8u);
  check_says(loop, {"own.sv:2", "loop"});
  BOOST_TEST(std::filesystem::is_empty(place));
}

// Yosys ends with 0, and its netlist is cut.
BOOST_AUTO_TEST_CASE(a_full_folder_for_temporary_files_is_named) {
  const std::string place = folder / "full";
  std::filesystem::create_directory(place);
  if (::mount("none", place.c_str(), "tmpfs", 0, "size=24k") != 0) {
    BOOST_TEST_MESSAGE("this user may mount nothing");
    return;
  }
  const char* const before = std::getenv("TMPDIR");
  const std::string was = before ? before : "";
  ::setenv("TMPDIR", place.c_str(), 1);
  BOOST_CHECK_EXCEPTION(synthesise(design(counter, "own"), timing), vp::HostError,
                        [&](const vp::HostError& error) {
                          const std::string text = error.what();
                          return text.find("no room is left in '" + place) != text.npos;
                        });
  before ? ::setenv("TMPDIR", was.c_str(), 1) : ::unsetenv("TMPDIR");
  ::umount(place.c_str());
}

BOOST_AUTO_TEST_CASE(a_latch_is_named_with_its_line) {
  check_says(not_covered("module own(input logic e, d, output logic q);\n"
                         "  always @* if (e) q = d;\nendmodule\n"),
             {"a latch holds 'q' (own.sv:2)"});
}

// Yosys infers one for a loop variable that only some ways through a block set; nothing reads it.
BOOST_AUTO_TEST_CASE(a_loop_variable_is_no_latch) {
  BOOST_TEST(not_covered("module own(input logic clk, input logic [7:0] d, output reg [3:0] q);\n"
                         "  integer i;\n  reg [3:0] n;\n"
                         "  always @(*) begin\n    n = 0;\n"
                         "    if (d != 0) for (i = 0; i < 8; i = i + 1) n = n + d[i];\n  end\n"
                         "  always @(posedge clk) q <= n;\nendmodule\n") == "");
}

BOOST_AUTO_TEST_CASE(a_divided_clock_is_named_and_no_faster_than_the_chip) {
  const std::string text =
      "module own(input logic clk, d, output logic q);\n  logic h, p;\n"
      "  always_ff @(posedge clk) begin h <= !h; p <= d; end\n"
      "  always_ff @(posedge h) q <= p;\nendmodule\n";
  check_says(not_covered(text),
             {"the clock 'h' is made by a register (own.sv:3)", "several clocks", "single net"});
  const Figures figures = synthesise(design(text, "own"), timing);
  BOOST_TEST(figures.netlist.fmax(timing)->mhz.high <= timing.limit_mhz("global_buffer"));
  const auto entry = nlohmann::json::parse(to_json({figures}, "any", timing)).at("entries").at(0);
  BOOST_TEST(entry.at("limited_by") == "global clock buffer (BUFG)");
  BOOST_TEST(entry.at("not_covered").size() == 3u);
}

BOOST_AUTO_TEST_CASE(a_gated_clock_and_both_edges_are_named) {
  check_says(not_covered("module own(input logic clk, e, d, output logic q, r);\n"
                         "  wire g = clk & e;\n"
                         "  always_ff @(posedge g) q <= d;\n"
                         "  always_ff @(posedge clk) r <= q;\nendmodule\n"),
             {"the clock 'g' comes out of logic"});
  check_says(not_covered("module own(input logic clk, d, output logic q);\n  logic p;\n"
                         "  always_ff @(negedge clk) p <= d;\n"
                         "  always_ff @(posedge clk) q <= p;\nendmodule\n"),
             {"both edges of 'clk'"});
}

BOOST_AUTO_TEST_CASE(a_combinational_loop_is_named_with_its_line) {
  check_says(refusal("module own(input logic a, output logic y);\n"
                     "  assign y = ~(y & a);\nendmodule\n"),
             {"own.sv:2", "loop"});
}

// Each bit depends on those before it: a loop of words, and none of bits.
BOOST_AUTO_TEST_CASE(the_first_of_several_bits_is_no_loop) {
  const std::string text = R"(module own #(parameter W = 4) (
  input logic clk, input logic [W-1:0] d, output logic [W-1:0] q);
  wire [W-1:0] first;
  for (genvar i = 0; i < W; i++) begin : g
    assign first[i] = d[i] & ~|(first & ({W{1'b1}} >> (W - i)));
  end
  always_ff @(posedge clk) q <= first;
endmodule
)";
  BOOST_TEST(synthesise(design(text, "own"), timing).netlist.cells.ff == 4u);
}

BOOST_AUTO_TEST_CASE(warnings_and_assertions_are_no_obstacle) {
  const std::string text = R"(module own (input logic clk, d, output logic q);
  initial begin $timeformat(-9, 0, " ns", 8); $warning("small"); end
  always_ff @(posedge clk) begin
    q <= d;
    if (d) $error("d is %2d", d);
    assert (d) else $error("no d");
  end
endmodule
)";
  BOOST_TEST(synthesise(design(text, "own"), timing).netlist.cells.ff == 1u);
}

BOOST_AUTO_TEST_CASE(parameters_that_the_rtl_refuses_are_refused_with_its_line) {
  const std::string text = R"(module own #(parameter W = 8) (input logic a, output logic b);
  initial begin
    if (W < 8) begin
      $error("narrow");
      $finish;
    end
  end
  assign b = a;
endmodule
)";
  BOOST_TEST(refusal(text) == "");
  check_says(refusal(text, "own", {{"W", 4}}), {"'own' W=4", "own.sv:4", "$error(\"narrow\");"});
  check_says(refusal(text, "own", {{"W", -4}}), {"'own' W=-4", "own.sv:4"});
}

// A test bench, a fragment, and a module that names the missing one as well.
BOOST_AUTO_TEST_CASE(what_the_top_does_not_need_is_no_obstacle) {
  kit::write_file(folder / "a_bench.v",
                  "module bench; initial @(x) $stop; own u(); gone g(); endmodule\n");
  kit::write_file(folder / "fragment.v", "`ifdef NEVER\n  own u();\n");
  BOOST_TEST(synthesise(design(counter, "own"), timing).netlist.cells.ff == 8u);
  check_says(refusal("module own(input logic a);\n\n  gone g(.a);\nendmodule\n"),
             {"own.sv:3: no module 'gone'"});
  kit::write_file(folder / "twice.sv", "module own(input logic a); endmodule\n");
  check_says(refusal(counter), {"own", "Re-definition"});
}

BOOST_AUTO_TEST_CASE(a_missing_top_gets_the_modules_that_there_are) {
  check_says(refusal(counter, "other"), {"no module 'other'", "own"});
}

BOOST_AUTO_TEST_CASE(what_is_no_verilog_is_named_with_its_line) {
  check_says(refusal("module own(input logic a);\n  wire b = = a;\nendmodule\n"), {"own.sv:2"});
}

BOOST_AUTO_TEST_CASE(systemverilog_that_yosys_does_not_read_is_named) {
  check_says(refusal("module own #(\n  parameter type t = logic) (input t a, output t b);\n"
                     "  assign b = a;\nendmodule\n"),
             {"own.sv:2: ", "Yosys does not read a parameter that is a type", "sv2v"});
  check_says(refusal("package p;\n  localparam N = 1;\nendpackage\n"
                     "module own import p::*; #(parameter M = 1) (input a, output b);\n"
                     "  assign b = a;\nendmodule\n"),
             {"own.sv:4: ", "does not read an import of a package"});
  check_says(refusal("module own(output [7:0] sub [3:0]);\nendmodule\n"),
             {"own.sv:1: ", "does not read an array as a port"});
  check_says(refusal("module own(input a, output b);\n  localparam [1:0] M [0:1] = '{1, 2};\n"
                     "  assign b = M[a];\nendmodule\n"),
             {"own.sv:2: ", "does not read an assignment pattern"});
  const std::string other =
      refusal("module own(input a, output b);\n  assign b = a a;\nendmodule\n");
  check_says(other, {"own.sv:2: ", "syntax error"});
  BOOST_TEST(other.find("does not read") == std::string::npos, other);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_synthesised_is_refused) {
  check_says(refusal("module own(input logic a, output logic y);\n"
                     "  always @* while (a) y = ~y;\nendmodule\n"),
             {"own.sv", "While loops"});
  check_says(
      refusal("module own(input logic a, output logic y);\n  missing m(.a, .y);\nendmodule\n"),
      {"own.sv:2: no module 'missing' in the sources"});
  check_says(
      refusal("module own(input logic d, output logic q);\n"
              "  IDELAYE2 #(.IDELAY_VALUE(3)) delay(.IDATAIN(d), .DATAOUT(q));\nendmodule\n"),
      {"own.sv:2: 'IDELAYE2'", "leave it outside of the module"});
}

BOOST_AUTO_TEST_CASE(primitives_of_the_family_may_stand_in_the_rtl) {
  const Figures figures =
      synthesise(design("module own(input logic clk, d, output logic q);\n  wire c;\n"
                        "  BUFG buffer(.I(clk), .O(c));\n  always_ff @(posedge c) q <= d;\n"
                        "endmodule\n",
                        "own"),
                 timing);
  BOOST_TEST(figures.netlist.cells.ff == 1u);
}

// A switch that leaves all out is seen by what the outputs have.
BOOST_AUTO_TEST_CASE(constant_outputs_are_counted) {
  const std::string text =
      "module own #(parameter ON = 0) (input logic clk, a, output logic p,\n"
      "  output logic [2:0] q);\n  assign p = a;\n"
      "  always_ff @(posedge clk) q <= ON ? {3{a}} : 3'b101;\nendmodule\n";
  const Netlist off = synthesise(design(text, "own"), timing).netlist;
  BOOST_TEST(off.output_bits == 4u);
  BOOST_TEST(off.constant_bits == 3u);
  BOOST_TEST(synthesise(design(text, "own", {{"ON", 1}}), timing).netlist.constant_bits == 0u);
}

// How fast a pin is, the model does not know; the logic behind it is that of the RTL.
BOOST_AUTO_TEST_CASE(a_pin_in_both_directions_is_no_obstacle) {
  const std::string text =
      "module own(input logic clk, en, d, inout wire pin, output logic q);\n"
      "  assign pin = en ? d : 1'bz;\n"
      "  always_ff @(posedge clk) q <= pin;\nendmodule\n";
  BOOST_TEST(synthesise(design(text, "own"), timing).netlist.cells.ff == 1u);
}

BOOST_AUTO_TEST_CASE(a_parameter_that_there_is_not_is_refused) {
  check_says(refusal(counter, "own", {{"WIDTH", 3}}), {"WIDTH"});
}

// A script of Yosys can start programs.
BOOST_AUTO_TEST_CASE(a_name_that_is_none_never_reaches_yosys) {
  const std::string trap = folder / "trap";
  check_says(refusal(counter, "own\n!touch " + trap), {"is no name of a module"});
  check_says(refusal(counter, "own", {{"BITS 3\n!touch " + trap, 3}}),
             {"is no name of a parameter"});
  BOOST_TEST(!std::filesystem::exists(trap));
}

BOOST_AUTO_TEST_CASE(a_folder_without_verilog_and_an_unknown_ip_are_refused) {
  BOOST_CHECK_THROW(sources_in(folder.path()), vp::InputError);
  BOOST_CHECK_THROW(sources_in(folder / "none"), vp::InputError);
}

// Names in comments are no need; a package, and what is instantiated by what is instantiated, are.
BOOST_AUTO_TEST_CASE(only_the_sources_that_a_module_is_made_of_are_needed) {
  const std::map<std::string, std::string> texts{
      {"a_top.sv", "module top;\n  left l();  // as in other\nendmodule\n"},
      {"b_left.sv", "module left;\n  import sizes::*;\n  leaf #(.N(N)) x();\nendmodule\n"},
      {"c_leaf.sv", "/* not\n other */ module leaf #(parameter int N = 1)();\nendmodule\n"},
      {"d_sizes.sv", "package sizes;\n  localparam int N = 2;\nendpackage\n"},
      {"e_other.sv", "module other;\n  leaf x();\nendmodule\n"}};
  for (const auto& [name, text] : texts) kit::write_file(folder / name, text);
  const auto names = [&](const std::string& top) {
    std::string joined;
    for (const auto& source : needed_by(top, sources_in(folder.path())))
      joined += source.filename().string() + " ";
    return joined;
  };
  BOOST_TEST(names("top") == "a_top.sv b_left.sv c_leaf.sv d_sizes.sv ");
  BOOST_TEST(names("other") == "c_leaf.sv e_other.sv ");
  BOOST_TEST(names("none") == "");
}

BOOST_AUTO_TEST_CASE(an_ip_is_read_without_the_others) {
  for (const Design& design : own_designs({"local_threshold"})) {
    std::string joined;
    for (const auto& source : design.sources) joined += source.filename().string() + " ";
    BOOST_TEST(joined == "delay_line.sv local_threshold.sv window_sums.sv ");
  }
}

// The whole set takes minutes: platform_synthesis_figures, of ctest -C nightly.
// Of the small ones; the nightly run makes all of them anew.
BOOST_AUTO_TEST_CASE(the_smallest_of_each_ip_is_what_is_committed) {
  constexpr unsigned most_luts = 200;
  using Json = nlohmann::ordered_json;
  const Json committed =
      Json::parse(kit::read_file(MARKERVP_DATA "/rtl/synthesis.json")).at("entries");
  std::map<std::string, Json> smallest;
  for (const Json& entry : committed) {
    Json& least = smallest[entry.at("ip")];
    if (least.is_null() || entry.at("lut") < least.at("lut")) least = entry;
  }
  std::size_t compared = 0;
  for (const Design& design : own_designs({})) {
    const Json& expected = smallest.at(design.ip);
    if (expected.at("lut") > most_luts || expected.at("parameters") != Json(design.parameters))
      continue;
    const Json made = Json::parse(to_json({synthesise(design, timing)}, "any", timing));
    BOOST_TEST(made.at("entries").at(0) == expected, design.ip);
    ++compared;
  }
  BOOST_TEST(compared == 12u);
}

BOOST_AUTO_TEST_SUITE_END()
