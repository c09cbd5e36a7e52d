// Designs in YAML: what a file says, and errors with its line and the nearest name.
#include <chip/block_design/design_file.h>
#include <boost/test/unit_test.hpp>

#include <string>

#include "input_error.h"

using namespace platform::block_design;

namespace {

constexpr const char* text = R"(name: blinker
settings:
  device: xc7z010-1
  ps: {uart0: {enabled: false}}
parts:
  ps:
    ip: xilinx.com:ip:processing_system7:5.5
  axi_gpio_0:
    ip: xilinx.com:ip:axi_gpio:2.0
    parameters:
      C_GPIO_WIDTH: 4
    pins:
      s_axi_aclk: ps.FCLK_CLK0
      gpio_io_i: external.buttons
    buses:
      S_AXI: ps.M_AXI_GP0
addresses:
  ps.M_AXI_GP0:
    axi_gpio_0.S_AXI: [0x41200000, 64 KiB]
external:
  buttons: {width: 4, level: 0x5}
)";

/// What is said of the design with `by` in the place of `what`.
std::string error_with(const std::string& what, const std::string& by) {
  std::string changed = text;
  const std::size_t at = changed.find(what);
  BOOST_TEST_REQUIRE(at != std::string::npos);
  changed.replace(at, what.size(), by);
  return input_error([&] { parse_design(changed, "d.yaml"); });
}

}  // namespace

BOOST_AUTO_TEST_SUITE(design_file)

BOOST_AUTO_TEST_CASE(what_a_file_says) {
  const DesignFile design = parse_design(text, "d.yaml");
  BOOST_TEST(design.name == "blinker");
  BOOST_TEST_REQUIRE(design.settings.size() == 2u);
  BOOST_TEST(design.settings[1].first == "ps.uart0.enabled");
  const PlacedPart& gpio = *design.part("axi_gpio_0");
  BOOST_TEST(gpio.parameters.at("C_GPIO_WIDTH") == "4");
  BOOST_TEST(gpio.pins.at("gpio_io_i").text() == "external.buttons");
  BOOST_TEST(gpio.place == "d.yaml:8");
  BOOST_TEST(design.addresses.front().base == 0x4120'0000u);
  BOOST_TEST(design.addresses.front().size == 0x1'0000u);
  BOOST_TEST(design.pin("buttons")->level == 5u);
}

BOOST_AUTO_TEST_CASE(a_slave_in_two_places) {
  std::string two = text;
  two.replace(two.find("[0x41200000, 64 KiB]"), 20, "[[0x41200000, 64 KiB], [0x41300000, 4 KiB]]");
  const DesignFile design = parse_design(two, "d.yaml");
  BOOST_TEST_REQUIRE(design.addresses.size() == 2u);
  BOOST_TEST(design.addresses[1].base == 0x4130'0000u);
  BOOST_TEST(design.addresses[1].size == 4096u);
}

BOOST_AUTO_TEST_CASE(errors_have_line_and_nearest_name) {
  BOOST_TEST(
      error_with("ip: xilinx.com:ip:axi_gpio", "pi: xilinx.com:ip:axi_gpio") ==
      "d.yaml:9: unknown key 'pi' of a part: did you mean 'ip'? there are as, buses, clocks, ip, "
      "parameters, pins, rtl");
  BOOST_TEST(error_with("C_GPIO_WIDTH", "C_GPIO_WIDHT") ==
             "d.yaml:11: axi_gpio has no parameter 'C_GPIO_WIDHT' that matters: did you mean "
             "'C_GPIO_WIDTH'?");
  BOOST_TEST(error_with("external.buttons", "external.button") ==
             "d.yaml:14: axi_gpio_0.gpio_io_i is driven by 'external.button': no such pin under "
             "'external', did you mean 'buttons'?");
  BOOST_TEST(error_with("S_AXI: ps.M", "S_AXI: pss.M") ==
             "d.yaml:16: axi_gpio_0.S_AXI is joined to 'pss.M_AXI_GP0': no such part, did you mean "
             "'ps'?");
  BOOST_TEST(error_with("axi_gpio_0.S_AXI:", "axi_gpio_1.S_AXI:") ==
             "d.yaml:19: the slave 'axi_gpio_1.S_AXI': no such part, did you mean 'axi_gpio_0'?");
}

BOOST_AUTO_TEST_CASE(what_a_design_delivers) {
  const std::string work = text + std::string("work: {unit: packet, ends: axi_gpio_0.irq}\n");
  BOOST_TEST(parse_design(work, "d.yaml").unit.end.text() == "axi_gpio_0.irq");
  BOOST_TEST(error_with("name: blinker", "name: blinker\nwork: {line: done}") ==
             "d.yaml:2: 'work' needs the 'unit' that the design delivers");
  BOOST_TEST(error_with("name: blinker",
                        "name: blinker\nwork: {unit: packet, line: done, ends: axi_gpio_0.irq}")
                 .find("not both") != std::string::npos);
  BOOST_TEST(error_with("name: blinker", "name: blinker\nwork: {unit: packet, ends: axi_gpo_0.irq}")
                 .find("did you mean 'axi_gpio_0'?") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(values_that_cannot_be) {
  BOOST_TEST(error_with("[0x41200000, 64 KiB]", "0x41200000")
                 .find("d.yaml:19: where 'axi_gpio_0.S_AXI' is: write [base, size]") == 0u);
  BOOST_TEST(error_with("[0x41200000, 64 KiB]", "[[0x41200000, 64 KiB], [0x41300000]]")
                 .find("d.yaml:19: where") == 0u);
  BOOST_TEST(error_with("64 KiB", "0 B").find("does not lie within 32 bits") != std::string::npos);
  BOOST_TEST(error_with("64 KiB", "64 Hz").find("d.yaml:19: '64 Hz' for the size") == 0u);
  BOOST_TEST(error_with("level: 0x5", "level: 0x55").find("more bits than the pin") !=
             std::string::npos);
  BOOST_TEST(error_with("width: 4, ", "width: 65, ").find("from 1 to 64") != std::string::npos);
  BOOST_TEST(error_with("  ps:\n    ip: xilinx.com:ip:processing_system7:5.5\n",
                        "  ps:\n    ip: xilinx.com:ip:xlconstant:1.1\n")
                 .find("has one processing_system7 among its parts, this one has 0") !=
             std::string::npos);
  BOOST_TEST(error_with("axi_gpio_0:\n", "axi-gpio:\n").find("letters, digits and '_'") !=
             std::string::npos);
  BOOST_TEST(error_with("name: blinker\n", "").find("needs a 'name'") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_way_to_build_an_ip_that_is_not_modelled) {
  const std::string dma =
      "  d:\n    ip: xilinx.com:ip:axi_dma:7.1\n    parameters: {C_ENABLE_MULTI_CHANNEL: 1}\n";
  std::string with_dma = text;
  with_dma.replace(with_dma.find("  ps:\n"), 0, dma);
  BOOST_TEST(
      input_error([&] { parse_design(with_dma, "d.yaml"); }) ==
      "d.yaml:8: d: C_ENABLE_MULTI_CHANNEL = 1 is not modelled, but 0; 'as: stub' leaves the "
      "part out");
  with_dma.replace(with_dma.find("    parameters"), 0, "    as: stub\n");
  BOOST_TEST(input_error([&] { parse_design(with_dma, "d.yaml"); }) == "nothing thrown");
}

BOOST_AUTO_TEST_SUITE_END()
