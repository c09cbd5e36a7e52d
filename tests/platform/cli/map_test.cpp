#include <cli/map.h>
#include <vp/text.h>
#include <boost/test/unit_test.hpp>

#include "cli_kit.h"

using namespace cli_test;

BOOST_FIXTURE_TEST_SUITE(map_command, Terminal)

BOOST_AUTO_TEST_CASE(overview) {
  BOOST_TEST(run({"map"}) == 0);
  BOOST_TEST(contains(out.str(), "0x00100000..0x1FFFFFFF   511 MiB  ddr"), out.str());
  BOOST_TEST(contains(out.str(), "0xF0000000..0xF00000FF     256 B  timer"), out.str());
  BOOST_TEST(contains(out.str(), "29  ps.timer.irq"));
  BOOST_TEST(contains(out.str(), "50 MHz  CLK_CTRL\n"));
  BOOST_TEST(contains(out.str(), "CLK_2 (as it stands it gives 8 Hz: from the first write on)"));
  BOOST_TEST(!contains(out.str(), "LOAD"));
  for (const std::string& line : vp::split(out.str(), '\n')) BOOST_TEST(line.size() <= 100u, line);
  BOOST_TEST(err.str() == "");
}

BOOST_AUTO_TEST_CASE(one_device) {
  BOOST_TEST(run({"map", "timer_1"}) == 0);
  BOOST_TEST(contains(out.str(), "timer_1: a timer, 0xF0001000 to 0xF00010FF"), out.str());
  BOOST_TEST(contains(out.str(), "0xF0001000  LOAD "));
  BOOST_TEST(contains(out.str(), "Start value [0x00000123 at the start]"));
  BOOST_TEST(contains(out.str(), "Event | flag [not in this build]"));
  BOOST_TEST(!contains(out.str(), "DDR memory"));
  BOOST_TEST(run({"map", "ddr"}) == 0);
  BOOST_TEST(contains(out.str(), "memory, no registers"));
}

BOOST_AUTO_TEST_CASE(fields) {
  BOOST_TEST(run({"map", "timer"}) == 0);
  BOOST_TEST(
      contains(out.str(), "           31, 0  ON                 rw   0x1         On | off\n"),
      out.str());
  BOOST_TEST(
      contains(out.str(), "            11:4  LEVEL              w1c  0x12        How much\n"));
  BOOST_TEST(contains(out.str(), "Control [bits as in CONTROL]\n"), "once for registers alike");
  BOOST_TEST(run({"map", "--markdown"}) == 0);
  BOOST_TEST(contains(out.str(), "\n| CONTROL | 31, 0 | ON | rw | 0x1 | On \\| off |\n"),
             out.str());
  BOOST_TEST(contains(
      out.str(),
      "| 0x014 | CONTROL_2 | rw | 0x0000_0000 | 0x0000_000F | Control; bits as in CONTROL |"));
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
  BOOST_TEST(out.str() == "#define XPAR_TIMER_BASEADDR 0xF0000000U\n");
}

BOOST_AUTO_TEST_CASE(all_registers) {
  BOOST_TEST(run({"map", "--registers"}) == 0);
  BOOST_TEST(contains(out.str(), "0xF0000000  LOAD "));
  BOOST_TEST(contains(out.str(), "0xF0001000  LOAD "));
  BOOST_TEST(contains(out.str(), "ps.timer.irq"));
}

BOOST_AUTO_TEST_CASE(page_of_the_documentation) {
  BOOST_TEST(run({"map", "--markdown"}) == 0);
  BOOST_TEST(contains(out.str(), "# Registers\n"));
  BOOST_TEST(contains(out.str(), "| 0x0010_0000 … 0x1FFF_FFFF | 511 MiB | `ddr` | DDR memory |"));
  BOOST_TEST(
      contains(out.str(), "\n## a timer\n\n`timer` at 0xF000_0000, `timer_1` at 0xF000_1000."));
  BOOST_TEST(contains(out.str(),
                      "| 0x000 | LOAD | rw | 0x0000_0005 | 0x0000_FFFF | Start value; "
                      "0x0000_0123 at the start |"),
             out.str());
  BOOST_TEST(contains(out.str(), "| Event \\| flag |"), "a bar is no end of a cell");
  BOOST_TEST(contains(out.str(), "\n| 0xF800_6000 | DDR memory controller"));
  BOOST_TEST(contains(out.str(), "\n| 0xF800_0000 | System level control registers |\n"),
             "this platform has none");
  const std::size_t first = out.str().find("## a timer");
  BOOST_TEST(out.str().find("## a timer", first + 1) == std::string::npos, "once for a kind");
}

BOOST_AUTO_TEST_CASE(unknown_device) {
  BOOST_TEST(run({"map", "tiemr"}) == 2);
  BOOST_TEST(is_one_line_with(err.str(),
                              "unknown device 'tiemr': did you mean 'timer'? there are "
                              "ddr, timer, timer_1"),
             err.str());
  BOOST_TEST(out.str() == "");
  BOOST_TEST(run({"map", "xyz123abc"}) == 2);
  BOOST_TEST(is_one_line_with(err.str(), "unknown device 'xyz123abc': there are ddr"), err.str());
}

BOOST_AUTO_TEST_CASE(configuration_counts_and_is_checked) {
  BOOST_TEST(run({"map", "--set", "depth=42"}) == 0);
  BOOST_TEST(run({"map", "--set", "dpeth=42"}) == 2);
  BOOST_TEST(is_one_line_with(err.str(), "depth"), err.str());
}

BOOST_AUTO_TEST_SUITE_END()
