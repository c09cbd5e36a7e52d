// Paths of small netlists, as Yosys writes them: cells and nets to the last digit.
#include <boost/test/unit_test.hpp>

#include "netlist_module.h"

using namespace platform::synthesis;
using kit::Module;
using kit::timing;

BOOST_AUTO_TEST_SUITE(netlist, *boost::unit_test::tolerance(1e-9))

BOOST_AUTO_TEST_CASE(the_net_before_a_lut_leaves_the_slice_the_one_behind_it_does_not) {
  Module module;
  module.flip_flop(0, 2);
  module.lut(2, 3);
  module.lut(3, 4);
  module.flip_flop(4, 5);
  module.name(2, "count");
  module.name(5, "total");
  const Netlist netlist = module.read();
  BOOST_REQUIRE(netlist.longest.has_value());
  BOOST_TEST(netlist.longest->cells_ns == timing["ff_out"] + 2 * timing["lut"]);
  BOOST_TEST(netlist.longest->setup_ns == timing["ff_data"]);
  BOOST_TEST(netlist.longest->nets == 2u);
  BOOST_TEST(netlist.longest->fan_out == 1u);
  BOOST_TEST(netlist.longest->from == "count");
  BOOST_TEST(netlist.longest->to == "total");
  BOOST_TEST(netlist.cells.lut == 2u);
  BOOST_TEST(netlist.cells.ff == 2u);
}

BOOST_AUTO_TEST_CASE(a_carry_chain_is_entered_through_a_lut_and_ripples_without_nets) {
  Module module;
  module.flip_flop(30, 2);
  module.lut(2, 3);
  module.add(
      "CARRY4",
      {{"CI", {"0"}}, {"CYINIT", {"0"}}, {"DI", {"0", "0", "0", "0"}}, {"S", {3, "0", "0", "0"}}},
      {{"CO", {10, 11, 12, 13}}});
  module.add(
      "CARRY4",
      {{"CI", {13}}, {"CYINIT", {"0"}}, {"DI", {"0", "0", "0", "0"}}, {"S", {"0", "0", "0", "0"}}},
      {{"O", {20, 21, 22, 30}}});
  const Netlist netlist = module.read();
  BOOST_REQUIRE(netlist.longest.has_value());
  BOOST_TEST(netlist.longest->cells_ns ==
             timing["ff_out"] + timing["lut"] + timing["carry_enter"] + timing["carry_leave"]);
  BOOST_TEST(netlist.longest->nets == 1u);
  BOOST_TEST(netlist.cells.carry4 == 2u);
  BOOST_TEST(netlist.cells.lut_through == 0u);
}

BOOST_AUTO_TEST_CASE(a_register_enters_a_carry_chain_through_a_lut_that_nobody_wrote) {
  Module module;
  module.flip_flop(30, 2);
  module.lut(2, 3);
  module.add("CARRY4",
             {{"CI", {"0"}}, {"CYINIT", {"0"}}, {"DI", {2, 2, "0", "0"}}, {"S", {3, 2, 2, "1"}}},
             {{"O", {20, 21, 22, 30}}});
  const Netlist netlist = module.read();
  BOOST_TEST(netlist.cells.lut == 1u);
  BOOST_TEST(netlist.cells.lut_through == 2u);
}

// Three of one and two inputs go into one with their neighbours; that of six fills a LUT.
BOOST_AUTO_TEST_CASE(lut_that_share_inputs_are_pairs) {
  Module module;
  module.flip_flop(30, 2);
  module.add("LUT2", {{"I0", {2}}, {"I1", {3}}}, {{"O", {10}}});
  module.add("LUT3", {{"I0", {3}}, {"I1", {4}}, {"I2", {5}}}, {{"O", {11}}});
  module.add("LUT4", {{"I0", {2}}, {"I1", {3}}, {"I2", {4}}, {"I3", {5}}}, {{"O", {12}}});
  module.add("LUT6", {{"I0", {2}}, {"I1", {3}}, {"I2", {4}}, {"I3", {5}}, {"I4", {6}}, {"I5", {7}}},
             {{"O", {13}}});
  module.add("LUT2", {{"I0", {8}}, {"I1", {9}}}, {{"O", {14}}});  // shares nothing
  Cells cells = module.read().cells;
  BOOST_TEST(cells.lut == 5u);
  BOOST_TEST(cells.lut_pairs == 1u);
  module.add("INV", {{"I", {2}}}, {{"O", {15}}});  // goes into the LUT: its input is 2
  module.add("LUT2", {{"I0", {15}}, {"I1", {3}}}, {{"O", {16}}});
  cells = module.read().cells;
  BOOST_TEST(cells.lut_pairs == 2u);
  Module wide;  // four inputs each, six together
  wide.add("LUT4", {{"I0", {2}}, {"I1", {3}}, {"I2", {4}}, {"I3", {5}}}, {{"O", {10}}});
  wide.add("LUT4", {{"I0", {4}}, {"I1", {5}}, {"I2", {6}}, {"I3", {7}}}, {{"O", {11}}});
  BOOST_TEST(wide.read().cells.lut_pairs == 0u);
}

BOOST_AUTO_TEST_CASE(sum_bits_depend_on_lower_bits_only) {
  Module module;
  module.flip_flop(20, 2);  // its own sum: S and O of bit 0
  module.add(
      "CARRY4",
      {{"CI", {"0"}}, {"CYINIT", {"0"}}, {"DI", {"0", 2, "0", "0"}}, {"S", {2, "0", "0", "0"}}},
      {{"O", {20, 21, 22, 23}}});
  BOOST_TEST(module.read().longest->cells_ns == timing["ff_out"] + timing["carry_cross"]);
  Module above;  // DI of bit 1 does not reach bit 0
  above.flip_flop(20, 2);
  above.add(
      "CARRY4",
      {{"CI", {"0"}}, {"CYINIT", {"0"}}, {"DI", {"0", 2, "0", "0"}}, {"S", {"0", "0", "0", "0"}}},
      {{"O", {20, 21, 22, 23}}});
  BOOST_TEST(!above.read().longest.has_value());
}

BOOST_AUTO_TEST_CASE(an_enable_is_further_away_than_data) {
  Module module;
  module.lut(2, 3);
  module.add("FDRE", {{"C", {1}}, {"D", {"0"}}, {"CE", {3}}}, {{"Q", {2}}});
  const Netlist netlist = module.read();
  BOOST_TEST(netlist.longest->setup_ns == timing["ff_enable"]);
  BOOST_TEST(netlist.longest->nets == 2u);
}

BOOST_AUTO_TEST_CASE(a_short_path_with_a_large_fan_out_can_be_the_longest) {
  Module module;
  module.flip_flop(5, 2);
  for (int bit = 2; bit < 5; ++bit) module.lut(bit, bit + 1);  // three nets of fan-out 1
  module.flip_flop(1002, 1000);
  module.lut(1000, 1002);
  module.lut(1000, 1001);
  Netlist netlist = module.read();
  BOOST_TEST(netlist.longest->nets == 3u);
  for (int bit = 2000; bit < 2400; ++bit) module.lut(1000, bit);
  netlist = module.read();
  BOOST_TEST(netlist.longest->nets == 1u);
  BOOST_TEST(netlist.longest->fan_out == 402u);
}

BOOST_AUTO_TEST_CASE(distributed_memory_is_read_in_the_clock) {
  Module module;
  module.add("RAM32X1D", {{"WCLK", {1}}, {"DPRA0", {2}}, {"D", {"0"}}, {"WE", {"0"}}},
             {{"DPO", {3}}});
  module.flip_flop(3, 2);
  const Netlist netlist = module.read();
  BOOST_TEST(netlist.longest->cells_ns ==
             std::max(timing["ff_out"] + timing["lutram_read"], timing["lutram_out"]));
  BOOST_TEST(netlist.cells.lut_memory == 2u);
}

BOOST_AUTO_TEST_CASE(a_product_without_register_goes_through) {
  Module module;
  module.flip_flop(3, 2);
  module.add("DSP48E1", {{"CLK", {1}}, {"A", {2}}}, {{"P", {3}}});
  BOOST_TEST(module.read().longest->cells_ns == timing["ff_out"] + timing["dsp_through"]);
  module.cells["$1"]["parameters"]["PREG"] = "00000000000000000000000000000001";
  BOOST_TEST(module.read().longest->cells_ns == timing["ff_out"]);
  BOOST_TEST(module.read().longest->setup_ns == timing["dsp_setup"]);
}

BOOST_AUTO_TEST_CASE(without_a_path_there_is_no_longest_one) {
  Module module;
  module.add("IBUF", {{"I", {2}}}, {{"O", {3}}});
  module.flip_flop(3, 4);
  BOOST_TEST(!module.read().longest.has_value());
}

BOOST_AUTO_TEST_CASE(loops_foreign_cells_and_missing_modules_are_refused) {
  Module loop;
  loop.lut(2, 3);
  loop.lut(3, 2);
  loop.name(3, "again");
  loop.name(2, "again_too");
  BOOST_TEST(loop.refusal().find("a combinational loop goes through 'again") != std::string::npos);
  Module foreign;
  foreign.add("$mul", {{"A", {2}}}, {{"Y", {3}}});
  BOOST_TEST(foreign.refusal().find("'$mul' is left after synthesis") != std::string::npos);
  const kit::TemporaryFolder folder;
  kit::write_file(folder / "netlist.json", R"({"modules": {}})");
  BOOST_CHECK_THROW(read_netlist(folder / "netlist.json", "top", timing), vp::InputError);
}

BOOST_AUTO_TEST_SUITE_END()
