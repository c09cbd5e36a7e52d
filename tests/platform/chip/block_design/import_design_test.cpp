// A hand-off as a design: what becomes of each part, and what is said of it.
#include <chip/block_design/design_file.h>
#include <chip/block_design/diagram.h>
#include <chip/block_design/import_design.h>
#include <chip/block_design/import_levels.h>
#include <chip/block_design/memory_file.h>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "input_error.h"
#include "small_handoff.h"

using namespace platform::block_design;
using kit::replaced;
using platform::handoff::read_hwh;

namespace {

ImportedDesign imported(const kit::HwhText& text) {
  return import_design(read_hwh(text.text(), "small.hwh"));
}

bool has(const std::string& text, const std::string& what) {
  return text.find(what) != std::string::npos;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(imported_designs)

BOOST_AUTO_TEST_CASE(what_is_written_is_read_back) {
  const ImportedDesign design = imported(kit::small_handoff());
  const DesignFile file = parse_design(design.text, "design.yaml");
  BOOST_TEST(file.parts.size() == 10u);
  BOOST_TEST(file.part("lines")->pins.at("In0").text() == "of_dma.dout");
  BOOST_TEST(file.part("axi_dma_0")->buses.at("S_AXIS_S2MM").text() == "axi_dma_0.M_AXIS_MM2S");
  BOOST_TEST(file.addresses.size() == 5u);
  BOOST_TEST_REQUIRE(file.external.size() == 1u);
  BOOST_TEST(file.external.front().width == 4u);
  const auto setting = [&](const std::string& path) -> std::string {
    for (const auto& [key, value] : file.settings)
      if (key == path) return value;
    return "none";
  };
  BOOST_TEST(setting("device") == "xc7z020-1");
  BOOST_TEST(setting("ps.slcr.ps_clk") == "50 MHz");
  BOOST_TEST(setting("ps.cpu_clk.frequency") == "650 MHz");
  BOOST_TEST(setting("ps.fclk_clk0.frequency") == "100 MHz");
  BOOST_TEST(setting("ps.ddr.size") == "511 MiB");
  BOOST_TEST(setting("power.ddr.width") == "16");
  BOOST_TEST(setting("ps.uart1.enabled") == "false");
  BOOST_TEST(setting("ps.slcr.mio_pull_ups") == "0x3FFFFFFFFFBE03", "as at reset but for pin 14");
}

// The address editor may list another slave between two windows of one.
BOOST_AUTO_TEST_CASE(windows_of_one_slave_stand_together) {
  kit::HwhText text = kit::small_handoff();
  text.module("cpu", "me:user:cpu:1.0", "", "", "",
              kit::segment("M_AXI", "own_0", "S00_AXI", "0x0", "0xFFFF") +
                  kit::segment("M_AXI", "axi_gpio_0", "S_AXI", "0x10000", "0x1FFFF") +
                  kit::segment("M_AXI", "own_0", "S00_AXI", "0x20000", "0x2FFFF"));
  const ImportedDesign design = imported(text);
  BOOST_TEST(has(design.text, "own_0.S00_AXI: [[0x00000000, 64 KiB], [0x00020000, 64 KiB]]"));
  BOOST_TEST(parse_design(design.text, "design.yaml").addresses.size() == 8u);
}

// Vivado names one port for all slaves of an interconnect that both ports lead to.
BOOST_AUTO_TEST_CASE(the_address_says_by_which_port_the_processor_gets_there) {
  std::string text = kit::small_handoff().text();
  const std::string other = R"(MASTERBUSINTERFACE="M_AXI_GP1")";
  text = replaced(text, R"(INSTANCE="own_0" MASTERBUSINTERFACE="M_AXI_GP0")",
                  R"(INSTANCE="own_0" )" + other);
  const ImportedDesign design = import_design(read_hwh(text, "small.hwh"));
  BOOST_TEST(!has(design.text, "ps.M_AXI_GP1:"));
  BOOST_TEST(has(design.text, "own_0.S00_AXI: [0x43C00000"));
  BOOST_TEST_REQUIRE(!design.notes.empty());
  BOOST_TEST(has(design.notes.back(), "own_0 at 0x43C00000 for M_AXI_GP1"));
  // A port that leads nowhere is not the one.
  text = replaced(text, R"(BUSNAME="ps_M_AXI_GP0" NAME="M_AXI_GP0")",
                  R"(BUSNAME="__NOC__" NAME="M_AXI_GP0")");
  BOOST_TEST(has(import_design(read_hwh(text, "small.hwh")).text, "ps.M_AXI_GP1:"));
}

BOOST_AUTO_TEST_CASE(segments_of_a_master_without_a_bus_are_left_out) {
  std::string text = kit::small_handoff().text();
  const std::string gp0 = kit::bus("MASTER", "M_AXI_GP0", "ps_M_AXI_GP0");
  const std::string own = kit::segment("M_AXI_GP0", "own_0", "S00_AXI", "0x43C00000", "0x43C0FFFF");
  text = kit::replaced(text, gp0, gp0 + kit::bus("MASTER", "M_AXI_GP1", "__NOC__"));
  text = kit::replaced(
      text, own, own + kit::segment("M_AXI_GP1", "own_0", "S00_AXI", "0x83C00000", "0x83C0FFFF"));
  const ImportedDesign design = import_design(read_hwh(text, "small.hwh"));
  BOOST_TEST(has(design.text, "own_0.S00_AXI: [0x43C00000, 64 KiB]"));
  BOOST_TEST(!has(design.text, "0x83C00000"));
  BOOST_TEST(design.notes.back().find("own_0 at 0x83C00000 for ps.M_AXI_GP1, which is joined to "
                                      "nothing") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_small_memory_has_its_buffers_in_its_upper_half) {
  const std::string small =
      replaced(kit::small_handoff().text(), "0x1FFFFFFF\"/>", "0x0FFFFFFF\"/>");
  BOOST_TEST(has(import_design(read_hwh(small, "s.hwh")).text, "ps.ddr.dma_base: 0x08000000\n"));
  BOOST_TEST(!has(imported(kit::small_handoff()).text, "dma_base"));
}

BOOST_AUTO_TEST_CASE(a_model_for_the_board_gives_way_to_a_stub_where_a_part_drives_it) {
  kit::HwhText text = kit::small_handoff();
  const auto iic = [&](const std::string& name, const std::string& net) {
    text.module(name, "xilinx.com:ip:axi_iic:2.1", "", kit::pin("I", "scl_i", net));
  };
  text.module("one", "xilinx.com:ip:xlconstant:1.1", "", kit::pin("O", "dout", "one_dout"));
  iic("behind_own", "own_done");
  iic("at_constant", "one_dout");
  iic("at_board", "buttons");
  for (const ImportedPart& part : imported(text).parts) {
    if (part.name == "behind_own")
      BOOST_TEST(has(part.why, "its pin scl_i is driven by own_0.done"), part.why);
    if (part.name == "at_constant" || part.name == "at_board")
      BOOST_TEST((part.kind == Kind::model), part.name);
  }
}

BOOST_AUTO_TEST_CASE(a_clock_of_unknown_frequency_is_what_its_wizard_was_made_for) {
  kit::HwhText text = kit::small_handoff();
  text.module("mux", "me:user:mux:1.0", "", kit::pin("O", "clk_out", "mux_clk"));
  text.module("clk_1", "xilinx.com:ip:clk_wiz:6.0", kit::parameter("PRIM_IN_FREQ", "10.000"),
              kit::pin("I", "clk_in1", "mux_clk"));
  BOOST_TEST(has(imported(text).text, "    clocks:\n      clk_out: 10 MHz\n"));
}

// A pin without a type is a clock if what it drives is one.
BOOST_AUTO_TEST_CASE(a_pin_that_drives_a_clock_is_one) {
  kit::HwhText text = kit::small_handoff();
  text.external(kit::pin("I", "sysclk", "sysclk") + kit::pin("I", "level", "level"));
  text.module("other", "me:user:other:1.0", "",
              kit::pin("I", "clk", "sysclk", 1, R"(SIGIS="clk" CLKFREQUENCY="125000000")") +
                  kit::pin("I", "on", "level"));
  const std::string design = imported(text).text;
  BOOST_TEST(has(design, "  sysclk: {clock: 125 MHz}\n"));
  BOOST_TEST(has(design, "  level: {level: 0}\n"));
}

BOOST_AUTO_TEST_CASE(an_output_that_no_model_has_is_named) {
  kit::HwhText text = kit::small_handoff();
  text.module("rom", "xilinx.com:ip:blk_mem_gen:8.4", "", kit::pin("O", "sbiterra", "rom_douta"));
  text.module("not_0", "xilinx.com:ip:util_vector_logic:2.0", kit::parameter("C_OPERATION", "not"),
              kit::pin("I", "Op1", "rom_douta"));
  const ImportedDesign design = imported(text);
  const auto says = [&](const std::string& what) {
    return std::count_if(design.notes.begin(), design.notes.end(),
                         [&](const std::string& note) { return has(note, what); });
  };
  BOOST_TEST(says("`rom.sbiterra` is not modelled: it stays 0") == 1);
  BOOST_TEST(says("is not modelled") == 1);
}

BOOST_AUTO_TEST_CASE(parameters_as_usual_are_left_out) {
  const std::string text = imported(kit::small_handoff()).text;
  BOOST_TEST(has(text, "      C_GPIO_WIDTH: 4\n"));
  BOOST_TEST(!has(text, "C_IS_DUAL"));
  BOOST_TEST(has(text, "      WIDTH: 8\n"));  // of an IP of the owner's
}

BOOST_AUTO_TEST_CASE(a_slave_of_apb_is_reached_through_its_bridge) {
  kit::HwhText text = kit::small_handoff();
  text.module("bridge", "xilinx.com:ip:axi_apb_bridge:3.0", "",
              kit::pin("I", "s_axi_aclk", "ps_FCLK_CLK0"),
              kit::bus("SLAVE", "AXI4_LITE", "periph_M03") +
                  kit::bus("MASTER", "APB_M", "bridge_APB", "apb"));
  text.module("core", "me:user:core:1.0", "", "", kit::bus("SLAVE", "apb_s", "bridge_APB", "apb"));
  const ImportedDesign design = imported(text);
  const DesignFile file = parse_design(design.text, "design.yaml");
  BOOST_TEST(file.part("core")->buses.at("apb_s").text() == "bridge.APB_M");
  BOOST_TEST((file.part("bridge")->rule()->kind == Kind::bus));
}

// What the vendor's tools take for low where nothing is said is what drives the pin, or is behind
// it.
BOOST_AUTO_TEST_CASE(a_reset_from_the_board_is_not_active) {
  kit::HwhText text = kit::small_handoff();
  const std::string is_reset = R"(SIGIS="rst" POLARITY="ACTIVE_LOW")";
  text.external(kit::pin("I", "button_low", "button_low", 1, is_reset));
  text.external(kit::pin("I", "button", "button", 1, is_reset));
  text.module("more", "xilinx.com:ip:proc_sys_reset:5.0", kit::parameter("C_EXT_RESET_HIGH", "0"),
              kit::pin("I", "slowest_sync_clk", "ps_FCLK_CLK0") +
                  kit::pin("I", "ext_reset_in", "button_low"));
  text.module(
      "less", "xilinx.com:ip:proc_sys_reset:5.0", kit::parameter("C_EXT_RESET_HIGH", "1"),
      kit::pin("I", "slowest_sync_clk", "ps_FCLK_CLK0") + kit::pin("I", "ext_reset_in", "button"));
  const ImportedDesign design = imported(text);
  BOOST_TEST(has(design.text, "  button_low: {level: 1}\n"));
  BOOST_TEST(has(design.text, "  button: {level: 0}\n"));
}

BOOST_AUTO_TEST_CASE(a_reset_of_rtl_has_the_level_of_what_drives_it) {
  kit::HwhText text = kit::small_handoff();
  text.module("inverter", "xilinx.com:ip:util_vector_logic:2.0",
              kit::parameter("C_OPERATION", "not"),
              kit::pin("I", "Op1", "rst_0_aresetn") + kit::pin("O", "Res", "inverter_Res"));
  const platform::handoff::Handoff handoff = read_hwh(text.text(), "small.hwh");
  const platform::handoff::Netlist nets(handoff);
  const auto low = [&](const std::string& part, const std::string& pin) {
    const auto* module = handoff.module(part);
    return resets_low(nets, {module, module->port(pin)});
  };
  BOOST_TEST((low("rst_0", "peripheral_aresetn") == true));
  BOOST_TEST((low("ps", "FCLK_RESET0_N") == true));
  BOOST_TEST((low("inverter", "Res") == false));
  BOOST_TEST(!low("axi_gpio_0", "gpio_io_o"), "any wire");
  platform::handoff::Port port;
  port.name = "rst";
  port.kind = "rst";
  BOOST_TEST(leaves_level_open(port, {}));
  for (const char* name : {"rst_n", "aresetn", "ap_rst"}) {
    port.name = name;
    BOOST_TEST(!leaves_level_open(port, {}), name);
  }
}

// Vivado joins them as a bus of pins; what logic reads of a memory must not be lost with it.
BOOST_AUTO_TEST_CASE(pins_of_a_memory_are_those_of_what_is_at_its_ports) {
  kit::HwhText text = kit::small_handoff();
  text.module("control", "xilinx.com:ip:axi_bram_ctrl:4.1", "",
              kit::pin("I", "s_axi_aclk", "ps_FCLK_CLK0") +
                  kit::pin("O", "bram_addr_a", "c_addr", 13) +
                  kit::pin("I", "bram_rddata_a", "m_douta", 32),
              kit::bus("MASTER", "BRAM_PORTA", "c_port", "bram"));
  const std::string widths =
      kit::parameter("C_MEM_TYPE", "2") + kit::parameter("C_READ_WIDTH_A", "32") +
      kit::parameter("C_WRITE_WIDTH_A", "32") + kit::parameter("C_READ_WIDTH_B", "32");
  const std::string pins =
      kit::pin("I", "addra", "c_addr", 32) + kit::pin("O", "douta", "m_douta", 32) +
      kit::pin("I", "addrb", "r_addr", 32) + kit::pin("O", "doutb", "m_doutb", 32);
  const auto with = [&](const std::string& more) {
    kit::HwhText one = text;
    one.module("memory", "xilinx.com:ip:blk_mem_gen:8.4", widths + more, pins,
               kit::bus("SLAVE", "BRAM_PORTA", "c_port", "bram") +
                   kit::bus("SLAVE", "BRAM_PORTB", "r_port", "bram"));
    one.module("reader", "me:user:reader:1.0", "",
               kit::pin("O", "addr", "r_addr", 32) + kit::pin("I", "data", "m_doutb", 32),
               kit::bus("MASTER", "PORT", "r_port", "bram"));
    return imported(one);
  };
  const ImportedDesign design = with(kit::parameter("C_WRITE_WIDTH_B", "32"));
  const DesignFile file = parse_design(design.text, "design.yaml");
  BOOST_TEST(file.part("memory")->pins.at("addra").text() == "control.bram_addr_a");
  BOOST_TEST(file.part("memory")->pins.at("addrb").text() == "reader.addr");
  BOOST_TEST(file.part("reader")->pins.at("data").text() == "memory.doutb");
  BOOST_TEST((file.part("memory")->rule()->kind == Kind::model));
  const auto why = [](const ImportedDesign& one) {
    for (const ImportedPart& part : one.parts)
      if (part.name == "memory") return part.why;
    return std::string("absent");
  };
  BOOST_TEST(why(design) == "");
  BOOST_TEST(why(with(kit::parameter("C_WRITE_WIDTH_B", "8"))) ==
             "its port B reads 32 bits and writes 8, which is not modelled");
  BOOST_TEST(why(with(kit::parameter("C_WRITE_WIDTH_B", "32") +
                      kit::parameter("C_USE_ECC", "1"))) == "C_USE_ECC = 1 is not modelled, but 0");
  BOOST_TEST(
      why(with(kit::parameter("C_WRITE_WIDTH_B", "32") + kit::parameter("C_LOAD_INIT_FILE", "1") +
               kit::parameter("Coe_File", "../../a/font.coe"))) ==
      "its contents, font.coe, were not found: name their folder with --rtl");
}

BOOST_AUTO_TEST_CASE(contents_of_a_memory) {
  const auto read = [](const std::string& text) { return read_memory_file(text, "a.coe"); };
  using Words = std::vector<std::uint64_t>;
  BOOST_TEST(read("; a font\nmemory_initialization_radix=16;\n"
                  "memory_initialization_vector =\n1F, 0\n; the rest\nff;") == (Words{31, 0, 255}),
             boost::test_tools::per_element());
  BOOST_TEST(
      read("MEMORY_INITIALIZATION_RADIX = 2;memory_initialization_vector=101 1,") == (Words{5, 1}),
      boost::test_tools::per_element());
  const auto refused = [&](const std::string& text) { return input_error([&] { read(text); }); };
  const std::string radix = "memory_initialization_radix=10;\nmemory_initialization_vector=";
  BOOST_TEST(refused(radix + "1,\n1a;") == "a.coe:3: '1a' is not a number to the base 10");
  BOOST_TEST(refused(radix + "18446744073709551616;") ==
             "a.coe:2: '18446744073709551616' has more than 64 bits");
  BOOST_TEST(refused("memory_initialization_radix=8;") ==
             "a.coe:1: memory_initialization_radix must be 2, 10 or 16, and is '8'");
  BOOST_TEST(refused("memory_initialization_vector=1;") ==
             "a.coe:1: memory_initialization_radix must come before the vector");
  BOOST_TEST(refused("") == "a.coe:1: it has no memory_initialization_vector");
  BOOST_TEST(hex_number("1F") == 31u);
}

BOOST_AUTO_TEST_CASE(what_has_no_model_is_a_stub_with_a_reason) {
  kit::HwhText text = kit::small_handoff();
  text.module("axi_dma_1", "xilinx.com:ip:axi_dma:7.1",
              kit::parameter("C_ENABLE_MULTI_CHANNEL", "1"), "");
  text.module("can_0", "xilinx.com:ip:can:5.0", "", "");
  const ImportedDesign design = imported(text);
  for (const ImportedPart& part : design.parts) {
    if (part.name == "own_0") BOOST_TEST(part.why == "no RTL was named for it");
    if (part.name == "can_0") BOOST_TEST(part.why == "the platform has no model of it");
    if (part.name == "axi_dma_1")
      BOOST_TEST(part.why == "C_ENABLE_MULTI_CHANNEL = 1 is not modelled, but 0");
    if (part.name == "axi_dma_0") BOOST_TEST(part.why == "");
  }
  BOOST_TEST(has(design.text, "    as: stub  # C_ENABLE_MULTI_CHANNEL = 1 is not modelled"));
  const auto handoff = read_hwh(text.text(), "small.hwh");
  const std::string report = import_report(handoff, design, "");
  BOOST_TEST(has(report, "\n3 parts are stubs."));
  BOOST_TEST(has(report, "| `own_0` | me:user:own:1.0 | stub | no RTL was named for it |"));
  BOOST_TEST(has(report, "| 63 | `axi_gpio_0.ip2intc_irpt` |"));
  BOOST_TEST(has(report, "| `clk_0.pixel_clk` | 74.25 MHz |"));
  const std::string with_problem = import_report(handoff, design, "a reason");
  BOOST_TEST(has(with_problem, "cannot be built as it is:** a reason"));
}

BOOST_AUTO_TEST_CASE(drivers_of_own_ip_have_the_tables_of_their_instances) {
  kit::HwhText text = kit::small_handoff();
  text.module("behind_cpu", "me:user:own:1.0", "", "");  // which the PS does not see
  platform::handoff::Handoff handoff = read_hwh(text.text(), "small.hwh");
  for (auto& module : handoff.modules)
    if (module.ip() == "own") module.parameters["C_S00_AXI_BASEADDR"] = "0x43C00000";
  const std::string vendors =
      "#define XPAR_AXI_DMA_0_BASEADDR 0x40400000U\n#define XPAR_AXI_GPIO_0_BASEADDR 0x41200000U\n";
  const std::string by_label =
      "#ifdef SDT\n#define XPAR_OWN_0_BASEADDR 0x43C00000U\n"
      "#define XPAR_OWN_0_HIGHADDR 0x43C0FFFFU\n#endif\n";
  platform::handoff::OwnDriver driver;
  driver.name = "own_v1_0";
  driver.peripherals = {"own"};
  driver.sources = {{"xown.c", "int own;"}};
  driver.scripts = {
      {"xdefine_include_file",
       {"xparameters.h", "XOwn", "NUM_INSTANCES", "DEVICE_ID", "C_S00_AXI_BASEADDR"}},
      {"xdefine_canonical_xpars", {"xparameters.h", "XOwn", "DEVICE_ID", "C_S00_AXI_BASEADDR"}},
      {"xdefine_config_file", {"xown_g.c", "XOwn", "DEVICE_ID", "C_S00_AXI_BASEADDR"}}};
  const DriverFiles files = driver_files(
      handoff, {driver, driver}, vendors + "#define XPAR_OWN_0_S00_AXI_BASEADDR 0x43C00000U\n");
  BOOST_TEST(files.names ==
             "\n/* Drivers of the design's own IP */\n#define XPAR_XOWN_NUM_INSTANCES 1\n"
             "#define XPAR_OWN_0_DEVICE_ID 0\n#define XPAR_XOWN_0_DEVICE_ID 0\n"
             "#define XPAR_XOWN_0_S00_AXI_BASEADDR 0x43C00000\n" +
                 by_label);
  BOOST_TEST_REQUIRE(files.files.size() == 2u, "one of each name");
  BOOST_TEST(files.files[0].first == "own_v1_0/xown.c");
  BOOST_TEST(files.files[1].first == "own_v1_0/xown_g.c");
  BOOST_TEST(has(files.files[1].second,
                 "XOwn_ConfigTable[] = {\n  {XPAR_OWN_0_DEVICE_ID, "
                 "XPAR_OWN_0_S00_AXI_BASEADDR},\n};"));
  BOOST_TEST(!has(files.files[1].second, "SDT"), "it is the same in both flows");
  driver.sources = {{"xown.h", "#ifdef SDT\n  char *Name;\n#else\n  u16 DeviceId;\n#endif\n"}};
  const DriverFiles both = driver_files(handoff, {driver}, vendors);
  BOOST_TEST(has(both.names,
                 "#ifdef SDT\n#define XPAR_OWN_0_BASEADDR 0x43C00000\n"
                 "#define XPAR_XOWN_0_BASEADDR 0x43C00000\n#endif\n"));
  BOOST_TEST(!has(both.names, by_label), "the driver gives the name");
  BOOST_TEST(has(both.files[1].second,
                 "#else\nXOwn_Config XOwn_ConfigTable[] = {\n  {\"xlnx,own-1.0\", "
                 "XPAR_OWN_0_S00_AXI_BASEADDR},\n  {NULL}};\n#endif\n"));
  driver.peripherals = {"another"};
  const DriverFiles none = driver_files(handoff, {driver}, vendors);
  BOOST_TEST(none.files.empty());
  BOOST_TEST(none.names == "\n/* Drivers of the design's own IP */\n" + by_label);
  BOOST_TEST(is_for_device_tree({"f(XPAR_OWN_0_BASEADDR);"}, vendors + none.names));
}

// The older tools name the addresses of an IP without a driver by its parameters.
BOOST_AUTO_TEST_CASE(addresses_have_the_names_of_the_parameters_that_hold_them) {
  std::string text = kit::small_handoff().text();
  text = replaced(text, "INSTANCE=\"own_0\" MASTERBUSINTERFACE",
                  "BASENAME=\"C_BASEADDR\" HIGHNAME=\"C_HIGHADDR\" INSTANCE=\"own_0\" "
                  "MASTERBUSINTERFACE");
  const std::string names = driver_files(read_hwh(text, "small.hwh"), {}, "").names;
  BOOST_TEST(has(names,
                 "#ifndef SDT\n#define XPAR_OWN_0_BASEADDR 0x43C00000U\n"
                 "#define XPAR_OWN_0_HIGHADDR 0x43C0FFFFU\n#endif\n"),
             names);
  const std::string known = "#define XPAR_OWN_0_BASEADDR 0x43C00000U\n";
  BOOST_TEST(!has(driver_files(read_hwh(text, "small.hwh"), {}, known).names,
                  "#ifndef SDT\n#define XPAR_OWN_0_BASEADDR"));
}

BOOST_AUTO_TEST_CASE(a_program_shows_its_flow_by_the_names_that_it_uses) {
  const std::string xparameters =
      "#define XPAR_A_0_BASEADDR 1\n#ifndef SDT\n#define XPAR_A_0_DEVICE_ID 0\n#endif\n"
      "#ifdef SDT\n#define XPAR_XA_0_BASEADDR 1\n#endif\n";
  const auto sdt = [&](const std::string& program) {
    return is_for_device_tree({"int main(void) {}", program}, xparameters);
  };
  BOOST_TEST(sdt("f(XPAR_XA_0_BASEADDR);"));
  BOOST_TEST(!sdt("f(XPAR_A_0_BASEADDR);"), "both have it");
  BOOST_TEST(!sdt("#ifdef SDT\nf(XPAR_XA_0_BASEADDR)\n#else\nf(XPAR_A_0_DEVICE_ID)"));
  BOOST_TEST(!sdt("f(XPAR_XA_0_BASEADDR_OF_ANOTHER);"));
  BOOST_TEST(!is_for_device_tree({}, xparameters));
  const ImportedDesign design = imported(kit::small_handoff());
  BOOST_TEST(has(import_cmake("small", design, {"main.c"}, true), "PRIVATE SDT)"));
  BOOST_TEST(has(import_cmake("small", design, {"main.c"}, true), " DRIVERS ${drivers} "));
  BOOST_TEST(!has(import_cmake("small", design, {"main.c"}, false), "SDT)"));
}

BOOST_AUTO_TEST_CASE(devices_for_linux) {
  const std::string tree = device_tree(read_hwh(kit::small_handoff().text(), "small.hwh"));
  BOOST_TEST(has(tree,
                 "\t\taxi_dma_0: dma@40400000 {\n"
                 "\t\t\tcompatible = \"xlnx,axi-dma-7.1\", \"xlnx,axi-dma-1.00.a\";\n"
                 "\t\t\treg = <0x40400000 0x10000>;\n"
                 "\t\t\tinterrupt-parent = <&intc>;\n"
                 "\t\t\t"
                 "interrupts = <0 29 4 0 30 4>;\n"
                 "\t\t\tinterrupt-names = \"s2mm_introut\", \"mm2s_introut\";\n"
                 "\t\t\tclocks = <&clkc 15>"));
  BOOST_TEST(has(tree, "xlnx,sg-length-width = <0x14>;"));
  BOOST_TEST(has(tree, "own_0: own@43c00000"));
  BOOST_TEST(has(tree,
                 "\t\t\tdma-channel@40400030 {\n"
                 "\t\t\t\tcompatible = \"xlnx,axi-dma-s2mm-channel\";\n"));
}

BOOST_AUTO_TEST_CASE(registers_by_the_names_of_the_hand_off) {
  const std::string block =
      "<ADDRESSBLOCKS><ADDRESSBLOCK INTERFACE=\"S00_AXI\"><REGISTERS><REGISTER NAME=\"CTRL\">"
      "<PROPERTY NAME=\"ADDRESS_OFFSET\" VALUE=\"0x10\"/><FIELDS><FIELD NAME=\"MODE\">"
      "<PROPERTY NAME=\"BIT_OFFSET\" VALUE=\"4\"/><PROPERTY NAME=\"BIT_WIDTH\" VALUE=\"3\"/>"
      "</FIELD></FIELDS></REGISTER></REGISTERS></ADDRESSBLOCK></ADDRESSBLOCKS>";
  const std::string text = kit::small_handoff().text();
  const std::size_t own = text.find("FULLNAME=\"/own_0\"");
  const std::size_t inside = text.find('>', own) + 1;
  const auto names = [&](const std::string& hwh) {
    return register_names(read_hwh(hwh, "small.hwh"));
  };
  BOOST_TEST(names(text) == "{\n}\n");
  const auto found =
      nlohmann::json::parse(names(text.substr(0, inside) + block + text.substr(inside)));
  BOOST_TEST(found.dump() == R"({"own_0":{"CTRL":{"fields":{"MODE":[4,3]},"offset":16}}})");
}

BOOST_AUTO_TEST_CASE(a_picture_of_the_design) {
  const std::string graph =
      diagram(parse_design(imported(kit::small_handoff()).text, "design.yaml"));
  for (
      const char* what :
      {R"("axi_gpio_0" [label="axi_gpio_0\naxi_gpio 2.0\n0x41200000, 64 KiB", tooltip="xilinx.com:ip:axi_gpio:2.0")",
       R"("periph" -> "axi_gpio_0" [penwidth=2, weight=3, tooltip="periph.M01_AXI to axi_gpio_0.S_AXI"])",
       R"("axi_dma_0" -> "axi_dma_0" [penwidth=3, color="#2a6fbb")",
       // What the PS takes is a node of its own, and lines of one kind between two parts are one.
       R"("lines" -> "ps inputs" [color="#c0392b", tooltip="lines.dout to ps.IRQ_F2P"])",
       R"("axi_dma_0" -> "mem" [penwidth=2, weight=3, label="2", )", R"(subgraph cluster_loose)",
       R"(<td bgcolor="#cfe8ff">ps.FCLK_CLK0</td>)",
       R"("own_0" [label="own_0\nown 1.0\n0x43C00000, 64 KiB", tooltip="me:user:own:1.0", fillcolor="#cfe8ff", style="filled,dashed"])"})
    BOOST_TEST(has(graph, what), what << " in " << graph);
  BOOST_TEST(input_error([&] { write_diagram({}, "x.pdf"); }).find("must end in .svg") !=
             std::string::npos);
}

BOOST_AUTO_TEST_CASE(words_that_yaml_would_take_for_something_else) {
  kit::HwhText text = kit::small_handoff();
  text.module("own_1", "me:user:own:1.0",
              kit::parameter("A", "#1 &quot;x&quot;: y\\") + kit::parameter("B", "- z"), "");
  const DesignFile file = parse_design(imported(text).text, "design.yaml");
  BOOST_TEST(file.part("own_1")->parameters.at("A") == "#1 \"x\": y\\");
  BOOST_TEST(file.part("own_1")->parameters.at("B") == "- z");
}

BOOST_AUTO_TEST_CASE(ten_thousand_parts) {
  kit::HwhText text = kit::small_handoff();
  for (int i = 0; i < 10'000; ++i) {
    text.module("c" + std::to_string(i), "xilinx.com:ip:xlconstant:1.1",
                kit::parameter("CONST_WIDTH", "4"),
                kit::pin("O", "dout", "n" + std::to_string(i), 4));
  }
  const ImportedDesign design = imported(text);
  BOOST_TEST(parse_design(design.text, "design.yaml").parts.size() == 10'010u);
}

BOOST_AUTO_TEST_CASE(interrupts_from_nothing_and_to_nothing_are_in_the_report) {
  const auto report_of = [](const std::string& text) {
    const auto handoff = platform::handoff::read_hwh(text, "small.hwh");
    return import_report(handoff, import_design(handoff), "");
  };
  const char *never = "| nothing: open or a constant, so it never comes |",
             *unread = "These reach nothing, so programs poll them: ";
  const std::string whole = kit::replaced(kit::small_handoff().text(), R"(NAME="ip2intc_irpt")",
                                          R"(NAME="ip2intc_irpt" SIGIS="INTERRUPT")");
  BOOST_TEST(report_of(whole).find(never) == std::string::npos);
  BOOST_TEST(report_of(whole).find(unread) == std::string::npos);
  const std::string open =
      report_of(kit::replaced(whole, R"(NAME="In1" SIGNAME="gpio_irpt")", R"(NAME="In1")"));
  BOOST_TEST(open.find(std::string("| 63 ") + never) != std::string::npos, open);
  BOOST_TEST(open.find(unread + std::string("`axi_gpio_0.ip2intc_irpt`.")) != std::string::npos,
             open);
}

BOOST_AUTO_TEST_SUITE_END()
