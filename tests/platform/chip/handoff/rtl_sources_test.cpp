// RTL of a design's own IP, found in the user's folders.
#include <chip/block_design/design_file.h>
#include <chip/block_design/import_design.h>
#include <chip/handoff/rtl_sources.h>
#include <vp/file.h>
#include <boost/test/unit_test.hpp>

#include <filesystem>
#include <string>
#include <vector>

#include "input_error.h"
#include "small_handoff.h"
#include "temporary_files.h"

using namespace platform;
using handoff::RtlFinder;
using handoff::RtlSources;

namespace {

/// Folders of RTL: `ip` has a packaged IP, `plain` a module and what it instantiates.
struct Folders : kit::TemporaryFolder {
  Folders() {
    write("plain/own.v",
          "// module other\nmodule own #(parameter WIDTH = 4, DEPTH = 2) (input clk);\n"
          "  helper h(clk);\nendmodule\n");
    write("plain/helper.sv", "module helper(input clk);\nendmodule\n");
    write("plain/unused.v", "module unused;\nendmodule\n");
  }
  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories(std::filesystem::path(*this / name).parent_path());
    kit::write_file(*this / name, text);
  }
  void write_component(const std::string& revision, const std::string& file) const {
    const auto tag = [](const std::string& name, const std::string& inside) {
      return "<spirit:" + name + ">" + inside + "</spirit:" + name + ">";
    };
    const std::string view =
        tag("view", tag("name", "xilinx_verilogsynthesis") + tag("modelName", "own_v1_0") +
                        tag("fileSetRef", tag("localName", "set")));
    write("ip/component.xml",
          "<spirit:component>" + tag("vendor", "me") + tag("library", "user") + tag("name", "own") +
              tag("version", "1.0") + tag("model", tag("views", view)) +
              tag("fileSets", tag("fileSet", tag("name", "set") + tag("file", tag("name", file)))) +
              "<xilinx:coreRevision>" + revision + "</xilinx:coreRevision></spirit:component>");
  }
  std::string folder(const std::string& name) const { return *this / name; }
};

handoff::Module own(const std::string& revision = "") {
  handoff::Module module;
  module.instance = "own_0";
  module.vlnv = "me:user:own:1.0";
  module.type = "own";
  module.revision = revision;
  module.parameters = {{"WIDTH", "0x8"}, {"Component_Name", "x"}, {"OTHER", "3"}};
  return module;
}

std::vector<std::string> names(const RtlSources& sources) {
  std::vector<std::string> list;
  for (const std::string& file : sources.files)
    list.push_back(std::filesystem::path(file).filename().string());
  return list;
}

using Names = std::vector<std::string>;

}  // namespace

BOOST_AUTO_TEST_SUITE(rtl_sources)

BOOST_FIXTURE_TEST_CASE(a_module_by_its_name_with_what_it_instantiates, Folders) {
  const RtlSources sources = RtlFinder({folder("plain")}).find(own());
  const Names expected{"own.v", "helper.sv"};
  BOOST_TEST(sources.top == "own");
  BOOST_TEST(names(sources) == expected);
  const Names parameters{"WIDTH=8"};  // of those that the module declares
  BOOST_TEST(sources.parameters == parameters);
}

BOOST_FIXTURE_TEST_CASE(folders_of_what_memories_read_are_named, Folders) {
  write("plain/helper.sv",
        "module helper(input clk); reg [7:0] m[0:1];\n"
        "  initial begin $readmemh(\"C:/projects/old/rom.mem\", m); $readmemh(\"./own.dat\", m); "
        "end\n"
        "endmodule\n");
  write("plain/own.dat", "0 1\n");
  write("elsewhere/data/rom.mem", "0 1\n");
  write("elsewhere/unused/ram.mem", "0 1\n");
  const RtlSources sources = RtlFinder({folder("plain"), folder("elsewhere")}).find(own());
  const Names expected{folder("elsewhere/data/")};
  BOOST_TEST(sources.include_dirs == expected);
}

BOOST_FIXTURE_TEST_CASE(a_packaged_ip_by_its_list_of_files, Folders) {
  write_component("7", "../plain/helper.sv");
  const RtlSources sources = RtlFinder({folder("ip"), folder("plain")}).find(own("7"));
  const Names expected{"helper.sv"};
  BOOST_TEST(sources.top == "own_v1_0");
  BOOST_TEST(names(sources) == expected);
}

BOOST_FIXTURE_TEST_CASE(what_does_not_fit_is_said, Folders) {
  write_component("7", "../plain/helper.sv");
  const RtlSources other = RtlFinder({folder("ip")}).find(own("8"));
  BOOST_TEST(other.files.empty());
  BOOST_TEST(other.why.find("is revision 7 of it, the design has 8") != std::string::npos);
  write_component("7", "gone.v");
  BOOST_TEST(RtlFinder({folder("ip")}).find(own("7")).why.find("gone.v', which is missing") !=
             std::string::npos);
  std::filesystem::remove_all(folder("plain"));
  std::filesystem::remove_all(folder("ip"));
  std::filesystem::create_directory(folder("ip"));
  BOOST_TEST(RtlFinder({folder("ip")}).find(own()).why ==
             "no module 'own' and no component.xml of me:user:own:1.0 in the folders of RTL");
  BOOST_TEST(input_error([&] { RtlFinder({folder("none")}); }).find("no folder '") == 0u);
}

BOOST_FIXTURE_TEST_CASE(a_module_reference_is_found_by_its_name, Folders) {
  write_component("7", "xgui/own.tcl");
  handoff::Module module = own();
  const RtlFinder finder({folder("ip"), folder("plain")});
  BOOST_TEST(finder.find(module).files.empty());
  module.vlnv = "me:module_ref:own:1.0";
  const std::string component = vp::read_text(folder("ip/component.xml"), "component");
  write("ip/component.xml", kit::replaced(component, ">user<", ">module_ref<"));
  const Names expected{"own.v", "helper.sv"};
  BOOST_TEST(names(RtlFinder({folder("ip"), folder("plain")}).find(module)) == expected);
}

BOOST_FIXTURE_TEST_CASE(an_ip_of_the_vendors_inside_wants_sources, Folders) {
  write_component("7", "own.v");
  write("ip/own.v", "module own_v1_0;\nendmodule\n");
  const std::string component = vp::read_text(folder("ip/component.xml"), "component");
  const std::string core =
      "<spirit:file><spirit:name>src/fir_0/fir_0.xci</spirit:name>"
      "</spirit:file></spirit:fileSet>";
  write("ip/component.xml", kit::replaced(component, "</spirit:fileSet>", core));
  const auto find = [this] { return RtlFinder({folder("ip"), folder("plain")}).find(own()); };
  BOOST_TEST(find().files.empty());
  BOOST_TEST(find().why.find("src/fir_0/fir_0.xci, of which there are no sources") !=
             std::string::npos);
  write("plain/fir_0.v", "module fir_0;\nendmodule\n");
  const Names expected{"own.v", "fir_0.v"};
  BOOST_TEST(names(find()) == expected);
}

BOOST_FIXTURE_TEST_CASE(a_module_without_a_port_of_the_design_is_another_one, Folders) {
  handoff::Module module = own();
  module.ports.push_back({});
  module.ports.back().name = "S00_AXI_aclk";
  module.ports.back().signal = "ps_FCLK_CLK0";
  const auto find = [&] { return RtlFinder({folder("plain")}).find(module); };
  BOOST_TEST(find().files.empty());
  BOOST_TEST(find().why.find("own.v has no port 'S00_AXI_aclk' for its module 'own': it is another "
                             "one, or of another revision") != std::string::npos,
             find().why);
  write("plain/own.v", "module own(input s00_axi_aclk);\n helper h();\nendmodule\n");
  BOOST_TEST(find().why == "");
  BOOST_TEST(find().files.size() == 2u);
  write("plain/own.v", "`include \"ports.vh\"\nmodule own(`PORTS);\n helper h();\nendmodule\n");
  write("plain/ports.vh", "`define PORTS input s00_axi_aclk\n");
  BOOST_TEST(find().why == "");
  module.ports.back().signal.clear();
  write("plain/own.v", "module own;\n helper h();\nendmodule\n");
  BOOST_TEST(find().why == "", "nothing is at the port");
}

// Verilator and GHDL know none of them.
BOOST_FIXTURE_TEST_CASE(primitives_of_the_chip_want_a_model, Folders) {
  const auto why = [this] { return RtlFinder({folder("plain")}).find(own()).why; };
  write("plain/helper.sv",
        "module helper(input clk);\n  OSERDESE2 #(.DATA_WIDTH(10)) s(.CLK(clk));\nendmodule\n");
  BOOST_TEST(why().find("helper.sv instantiates OSERDESE2, a primitive of the chip (UG953)") !=
             std::string::npos);
  for (const std::string harmless : {"// BUFG b(clk);\n", "/* text\n BUFG b(clk); */\n",
                                     "wire BUFG;\n", "`ifdef FPGA\n BUFG b(clk);\n`endif\n"}) {
    write("plain/helper.sv", "module helper(input clk);\n" + harmless + "endmodule\n");
    BOOST_TEST(why() == "");
  }
  write("plain/helper.sv", "module helper(input clk);\n IDDR b(clk);\nendmodule\n");
  BOOST_TEST(why() != "");
  write("plain/iddr.v", "module IDDR(input I);\nendmodule\n");
  BOOST_TEST(why() == "");
  write(
      "plain/own.vhd",
      "entity own is end;\narchitecture a of own is begin\n b: carry4 port map (c, d, q);\nend;\n");
  std::filesystem::remove(*this / "plain/own.v");
  BOOST_TEST(why().find("instantiates CARRY4") != std::string::npos);
}

// What import takes for modelled, the build has, and the other way round.
BOOST_FIXTURE_TEST_CASE(primitives_with_a_model_of_the_build_want_none, Folders) {
  const auto why = [this] { return RtlFinder({folder("plain")}).find(own()).why; };
  unsigned count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(MARKERVP_CELLS)) {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() != ".v" || name.find("xpm_") == 0) continue;
    ++count;
    BOOST_TEST(vp::read_text(entry.path().string(), "cell").find("module " + name) !=
               std::string::npos);
    write("plain/helper.sv", "module helper(input clk);\n " + name + " b(clk);\nendmodule\n");
    BOOST_TEST(why() == "", name);
  }
  BOOST_TEST(count == 29u);
  std::filesystem::remove(*this / "plain/own.v");
  const std::string unisim = vp::read_text(MARKERVP_UNISIM, "primitives");
  for (const std::string name :
       {"BUFG", "BUFGMUX", "BUFH", "BUFIO", "BUFR", "FDRE", "FDSE", "FDCE", "FDPE", "IBUF", "IBUFG",
        "IBUFDS", "IBUFGDS", "LUT1", "LUT6", "OBUF", "OBUFDS"}) {
    BOOST_TEST(unisim.find("\nentity " + name + " is\n") != std::string::npos, name);
    BOOST_TEST(unisim.find("\ncomponent " + name + "\n") != std::string::npos, name);
    write("plain/own.vhd", "entity own is end;\narchitecture a of own is begin\n b: " + name +
                               " port map (c, d);\nend;\n");
    BOOST_TEST(why() == "", name);
  }
}

// As projects keep copies of modules: the one beside what instantiates it.
BOOST_FIXTURE_TEST_CASE(of_two_copies_of_a_module_the_nearest_one, Folders) {
  std::filesystem::create_directory(*this / "copies");
  write("copies/helper.sv", "module helper(input clk);\nendmodule\nmodule other;\nendmodule\n");
  for (const auto& folders : {std::vector{folder("copies"), folder("plain")},
                              std::vector{folder("plain"), folder("copies")}}) {
    const RtlSources sources = RtlFinder(folders).find(own());
    BOOST_TEST(sources.files.size() == 2u);
    BOOST_TEST(sources.files.back() ==
               std::filesystem::absolute(folder("plain/helper.sv")).string());
  }
  write("plain/own.v", "module own;\n other o();\n helper h();\nendmodule\n");
  const RtlSources both = RtlFinder({folder("copies"), folder("plain")}).find(own());
  BOOST_TEST(both.files.size() == 2u, "other comes with a helper of its own");
}

// As Vivado finds them: beside the file, or anywhere in the folders. What is included is no source.
BOOST_FIXTURE_TEST_CASE(files_that_verilog_includes, Folders) {
  const auto find = [this] { return RtlFinder({folder("plain")}).find(own()); };
  write("plain/own.v",
        "`include \"helper.sv\"\n`include \"sizes.vh\"\nmodule own;\n helper h();\nendmodule\n");
  BOOST_TEST(find().files.empty());
  BOOST_TEST(find().why.find("own.v includes 'sizes.vh', which is missing: name its folder") !=
             std::string::npos);
  std::filesystem::create_directory(*this / "plain/more");
  write("plain/more/sizes.vh", "`include \"more/deeper.svh\"\n");
  BOOST_TEST(find().why.find("sizes.vh includes 'more/deeper.svh'") != std::string::npos);
  write("plain/more/deeper.svh", "");
  const RtlSources sources = find();
  const Names expected{"own.v"};
  BOOST_TEST(names(sources) == expected);
  BOOST_TEST(sources.include_dirs.size() == 2u);
  BOOST_TEST(sources.include_dirs.front() + "own.v" == sources.files.front());
  BOOST_TEST(sources.include_dirs.back() == sources.include_dirs.front() + "more/");
  write("plain/own.v", "`ifdef SIMULATION\n`include \"gone.vh\"\n`endif\nmodule own;\nendmodule\n");
  BOOST_TEST(find().why == "");
}

// Of those that say nothing the vendor's tools say low.
// Vivado's template of a peripheral with interrupts has such ones.
BOOST_FIXTURE_TEST_CASE(a_generic_that_is_a_vector_keeps_the_value_of_its_source, Folders) {
  write("vhdl/own.vhd",
        "entity own is\n  generic (\n    SENSES : std_logic_vector := x\"FFFF_FFFF\";\n"
        "    LEVELS : std_logic_vector(3 downto 0) := \"0101\";\n    WIDTH : integer := 1\n  );\n"
        "  port (clk : in bit);\nend own;\n");
  handoff::Module module = own();
  module.parameters["SENSES"] = "0xFFFFFFFF";
  module.parameters["LEVELS"] = "5";
  const RtlSources same = RtlFinder({folder("vhdl")}).find(module);
  BOOST_TEST(same.parameters == std::vector<std::string>{"WIDTH=8"},
             boost::test_tools::per_element());
  BOOST_TEST(same.files.size() == 1u);
  module.parameters["LEVELS"] = "4";
  const RtlSources other = RtlFinder({folder("vhdl")}).find(module);
  BOOST_TEST(other.files.empty());
  BOOST_TEST(other.why == "its generic LEVELS is a vector, and only the value in " +
                              folder("vhdl") + "/own.vhd can be built, not 4");
}

BOOST_FIXTURE_TEST_CASE(a_reset_is_high_if_the_design_says_so, Folders) {
  handoff::Module module = own();
  handoff::Port reset;
  reset.name = "rst";
  reset.kind = "rst";
  module.ports.push_back(reset);
  const RtlFinder finder({folder("plain")});
  BOOST_TEST(finder.find(module).interfaces.empty());
  module.ports.back().active_high = true;
  BOOST_TEST(finder.find(module).interfaces == Names{"rst: reset high"});
}

BOOST_FIXTURE_TEST_CASE(an_imported_design_names_it, Folders) {
  write("plain/own.v",
        "module own #(parameter WIDTH = 1)(input s00_axi_aclk, output done);\n helper h();\n"
        "endmodule\n");
  const auto handoff = handoff::read_hwh(kit::small_handoff().text(), "small.hwh");
  const auto design = block_design::import_design(handoff, RtlFinder({folder("plain")}));
  BOOST_TEST(design.text.find("    rtl: build/own_0.so\n") != std::string::npos);
  BOOST_TEST(block_design::parse_design(design.text, "d.yaml").part("own_0")->rtl ==
             "build/own_0.so");
  const std::string cmake = block_design::import_cmake("small", design, {}, false);
  BOOST_TEST(cmake.find("COMPONENTS programs rtl)") != std::string::npos);
  BOOST_TEST(cmake.find("markervp_add_rtl(own_0 TOP own SOURCES\n  \"") != std::string::npos);
  BOOST_TEST(cmake.find("PARAMETERS WIDTH=8\n  FIGURES STUB_IF_REFUSED)") != std::string::npos);
  BOOST_TEST(block_design::import_report(handoff, design, "").find("| me:user:own:1.0 | RTL |") !=
             std::string::npos);
}

BOOST_AUTO_TEST_CASE(drivers_lie_beside_the_component) {
  const Folders folders;
  folders.write_component("", "hdl/own.v");
  folders.write("ip/drivers/own_v1_0/data/own.mdd", "OPTION supported_peripherals = (own);");
  folders.write("ip/drivers/own_v1_0/src/own.h", "int own;");
  folders.write("plain/drivers/other_v1_0/data/other.mdd", "OPTION supported_peripherals = (own);");
  folders.write("plain/drivers/other_v1_0/src/other.h", "");
  handoff::Handoff handoff;
  handoff.modules = {own(), own()};
  const RtlFinder finder({folders.folder("ip"), folders.folder("plain")});
  const auto drivers = finder.drivers(handoff);
  BOOST_TEST_REQUIRE(drivers.size() == 1u, "of an IP of the design, once");
  BOOST_TEST(drivers[0].name == "own_v1_0");
  BOOST_TEST(drivers[0].sources.size() == 1u);
  BOOST_TEST(finder.drivers(handoff::Handoff()).empty());
}

BOOST_AUTO_TEST_SUITE_END()
