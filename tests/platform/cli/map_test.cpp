#include <cli/commands.h>
#include <vp/text.h>
#include <boost/test/unit_test.hpp>

#include "cli_kit.h"

using namespace cli_test;

namespace {

/// A memory, and two timers of one kind.
platform::facts::HardwareMap small_map() {
  using Map = platform::facts::HardwareMap;
  static const int kind = 0, bits = 0;
  const std::vector<Map::Field> fields{{"ON", 0x8000'0001, "rw", 1, "On | off"},
                                       {"LEVEL", 0x0000'0FF0, "w1c", 0x12, "How much"}};
  const Map::Device memory{"ddr",      "DDR memory",   "ps.ddr", 0x10'0000,
                           511u << 20, "its own port", {},       {}};
  const Map::Device timer{
      "timer",
      "a timer",
      "ps.timer.registers",
      0xF000'0000,
      0x100,
      "bus",
      {{"CONTROL", 0x10, 0x121, 0x121, true, 0x121, "rw", 0xF, "Control", fields, &bits},
       {"CONTROL_2", 0x14, 0, 0, true, 0, "rw", 0xF, "Control", fields, &bits},
       {"LOAD", 0, 5, 0, true, 0x123, "rw", 0xFFFF, "Start value"},
       {"STATUS", 0xC, 1, 0, false, 0, "w1c", 0x1, "Event | flag"}},
      &kind};
  Map::Device second = timer;
  second.name = "timer_1";
  second.base = 0xF000'1000;
  return {{memory, timer, second}, {}, {}};
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(map_command, Terminal)

BOOST_AUTO_TEST_CASE(overview) {
  BOOST_TEST(run({"map"}) == 0);
  BOOST_TEST(contains(out, "0x00100000..0x1FFFFFFF   511 MiB  ddr"), out);
  BOOST_TEST(contains(out, "0xF8F00600..0xF8F006FF     256 B  private_timer      private_bus"),
             out);
  BOOST_TEST(contains(out, "29  ps.private_timer.irq"));
  BOOST_TEST(contains(out, "50 MHz  FPGA1_CLK_CTRL\n"));
  BOOST_TEST(!contains(out, "GPIO_DATA"));
  for (const std::string& line : vp::split(out, '\n')) BOOST_TEST(line.size() <= 112u, line);
  BOOST_TEST(err == "");
}

BOOST_AUTO_TEST_CASE(the_configuration_counts) {
  BOOST_TEST(run({"map", "--set", "clocks=exact", "--set", "ps.cpu_clk.frequency=850 MHz", "--set",
                  "pl.axi_gpio_1.base_address=0x41220000"}) == 0);
  BOOST_TEST(contains(out,
                      "850 MHz  ARM_CLK_CTRL (now it gives 666.666667 MHz: from the first "
                      "write on)"),
             out);
  BOOST_TEST(contains(out, "0x41220000..0x4122FFFF    64 KiB  axi_gpio_1"), out);
  BOOST_TEST(run({"map", "--set", "pl.widht=42 px"}) == 2);
  BOOST_TEST(is_one_line_with(err, "pl.width"), err);
}

BOOST_AUTO_TEST_CASE(one_device) {
  BOOST_TEST(run({"map", "axi_gpio_0"}) == 0);
  BOOST_TEST(contains(out, "axi_gpio_0: AXI GPIO (PG144), 0x41200000 to 0x4120FFFF"), out);
  BOOST_TEST(contains(out, "\n0x41200000  GPIO_DATA "));
  BOOST_TEST(contains(out, "Channel 1 direction of each bit: 0 output, 1 input\n"));
  BOOST_TEST(contains(out,
                      "Global interrupt enable [not in this build]\n"
                      "              31  Global_Interrupt_Enable rw   0x0         1: "));
  BOOST_TEST(!contains(out, "DDR memory"));
  BOOST_TEST(run({"map", "slcr"}) == 0);
  BOOST_TEST(contains(out,
                      "DDR PLL: feedback divisor, bypass, power-down, reset [bits as in "
                      "ARM_PLL_CTRL] [0x00020008 at the start]\n"),
             out);
  BOOST_TEST(run({"map", "ddr"}) == 0);
  BOOST_TEST(contains(out, "memory, no registers"));
}

BOOST_AUTO_TEST_CASE(all_registers) {
  BOOST_TEST(run({"map", "--registers"}) == 0);
  BOOST_TEST(contains(out, "\n0x41200000  GPIO_DATA "));
  BOOST_TEST(contains(out, "\n0x41210000  GPIO_DATA "));
  BOOST_TEST(contains(out, "29  ps.private_timer.irq"));
}

BOOST_AUTO_TEST_CASE(the_device_tree_is_printed_or_written) {
  BOOST_TEST(run({"map", "--device-tree"}) == 0);
  const std::string tree = out;
  BOOST_TEST(tree.rfind("/dts-v1/;\n\n/ {\n", 0) == 0);
  BOOST_TEST(contains(tree, "\taxi_dma_1: dma@40410000 {\n"));
  BOOST_TEST(contains(tree, "\t\t\tinterrupts = <0 30 4>;\n"));
  BOOST_TEST(contains(tree, "\tuart1: serial@e0001000 {\n"));
  BOOST_TEST(!contains(tree, "c-addr-width"));
  BOOST_TEST(run({"map", "--device-tree", folder / "thesis.dts"}) == 0);
  BOOST_TEST(kit::read_file(folder / "thesis.dts") == tree);
  BOOST_TEST(run({"map", "--device-tree", folder / "nowhere/thesis.dts"}) == 2);
}

BOOST_AUTO_TEST_CASE(bits_of_a_field) {
  using platform::cli::bits_text;
  BOOST_TEST(bits_text(1) == "0");
  BOOST_TEST(bits_text(0xFFFFFFFF) == "31:0");
  BOOST_TEST(bits_text(0x80F0000C) == "31, 23:20, 3:2");
  BOOST_TEST(bits_text(0xAAAAAAAA) == "0xAAAAAAAA", "too many to name");
}

BOOST_AUTO_TEST_CASE(xparameters) {
  BOOST_TEST(run({"map", "--xparameters"}) == 0);
  BOOST_TEST(contains(out, "#define XPAR_AXI_GPIO_0_BASEADDR 0x41200000U\n"), out);
}

BOOST_AUTO_TEST_CASE(page_of_the_documentation) {
  const std::string page = platform::cli::map_as_markdown(small_map());
  for (const char* part :
       {"# Registers\n", "| 0x0010_0000 … 0x1FFF_FFFF | 511 MiB | `ddr` | DDR memory |",
        "\n## a timer\n\n`timer` at 0xF000_0000, `timer_1` at 0xF000_1000.",
        "| 0x000 | LOAD | rw | 0x0000_0005 | 0x0000_FFFF | Start value; 0x0000_0123 at the start |",
        "\n| CONTROL | 31, 0 | ON | rw | 0x1 | On \\| off |\n",
        "| 0x014 | CONTROL_2 | rw | 0x0000_0000 | 0x0000_000F | Control; bits as in CONTROL |",
        "| Event \\| flag |", "\n| 0xF800_6000 | DDR memory controller",
        "\n| 0xF800_0000 | System level control registers |\n"}) {
    BOOST_TEST(contains(page, part), part << " in " << page);
  }
  const std::size_t first = page.find("## a timer");
  BOOST_TEST(page.find("## a timer", first + 1) == std::string::npos, "once for a kind");
}

BOOST_AUTO_TEST_CASE(unknown_device) {
  BOOST_TEST(run({"map", "axi_gpoi_0"}) == 2);
  BOOST_TEST(is_one_line_with(err,
                              "unknown device 'axi_gpoi_0': did you mean 'axi_gpio_0'? there are "
                              "ocm_low, ddr, stacks, axi_dma_0, "),
             err);
  BOOST_TEST(out == "");
  BOOST_TEST(run({"map", "xyz123abc"}) == 2);
  BOOST_TEST(is_one_line_with(err, "unknown device 'xyz123abc': there are ocm_low, ddr"), err);
}

BOOST_AUTO_TEST_SUITE_END()
