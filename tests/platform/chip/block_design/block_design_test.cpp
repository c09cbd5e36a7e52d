// Designs of YAML, built: addresses, interrupts, clocks, wires, and what is refused.
#include <chip/block_design/import_design.h>
#include <chip/handoff/device_tree.h>
#include <chip/system/hardware_map.h>
#include <vp/error.h>
#include <vp/report.h>
#include <vp/text.h>
#include <xilinx/axi_dma/axi_dma.h>
#include <xilinx/axi_gpio/axi_gpio.h>
#include <xilinx/fabric_clock/fabric_clock.h>
#include <xilinx/proc_sys_reset/proc_sys_reset.h>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "built_design.h"
#include "input_error.h"
#include "small_handoff.h"

using kit::replaced;
using namespace platform;

namespace {

std::string small_design() {
  const auto handoff = handoff::read_hwh(kit::small_handoff().text(), "small.hwh");
  return block_design::import_design(handoff).text;
}

struct Built : kit::BuiltDesign {
  explicit Built(const std::string& text = small_design(),
                 const std::vector<std::string>& settings = {})
      : BuiltDesign(text, settings) {}
};

std::string refusal(const std::string& what, const std::string& by) {
  return input_error([&] { const Built chip(replaced(small_design(), what, by)); });
}

}  // namespace

BOOST_AUTO_TEST_SUITE(built_block_designs)

BOOST_AUTO_TEST_CASE(software_finds_what_the_address_editor_says) {
  Built chip;
  const facts::HardwareMap map = hardware_map(*chip.zynq);
  const auto base = [&](const std::string& name) -> std::uint64_t {
    for (const auto& device : map.devices)
      if (device.name == name) return device.base;
    return 0;
  };
  BOOST_TEST(base("axi_dma_0") == 0x4040'0000u);
  BOOST_TEST(base("axi_gpio_0") == 0x4120'0000u);
  BOOST_TEST(base("own_0") == 0x43C0'0000u);
  BOOST_TEST_REQUIRE(map.interrupts.size() >= 3u);
  const auto source = [&](std::uint32_t id) -> std::string {
    for (const auto& interrupt : map.interrupts)
      if (interrupt.id == id) return interrupt.source;
    return "none";
  };
  BOOST_TEST(source(61) == "pl.axi_dma_0.s2mm_introut");
  BOOST_TEST(source(62) == "pl.axi_dma_0.mm2s_introut");
  BOOST_TEST(source(63) == "pl.axi_gpio_0.ip2intc_irpt");
  const std::string& header = map.xparameters;
  for (const char* line : {"#define XPAR_AXI_DMA_0_BASEADDR 0x40400000U",
                           "#define XPAR_OWN_0_S00_AXI_BASEADDR 0x43C00000U"})
    BOOST_TEST(header.find(line) != std::string::npos, line);
}

BOOST_AUTO_TEST_CASE(parameters_and_clocks_are_those_of_the_hand_off) {
  Built chip;
  BOOST_TEST(chip.part<xilinx::AxiGpio>("axi_gpio_0").gpio.width.get() == 4u);
  BOOST_TEST(chip.part<xilinx::AxiDma>("axi_dma_0").length_width.get() == 20u);
  auto& mmcm = chip.part<xilinx::FabricClock>("clk_0");
  BOOST_TEST(mmcm.output("pixel_clk")->frequency_hz() == 74'250'000u);
  BOOST_TEST(chip.zynq->ps.cpu_clk.clk.frequency_hz() == 650'000'000u);
}

BOOST_AUTO_TEST_CASE(each_of_them_can_be_set) {
  Built chip(small_design(), {"pl.axi_gpio_0.base_address=0x41300000", "pl.axi_gpio_0.gpio_width=8",
                              "ps.fclk_clk0.frequency=80 MHz", "pl.external_buttons.level=9"});
  BOOST_TEST(chip.part<xilinx::AxiGpio>("axi_gpio_0").gpio.width.get() == 8u);
  BOOST_TEST(chip.part<xilinx::FabricClock>("clk_0").output("pixel_clk")->frequency_hz() ==
             59'400'000u);
  sc_core::sc_start(sc_core::sc_time(1, sc_core::SC_US));
  BOOST_TEST(chip.zynq->peek(0x4130'0000).value_or(0) == 9u);
  BOOST_TEST(!chip.zynq->peek(0x4120'0000).has_value());
}

BOOST_AUTO_TEST_CASE(a_stub_makes_the_clocks_that_it_is_said_to_make) {
  const std::string text = replaced(replaced(small_design(), "      slowest_sync_clk: ps.FCLK_CLK0",
                                             "      slowest_sync_clk: own_0.clk_out"),
                                    "    ip: me:user:own:1.0\n",
                                    "    ip: me:user:own:1.0\n    clocks: {clk_out: 12.288 MHz}\n");
  {
    Built chip(text);
    BOOST_TEST(chip.part<xilinx::ProcSysReset>("rst_0").clock().frequency_hz() == 12'288'000u);
  }
  const std::string error = input_error(
      [&] { const Built other(replaced(text, "    clocks: {clk_out: 12.288 MHz}\n", "")); });
  BOOST_TEST(
      error.find("rst_0: none of its clock pins is driven by a clock of a known frequency") !=
          std::string::npos,
      error);
}

BOOST_AUTO_TEST_CASE(an_interrupt_reaches_its_number) {
  Built chip;
  sc_core::sc_start(sc_core::sc_time(1, sc_core::SC_US));
  chip.part<xilinx::AxiGpio>("axi_gpio_0").ip2intc_irpt = true;
  BOOST_TEST(chip.zynq->ps.gic.logic().wire[63]);
  BOOST_TEST(!chip.zynq->ps.gic.logic().wire[61]);
  BOOST_TEST(!chip.zynq->ps.gic.logic().wire[62]);
}

BOOST_AUTO_TEST_CASE(a_private_interrupt_of_the_logic_reaches_its_number) {
  Built chip(replaced(small_design(), "      IRQ_F2P: lines.dout",
                      "      Core0_nIRQ: axi_gpio_0.ip2intc_irpt\n      IRQ_F2P: lines.dout"));
  sc_core::sc_start(sc_core::sc_time(1, sc_core::SC_US));
  BOOST_TEST(!chip.zynq->ps.gic.logic().wire[31]);
  chip.part<xilinx::AxiGpio>("axi_gpio_0").ip2intc_irpt = true;
  BOOST_TEST(chip.zynq->ps.gic.logic().wire[31], "active high at the pin (UG585 table 7-3)");
  BOOST_TEST(!chip.zynq->ps.gic.logic().wire[28]);
  const facts::HardwareMap map = hardware_map(*chip.zynq);
  BOOST_TEST(map.xparameters.find("#define XPAR_FABRIC_AXI_GPIO_0_IP2INTC_IRPT_INTR 31\n") !=
             std::string::npos);
  BOOST_TEST(map.xparameters.find("#define XPAR_AXI_GPIO_0_INTERRUPTS 0x10400f\n") !=
             std::string::npos);
  BOOST_TEST(device_tree::shared_interrupt(31) == (std::vector<std::uint32_t>{1, 15, 0x304}),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(a_private_interrupt_of_core_1_is_warned_of) {
  const auto warnings_of = [](const std::string& source) {
    std::ostringstream text;
    vp::ReportRouter reports;
    reports.redirect(text);
    const std::string design = replaced(small_design(), "parts:\n",
                                        "parts:\n  zero: {ip: 'xilinx.com:ip:xlconstant:1.1'}\n");
    const Built chip(replaced(design, "      IRQ_F2P: lines.dout",
                              "      Core1_nIRQ: " + source + "\n      IRQ_F2P: lines.dout"));
    return reports.count("/markervp/block_design/interrupt");
  };
  BOOST_TEST(warnings_of("axi_gpio_0.ip2intc_irpt") == 1u);
  BOOST_TEST(warnings_of("zero.dout") == 0u);
}

BOOST_AUTO_TEST_CASE(an_interrupt_of_a_stub_is_one_line) {
  const Built chip(replaced(small_design(), "IRQ_F2P: lines.dout", "IRQ_F2P: own_0.done"));
  std::vector<std::uint32_t> ids;
  for (const auto& interrupt : hardware_map(*chip.zynq).interrupts)
    if (interrupt.source == "pl.own_0.done") ids.push_back(interrupt.id);
  BOOST_TEST((ids == std::vector<std::uint32_t>{61}));
}

BOOST_AUTO_TEST_CASE(pins_of_the_ps_lead_through_gates_and_back) {
  const std::string gates =
      "  low: {ip: 'xilinx.com:ip:xlslice:1.0', parameters: {DIN_FROM: 3}, pins: {Din: "
      "ps.GPIO_O}}\n  inverter: {ip: 'xilinx.com:ip:util_vector_logic:2.0', parameters: "
      "{C_OPERATION: not, C_SIZE: 4}, pins: {Op1: low.Dout}}\n";
  Built chip(replaced(replaced(small_design(), "    pins:\n      M_AXI_GP0_ACLK",
                               "    pins:\n      GPIO_I: inverter.Res\n      M_AXI_GP0_ACLK"),
                      "\n# What each master sees", gates + "\n# What each master sees"));
  sc_core::sc_start(sc_core::SC_ZERO_TIME);
  BOOST_TEST(chip.zynq->ps.gpio.emio_gpio_i.read() == 0xFu);
  // The registers of bank 2: direction, output enable, data.
  vp::RegisterBank& bank = chip.zynq->ps.gpio.registers;
  for (const auto& [offset, value] :
       {std::pair<std::uint32_t, std::uint32_t>{0x284, 0x3F}, {0x288, 0x3F}, {0x048, 0x35}}) {
    std::uint32_t word = value;
    bank.access(bank[offset], false, offset, word);
  }
  BOOST_TEST(chip.zynq->ps.gpio.emio_gpio_i.read() == 0xAu);
}

// A processor in the PL has no model, and nothing leads from it to its local memory.
BOOST_AUTO_TEST_CASE(masters_in_stubs_need_no_way) {
  Built chip(replaced(small_design(), "addresses:\n",
                      "addresses:\n  own_0.DLMB:\n    axi_gpio_0.S_AXI: [0x0, 16 KiB]\n"));
  for (const auto& device : hardware_map(*chip.zynq).devices)
    if (device.name == "axi_gpio_0") BOOST_TEST(device.base == 0x4120'0000u);
}

// The bus of such a processor is there all the same, with its memory, which each of its ports may
// see in another place.
BOOST_AUTO_TEST_CASE(a_bus_whose_only_master_is_a_stub_is_built) {
  std::string text = replaced(small_design(), "parts:\n",
                              "parts:\n  soft:\n    ip: xilinx.com:ip:microblaze:11.0\n"
                              "  soft_bus:\n    ip: xilinx.com:ip:axi_interconnect:2.1\n"
                              "    pins: {ACLK: ps.FCLK_CLK0}\n"
                              "    buses: {S00_AXI: soft.M_AXI_DP, S01_AXI: soft.M_AXI_IC}\n"
                              "  soft_memory:\n    ip: xilinx.com:ip:axi_bram_ctrl:4.1\n"
                              "    pins: {s_axi_aclk: ps.FCLK_CLK0}\n"
                              "    buses: {S_AXI: soft_bus.M00_AXI}\n");
  text = replaced(text, "addresses:\n",
                  "addresses:\n  soft.M_AXI_DP:\n    soft_memory.S_AXI: [0x0, 8 KiB]\n"
                  "  soft.M_AXI_IC:\n    soft_memory.S_AXI: [0x10000, 8 KiB]\n");
  const std::string overlap = replaced(text, "[0x10000, 8 KiB]", "[0x1000, 4 KiB]");
  BOOST_TEST(input_error([&] { const Built chip(overlap); }).find("overlaps") != std::string::npos);
  Built chip(text);
  BOOST_CHECK_NO_THROW(sc_core::sc_start(sc_core::sc_time(1, sc_core::SC_US)));
}

BOOST_AUTO_TEST_CASE(stubs_and_memories_have_the_names_of_their_drivers) {
  std::string text = replaced(small_design(), "parts:\n",
                              "parts:\n  video:\n    ip: xilinx.com:ip:axi_vdma:6.3\n"
                              "    as: stub\n    buses: {S_AXI_LITE: periph.M03_AXI}\n"
                              "  shared:\n    ip: xilinx.com:ip:axi_bram_ctrl:4.1\n"
                              "    pins: {s_axi_aclk: ps.FCLK_CLK0}\n"
                              "    buses: {S_AXI: periph.M04_AXI}\n");
  text = replaced(text, "  ps.M_AXI_GP0:\n",
                  "  ps.M_AXI_GP0:\n    video.S_AXI_LITE: [0x43000000, 64 KiB]\n"
                  "    shared.S_AXI: [0x42000000, 8 KiB]\n");
  text = replaced(text, "of_dma.dout\n", "of_dma.dout\n      In2: video.mm2s_introut\n");
  text = replaced(text, "      IN0_WIDTH: 2\n", "      IN0_WIDTH: 2\n      NUM_PORTS: 3\n");
  const std::string header = hardware_map(*Built(text).zynq).xparameters;
  for (const char* line :
       {"XPAR_VIDEO_DEVICE_ID 0\n", "XPAR_AXIVDMA_0_DEVICE_ID 0\n",
        "XPAR_AXIVDMA_0_BASEADDR 0x43000000U\n", "XPAR_FABRIC_VIDEO_MM2S_INTROUT_INTR 64\n",
        "XPAR_BRAM_0_BASEADDR 0x42000000U\n", "XPAR_BRAM_0_DEVICE_ID 0\n"})
    BOOST_TEST(header.find("#define " + std::string(line)) != std::string::npos, line);
}

BOOST_AUTO_TEST_CASE(an_interrupt_of_a_stub_with_two_interfaces_has_its_name) {
  std::string text = replaced(small_design(), "parts:\n",
                              "parts:\n  sums:\n    ip: me:user:sums:1.0\n"
                              "    buses: {S00_AXI: periph.M03_AXI, S_AXI_INTR: periph.M04_AXI}\n");
  text = replaced(text, "  ps.M_AXI_GP0:\n",
                  "  ps.M_AXI_GP0:\n    sums.S00_AXI: [0x43000000, 64 KiB]\n"
                  "    sums.S_AXI_INTR: [0x43010000, 64 KiB]\n");
  text = replaced(text, "      IRQ_F2P: lines.dout",
                  "      Core0_nIRQ: sums.irq\n      IRQ_F2P: lines.dout");
  const std::string header = hardware_map(*Built(text).zynq).xparameters;
  BOOST_TEST(header.find("#define XPAR_FABRIC_SUMS_IRQ_INTR 31\n") != std::string::npos);
  BOOST_TEST(header.find("#define XPAR_SUMS_S00_AXI_BASEADDR 0x43000000U\n") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(stubs_may_drive_each_other) {
  const std::string ring =
      "parts:\n  life:\n    ip: me:user:life:1.0\n    pins: {q: cells.Q}\n"
      "  cells:\n    ip: me:user:cells:1.0\n    pins: {Q_PRIME: life.q_prime}\n";
  BOOST_CHECK_NO_THROW(const Built chip(replaced(small_design(), "parts:\n", ring)));
}

BOOST_AUTO_TEST_CASE(the_coherent_port_leads_to_the_ddr) {
  std::string text = small_design();
  for (std::size_t at = 0; (at = text.find("S_AXI_HP0", at)) != std::string::npos;)
    text.replace(at, 9, "S_AXI_ACP");
  BOOST_CHECK_NO_THROW(const Built chip(text));
  text.replace(text.find("    ps.S_AXI_ACP"), 16, "    ps.S_AXI_HP4");
  BOOST_TEST(input_error([&] { const Built chip(text); }).find("no bus leads from there to it") !=
             std::string::npos);
}

BOOST_AUTO_TEST_CASE(an_output_that_no_model_has_rests_and_leaves_the_verdict_open) {
  const auto stubs_behind = [](const std::string& output) {
    Built chip(replaced(small_design(), "gpio_io_i: external.buttons", "gpio_io_i: " + output));
    Built::pass_us(1);
    const auto& gpio = chip.part<xilinx::AxiGpio>("axi_gpio_0");
    BOOST_TEST(std::uint32_t{gpio.gpio.io_i} == (output.back() == 'n' ? 1u : 0u));
    return vp::join(chip.zynq->design().used_stubs(), " ");
  };
  BOOST_TEST(stubs_behind("axi_dma_0.axi_dma_tstvec") == "axi_dma_0.axi_dma_tstvec");
  BOOST_TEST(stubs_behind("axi_dma_0.mm2s_prmry_reset_out_n") == "", "nothing is in reset");
  BOOST_TEST(stubs_behind("external.buttons") == "");
}

BOOST_AUTO_TEST_CASE(rtl_that_the_build_refused_is_a_stub_with_its_reason) {
  const kit::TemporaryFolder folder;
  const std::string file = folder / "design.yaml";
  vp::write_file(file, replaced(small_design(), "ip: me:user:own:1.0",
                                "ip: me:user:own:1.0\n    rtl: build/own_0.so"));
  const auto own = [&] { return *block_design::read_design_file(file).part("own_0"); };
  BOOST_TEST(!own().is_stub(), "not built yet: it must be built");
  std::filesystem::create_directory(folder / "build");
  vp::write_file(folder / "build/own_0.refused", "no module 'BUFG'\nmore\n");
  BOOST_TEST(own().is_stub());
  BOOST_TEST(own().refused == "no module 'BUFG'");
  const block_design::DesignFile design = block_design::read_design_file(file);
  BOOST_TEST(design.part("axi_gpio_0")->refused == "");
  vp::write_file(folder / "build/own_0.so", "object");
  BOOST_TEST(!own().is_stub(), "what was built since is not refused");
}

// What is clocked goes before its clock then, too: the sanitizers of CI see to it.
BOOST_AUTO_TEST_CASE(a_design_that_is_refused_is_taken_apart_in_order) {
  std::string text = small_design();
  for (std::size_t at; (at = text.find("aclk: ps.FCLK_CLK0")) != std::string::npos;)
    text.replace(at, 18, "aclk: clk_0.pixel_clk");
  BOOST_TEST(input_error([&] {
               const Built chip(replaced(text, "In0: axi_dma_0.s2mm_introut", "In0: axi_dma_0.x"));
             }).find("'axi_dma_0.x' is no output of axi_dma_0") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_joined_is_refused_with_its_line) {
  BOOST_TEST(
      refusal("axi_gpio_0.S_AXI: [0x41200000", "axi_gpio_0.S_AXI: [0x40400000").find("overlaps") !=
      std::string::npos);
  BOOST_TEST(refusal("axi_gpio_0.S_AXI: [0x41200000", "axi_gpio_0.S_AXI: [0x91200000")
                 .find("m_axi_gp0 reaches 0x40000000 to 0x7FFFFFFF") != std::string::npos);
  const std::string pin =
      refusal("      gpio_io_i: external.buttons", "      gpio_oi_i: external.buttons");
  BOOST_TEST(pin.find("'axi_gpio_0.gpio_oi_i' is no input of xilinx.com:ip:axi_gpio:2.0: did you "
                      "mean 'gpio_io_i'?") != std::string::npos,
             pin);
  const std::string output = refusal("In0: axi_dma_0.s2mm_introut", "In0: axi_dma_0.s2mm_intout");
  BOOST_TEST(output.find("'axi_dma_0.s2mm_intout' is no output of axi_dma_0: did you mean "
                         "'s2mm_introut'?") != std::string::npos,
             output);
  BOOST_TEST(refusal("      S_AXI: periph.M01_AXI\n", "").find("no bus leads from there to it") !=
             std::string::npos);
  BOOST_TEST(
      refusal("      m_axi_mm2s_aclk: ps.FCLK_CLK0", "      m_axi_mm2s_aclk: clk_0.pixel_clk")
          .find("have different clocks, and its model has one") != std::string::npos);
  BOOST_TEST(refusal("MMCM_CLKFBOUT_MULT_F: 37.125", "MMCM_CLKFBOUT_MULT_F: 63.000")
                 .find("would run at 1575.000 MHz") != std::string::npos);
}

#ifdef MARKERVP_EVERYTHING_RTL
namespace {

/// RTL behind GP0, whose registers a file of this text describes.
struct Described : kit::TemporaryFolder {
  explicit Described(const std::string& rdl) { kit::write_file(*this / "copier.rdl", rdl); }
  std::string design(const std::string& pin = "mode") const {
    return "name: copying\nsettings:\n  device: xc7z020-1\nparts:\n"
           "  ps:\n    ip: xilinx.com:ip:processing_system7:5.5\n"
           "  copier:\n    ip: own:user:everything:1.0\n    rtl: " MARKERVP_EVERYTHING_RTL
           "\n    pins:\n      ap_clk: ps.FCLK_CLK0\n      " +
           pin +
           ": external.mode\n"
           "    buses:\n      s_axi_control: ps.M_AXI_GP0\n"
           "addresses:\n  ps.M_AXI_GP0:\n    copier.s_axi_control: [0x43C00000, 64 KiB]\n"
           "external:\n  mode: {width: 8, level: 0}\n";
  }
  std::vector<std::string> settings() const {
    return {"pl.copier.registers=" + *this / "copier.rdl"};
  }
  facts::HardwareMap map(const std::string& pin = "mode") const {
    Built chip(design(pin), settings());
    return hardware_map(*chip.zynq);
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(registers_of_rtl_are_in_the_map) {
  const Described copier(
      "addrmap copier {\n  reg { field { } START; field { sw = r; } DONE; } CONTROL @0;\n"
      "  reg { field { } VALUE[32] = 7; } FROM @0x10;\n};\n");
  const facts::HardwareMap map = copier.map();
  const auto found = std::find_if(map.devices.begin(), map.devices.end(),
                                  [](const auto& device) { return device.name == "copier"; });
  BOOST_TEST_REQUIRE((found != map.devices.end()));
  BOOST_TEST_REQUIRE(found->registers.size() == 2u);
  BOOST_TEST(found->registers[1].name == "FROM");
  BOOST_TEST(found->registers[1].reset == 7u);
  BOOST_TEST(found->registers[0].fields_of_kind != found->registers[1].fields_of_kind);
  BOOST_TEST(register_text(map, 0x43C0'0000, 2) ==
             "copier.CONTROL: 0x00000002 (DONE 1, all else 0)");
  // It stays a device of its address for software.
  BOOST_TEST(map.xparameters.find("#define XPAR_COPIER_S_AXI_CONTROL_BASEADDR 0x43C00000U") !=
             std::string::npos);
}

BOOST_AUTO_TEST_CASE(rtl_that_lacks_a_pin_of_the_design_is_refused_by_name) {
  const std::string refused = input_error([] { Described("addrmap none { };").map("mode_2"); });
  BOOST_TEST(refused.find("'copier.mode_2' is no input of own:user:everything:1.0: did you mean "
                          "'mode'?") != std::string::npos,
             refused);
}

BOOST_AUTO_TEST_CASE(an_interrupt_has_the_name_of_its_part) {
  Built chip(
      "name: copying\nsettings: {device: xc7z020-1}\nparts:\n"
      "  ps:\n    ip: xilinx.com:ip:processing_system7:5.5\n"
      "    pins: {IRQ_F2P: copier.interrupt}\n"
      "  copier:\n    ip: own:user:everything:1.0\n    rtl: " MARKERVP_EVERYTHING_RTL
      "\n    pins: {ap_clk: ps.FCLK_CLK0}\n    buses: {s_axi_control: ps.M_AXI_GP0}\n"
      "addresses:\n  ps.M_AXI_GP0:\n    copier.s_axi_control: [0x43C00000, 64 KiB]\n");
  const std::string names = hardware_map(*chip.zynq).xparameters;
  BOOST_TEST(names.find("#define XPAR_FABRIC_COPIER_INTERRUPT_INTR 61\n") != std::string::npos);
  BOOST_TEST(names.find("FABRIC_COPIER_S_AXI_CONTROL_INTERRUPT") == std::string::npos);
}

BOOST_AUTO_TEST_CASE(rtl_makes_the_clocks_that_the_design_says) {
  const auto design = [](const std::string& clocks) {
    return "name: copying\nsettings: {device: xc7z020-1, ps.fclk_clk0.frequency: 100 MHz}\nparts:\n"
           "  ps:\n    ip: xilinx.com:ip:processing_system7:5.5\n"
           "  copier:\n    ip: own:user:everything:1.0\n    rtl: " MARKERVP_EVERYTHING_RTL
           "\n    clocks: {" +
           clocks +
           "}\n    pins: {ap_clk: ps.FCLK_CLK0}\n    buses: {s_axi_control: ps.M_AXI_GP0}\n"
           "  rst:\n    ip: xilinx.com:ip:proc_sys_reset:5.0\n"
           "    pins: {slowest_sync_clk: copier.interrupt}\n"
           "  other:\n    ip: xilinx.com:ip:proc_sys_reset:5.0\n"
           "    pins: {slowest_sync_clk: ps.FCLK_CLK0}\n"
           "addresses:\n  ps.M_AXI_GP0:\n    copier.s_axi_control: [0x43C00000, 64 KiB]\n";
  };
  {
    Built chip(design("interrupt: 12.5 MHz"));
    BOOST_TEST(chip.part<xilinx::ProcSysReset>("rst").clock().frequency_hz() == 12'500'000u);
  }
  {
    Built chip(design("interrupt: 100 MHz"));
    BOOST_TEST(&chip.part<xilinx::ProcSysReset>("rst").clock() ==
                   &chip.part<xilinx::ProcSysReset>("other").clock(),
               "its own clock, passed on");
  }
  const std::string refused =
      input_error([&] { const Built chip(design("absent: 1 MHz, interrupt: 2 MHz")); });
  BOOST_TEST(refused.find("copier: 'clocks' names 'absent', which is no output of its RTL") !=
                 std::string::npos,
             refused);
}

BOOST_AUTO_TEST_CASE(a_damaged_description_of_registers_is_refused_with_its_line) {
  const Described copier("addrmap copier {\n  reg { field { } START } CONTROL;\n};\n");
  // When the design is built: a message in the middle of the run would be the first to need it.
  BOOST_TEST(input_error([&] { Built chip(copier.design(), copier.settings()); }) ==
             copier / "copier.rdl" + ":2: '}' where ';' belongs");
}
#endif

BOOST_AUTO_TEST_SUITE_END()
