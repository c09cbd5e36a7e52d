// What a netlist's clocks are, how fast the chip lets them be, and what Fmax does not cover.
#include <boost/test/unit_test.hpp>

#include "netlist_module.h"

using namespace platform::synthesis;
using kit::Json;
using kit::Module;
using kit::timing;

namespace {

/// Two registers with a LUT and two nets between them, so that a path is covered.
Module plain() {
  Module module;
  module.name(1, "clk");
  module.flip_flop(0, 2);
  module.lut(2, 3);
  module.lut(3, 4);
  module.flip_flop(4, 5);
  return module;
}

std::string not_covered(const Module& module) {
  std::string all;
  for (const std::string& text : module.read().not_covered) all += text + "\n";
  return all;
}

void check_says(const Module& module, const std::string& part) {
  const std::string said = not_covered(module);
  BOOST_TEST(said.find(part) != std::string::npos, said << " without " << part);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(clocks)

BOOST_AUTO_TEST_CASE(registers_of_one_clock_are_covered) {
  Module module = plain();
  BOOST_TEST(not_covered(module) == "");
  module.add("IBUF", {{"I", {100}}}, {{"O", {101}}});
  module.add("BUFG", {{"I", {101}}}, {{"O", {102}}});
  module.name(100, "clk");
  Module buffered;
  buffered.cells = module.cells;
  for (auto& [name, cell] : buffered.cells.items()) {
    if (cell["type"] == "FDRE") cell["connections"]["C"] = {102};
  }
  buffered.names = {{"clk", {{"bits", {100}}}}};
  BOOST_TEST(not_covered(buffered) == "");
}

BOOST_AUTO_TEST_CASE(a_path_slower_than_the_chip_keeps_its_range) {
  Module module;
  module.flip_flop(0, 2);
  for (int bit = 2; bit < 8; ++bit) module.lut(bit, bit + 1);
  module.flip_flop(8, 9);
  const Netlist netlist = module.read();
  BOOST_TEST(netlist.fmax(timing)->mhz.high == timing.fmax(*netlist.longest).high);
  BOOST_TEST(netlist.fmax(timing)->limited_by == "");
}

BOOST_AUTO_TEST_CASE(a_single_net_is_no_faster_than_a_clock_buffer_and_not_covered) {
  Module module;
  module.flip_flop(0, 2);
  module.flip_flop(2, 3);
  const Netlist netlist = module.read();
  const std::optional<Fmax> fmax = netlist.fmax(timing);
  BOOST_REQUIRE(fmax.has_value());
  BOOST_TEST(timing.fmax(*netlist.longest).low > 464);
  BOOST_TEST(fmax->mhz.low == 464.0);
  BOOST_TEST(fmax->mhz.high == 464.0);
  BOOST_TEST(fmax->limited_by == "global clock buffer (BUFG)");
  check_says(module, "single net");
  module.lut(2, 10);  // a net and a LUT beside the register that it enters: still one net
  module.flip_flop(10, 11);
  check_says(module, "single net");
}

BOOST_AUTO_TEST_CASE(a_clock_that_a_register_makes_is_named) {
  Module module = plain();
  module.lut(6, 7);
  module.flip_flop(7, 6);
  module.name(6, "half");
  module.flip_flop(4, 8, 6);
  check_says(module, "the clock 'half' is made by a register");
  check_says(module, "several clocks, 'clk', 'half'");
}

BOOST_AUTO_TEST_CASE(a_clock_out_of_logic_is_named_and_one_through_an_inverter_is_the_other_edge) {
  Module gated = plain();
  gated.add("LUT2", {{"I0", {1}}, {"I1", {9}}}, {{"O", {6}}});
  gated.name(6, "gated");
  gated.flip_flop(4, 8, 6);
  check_says(gated, "the clock 'gated' comes out of logic");
  Module inverted = plain();
  inverted.add("INV", {{"I", {1}}}, {{"O", {6}}});
  inverted.flip_flop(4, 8, 6);
  BOOST_TEST(not_covered(inverted).find("out of logic") == std::string::npos);
  check_says(inverted, "both edges of 'clk'");
  Module falling = plain();
  falling.add("FDRE_1", {{"C", {1}}, {"D", {4}}}, {{"Q", {8}}});
  check_says(falling, "both edges of 'clk'");
  Module twice = plain();  // inverted, and at the falling edge: the same as all
  twice.add("INV", {{"I", {1}}}, {{"O", {6}}});
  twice.add("FDRE_1", {{"C", {6}}, {"D", {4}}}, {{"Q", {8}}});
  BOOST_TEST(not_covered(twice) == "");
}

BOOST_AUTO_TEST_CASE(buffers_that_gate_choose_or_divide_are_named) {
  Module gate = plain();
  gate.add("BUFGCE", {{"I", {1}}, {"CE", {9}}}, {{"O", {6}}});
  gate.flip_flop(4, 8, 6);
  check_says(gate, "the clock 'clk' is gated by a buffer");
  Module choice = plain();
  choice.add("BUFGMUX", {{"I0", {1}}, {"I1", {9}}, {"S", {10}}}, {{"O", {6}}});
  choice.name(6, "chosen");
  choice.flip_flop(4, 8, 6);
  check_says(choice, "the clock 'chosen' is chosen among several");
  Module divided = plain();
  divided.add("BUFR", {{"I", {1}}}, {{"O", {6}}});
  divided.cells.back()["parameters"]["BUFR_DIVIDE"] = "4";
  divided.name(6, "quarter");
  divided.flip_flop(4, 8, 6);
  check_says(divided, "the clock 'quarter' is made by a register");
}

BOOST_AUTO_TEST_CASE(a_latch_ends_a_path_and_is_named) {
  Module module = plain();
  module.add("LDCE", {{"D", {5}}, {"G", {9}}, {"GE", {"1"}}, {"CLR", {"0"}}}, {{"Q", {6}}});
  module.cells.back()["attributes"] = {
      {"src", "/a/own.v:7.3-8.9|/share/yosys/xilinx/ff_map.v:1.2"}};
  module.name(6, "held");
  check_says(module, "a latch holds 'held' (own.v:7)");
  BOOST_TEST(module.read().cells.ff == 3u);
  BOOST_TEST(not_covered(module).find("clocks") == std::string::npos);
}

BOOST_AUTO_TEST_CASE(two_clocks_from_outside_are_named) {
  Module module = plain();
  module.flip_flop(4, 8, 12);
  module.name(12, "pixel_clk");
  check_says(module, "several clocks, 'clk', 'pixel_clk': paths from one to another");
}

BOOST_AUTO_TEST_CASE(memory_and_multipliers_have_limits_of_their_own) {
  const auto limit_with = [](const char* type, const Json& parameters) {
    Module module = plain();
    module.add(type, {{"CLK", {1}}, {"CLKARDCLK", {1}}}, Json::object());
    module.cells.back()["parameters"] = parameters;
    return module.read().limit.mhz;
  };
  BOOST_TEST(limit_with("RAMB18E1", {{"WRITE_MODE_A", "WRITE_FIRST"}}) == 388.2);
  BOOST_TEST(limit_with("RAMB36E1", {{"WRITE_MODE_A", "READ_FIRST"}}) == 339.7);
  BOOST_TEST(limit_with("RAMB36E1", {{"WRITE_MODE_A", "READ_FIRST"},
                                     {"RDADDR_COLLISION_HWCONFIG", "PERFORMANCE"}}) == 388.2);
  BOOST_TEST(limit_with("RAMB36E1", {{"RAM_EXTENSION_A", "LOWER"}}) == 345.8);
  BOOST_TEST(limit_with("DSP48E1", {{"PREG", "01"}, {"MREG", "01"}}) == 464.0);
  BOOST_TEST(limit_with("DSP48E1", {{"PREG", "01"}, {"MREG", "00"}}) == 257.5);
}

BOOST_AUTO_TEST_CASE(only_regional_buffers_are_faster_than_a_global_one) {
  Module module;
  module.add("BUFR", {{"I", {1}}}, {{"O", {6}}});
  module.flip_flop(0, 2, 6);
  module.flip_flop(2, 3, 6);
  BOOST_TEST(module.read().limit.mhz == 600.0);
  module.flip_flop(2, 4, 1);
  BOOST_TEST(module.read().limit.mhz == 464.0);
}

BOOST_AUTO_TEST_SUITE_END()
