// The reader of Vivado's hand-offs: what it takes from one, and what it refuses.
#include <chip/handoff/archive.h>
#include <chip/handoff/handoff.h>
#include <chip/handoff/netlist.h>
#include <vp/error.h>
#include <vp/file.h>
#include <zip.h>
#include <boost/test/unit_test.hpp>

#include <string>
#include <utility>
#include <vector>

#include "input_error.h"
#include "small_handoff.h"
#include "temporary_files.h"

using namespace platform::handoff;

using kit::replaced;

namespace {

Handoff small() {
  return read_hwh(kit::small_handoff().text(), "small.hwh");
}

/// What the refusal of a text says.
std::string refusal(const std::string& text) {
  return input_error([&] { read_hwh(text, "x.hwh"); });
}

using Members = std::vector<std::pair<std::string, std::string>>;

/// A zip of these files.
std::string archive(const std::string& path, const Members& members) {
  int error = 0;
  zip_t* zip = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &error);
  BOOST_TEST_REQUIRE(zip != nullptr);
  for (const auto& [name, text] : members) {
    zip_source_t* source = zip_source_buffer(zip, text.data(), text.size(), 0);
    zip_file_add(zip, name.c_str(), source, ZIP_FL_ENC_UTF_8);
  }
  BOOST_TEST_REQUIRE(zip_close(zip) == 0);
  return path;
}

std::string list_of(const std::string& files) {
  return "<Project>" + files + "</Project>";
}

std::string listed(const std::string& name, const std::string& kind) {
  return "<File Type=\"HW_HANDOFF\" Name=\"" + name + "\" BD_TYPE=\"" + kind + "\"/>";
}

}  // namespace

BOOST_AUTO_TEST_SUITE(handoff)

BOOST_AUTO_TEST_CASE(what_a_module_is) {
  const Handoff handoff = small();
  BOOST_TEST(handoff.name == "small");
  BOOST_TEST(handoff.device == "xc7z020-1");
  BOOST_TEST(handoff.part == "xc7z020clg400-1");
  BOOST_TEST(handoff.modules.size() == 10u);
  const Module& gpio = *handoff.module("axi_gpio_0");
  BOOST_TEST(gpio.ip() == "axi_gpio");
  BOOST_TEST(gpio.is_vendors());
  BOOST_TEST(!handoff.module("own_0")->is_vendors());
  BOOST_TEST(parameter(gpio.parameters, "c_gpio_width") == "4");
  BOOST_TEST(gpio.port("gpio_io_i")->width == 4u);
  BOOST_TEST(handoff.module("own_0")->interface("M_NOTHING")->bus == "");
  BOOST_TEST(handoff.ps().segments.at(1).base == 0x4120'0000u);
  BOOST_TEST(handoff.ps().segments.at(1).last == 0x4120'FFFFu);
}

// Vivado 2015 names neither what an interface is nor the logical names of its pins.
BOOST_AUTO_TEST_CASE(interfaces_without_vlnv_are_known_by_their_pins) {
  const auto kind = [](const std::string& pins) {
    kit::HwhText text = kit::small_handoff();
    text.module("old_0", "me:user:old:1.0", "", "",
                kit::element("BUSINTERFACE", {{"BUSNAME", "b"}, {"NAME", "S"}, {"TYPE", "SLAVE"}},
                             "<PORTMAPS>" + pins + "</PORTMAPS>"));
    return read_hwh(text.text(), "x.hwh").module("old_0")->interface("S")->kind;
  };
  BOOST_TEST(kind(R"(<PORTMAP PHYSICAL="s00_axi_awaddr"/><PORTMAP PHYSICAL="s00_axi_wdata"/>)") ==
             "aximm");
  BOOST_TEST(kind(R"(<PORTMAP PHYSICAL="S_AXIS_TVALID"/>)") == "axis");
  BOOST_TEST(kind(R"(<PORTMAP PHYSICAL="valid"/>)") == "");
}

BOOST_AUTO_TEST_CASE(a_frequency_with_an_exponent) {
  const Handoff handoff = small();
  BOOST_TEST(*handoff.module("clk_0")->port("pixel_clk")->hz == 74'250'000.0);
}

BOOST_AUTO_TEST_CASE(interrupts_through_two_concats) {
  const Handoff handoff = small();
  const auto interrupts = Netlist(handoff).interrupts();
  BOOST_TEST_REQUIRE(interrupts.size() == 3u);
  const std::pair<std::uint32_t, std::string> expected[] = {
      {61, "s2mm_introut"}, {62, "mm2s_introut"}, {63, "ip2intc_irpt"}};
  for (std::size_t i = 0; i < 3; ++i) {
    BOOST_TEST(interrupts[i].id == expected[i].first);
    BOOST_TEST(interrupts[i].source.pin.port->name == expected[i].second);
  }
}

BOOST_AUTO_TEST_CASE(a_wire_to_nothing_is_no_interrupt) {
  const std::string text =
      replaced(kit::small_handoff().text(), R"(NAME="In1" SIGNAME="gpio_irpt")", R"(NAME="In1")");
  const Handoff handoff = read_hwh(text, "x.hwh");
  BOOST_TEST(Netlist(handoff).interrupts().size() == 2u);
}

BOOST_AUTO_TEST_CASE(a_ring_of_concats_is_refused) {
  const std::string text =
      replaced(kit::small_handoff().text(), R"(NAME="In0" SIGNAME="dma_s2mm_introut")",
               R"(NAME="In0" SIGNAME="of_dma_dout")");
  const Handoff handoff = read_hwh(text, "x.hwh");
  BOOST_TEST(input_error([&] { Netlist(handoff).interrupts(); }) ==
             "the wires at of_dma run in a ring");
}

BOOST_AUTO_TEST_CASE(other_families_are_refused_by_name) {
  kit::HwhText text = kit::small_handoff();
  text.arch = "zynquplus";
  text.device = "zu3eg";
  BOOST_TEST(refusal(text.text()) ==
             "x.hwh:2: the design is for a zynquplus (zu3eg): markervp models the Zynq-7000 alone");
  kit::HwhText microblaze("soft");
  microblaze.module("cpu", "xilinx.com:ip:microblaze:11.0", "", "");
  BOOST_TEST(refusal(microblaze.text()) ==
             "x.hwh:2: design 'soft' has no processing_system7, but a MicroBlaze, which markervp "
             "does not model");
}

BOOST_AUTO_TEST_CASE(a_processing_system_in_pieces_is_refused) {
  const std::string refused = refusal(
      "<EDKSYSTEM VIVADOVERSION=\"2014.4\"><SYSTEMINFO ARCH=\"zynq\" DEVICE=\"7z020\" "
      "NAME=\"x\"/><MODULES><MODULE MODTYPE=\"ps7_clockc\"/><MODULE "
      "MODTYPE=\"ps7_cortexa9\"/></MODULES></EDKSYSTEM>");
  BOOST_TEST(refused.find("it lists the processing system in pieces") != std::string::npos,
             refused);
}

BOOST_AUTO_TEST_CASE(damaged_and_hostile_text_is_refused) {
  const std::string text = kit::small_handoff().text();
  const std::string bomb =
      "<!DOCTYPE a [<!ENTITY b \"xxxxxxxxxx\"><!ENTITY c \"&b;&b;&b;\">]>\n" + text.substr(22);
  BOOST_TEST(refusal(bomb).find("a document type declaration") != std::string::npos);
  for (const std::size_t size : {text.size() / 2, text.size() - 5, std::size_t{30}}) {
    BOOST_TEST_CONTEXT(size) {
      BOOST_TEST(refusal(text.substr(0, size)).find("this is not whole XML") != std::string::npos);
    }
  }
  const std::string twice = text + text.substr(22);
  BOOST_TEST(refusal(twice).find("a second <EDKSYSTEM> in one file") != std::string::npos);
  BOOST_TEST(refusal("<a/>").find("begins with <a>, not with <EDKSYSTEM>") != std::string::npos);
  std::string deep;
  for (int i = 0; i < 200'000; ++i) deep += "<a>";
  BOOST_TEST(refusal(deep).find("this is not whole XML") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(what_does_not_fit_together_is_refused_with_its_line) {
  const std::string text = kit::small_handoff().text();
  BOOST_TEST(refusal(replaced(text, "0x4120FFFF", "0x4100FFFF"))
                 .find("the segment of axi_gpio_0 ends before it begins") != std::string::npos);
  BOOST_TEST(refusal(replaced(text, "0x4120FFFF", "0x4120GFFF"))
                 .find("HIGHVALUE '0x4120GFFF' is not a number") != std::string::npos);
  BOOST_TEST(refusal(replaced(text, R"(INSTANCE="own_0" MODTYPE)", R"(INSTANCE="mem" MODTYPE)"))
                 .find("a second module 'mem'") != std::string::npos);
  BOOST_TEST(refusal(replaced(text, "me:user:own:1.0", "own"))
                 .find("VLNV 'own' is not vendor:library:name:version") != std::string::npos);
  BOOST_TEST(
      refusal(replaced(text, R"(LEFT="3")", R"(LEFT="99999999")")).find("at most 65536 are read") !=
      std::string::npos);
}

BOOST_AUTO_TEST_CASE(an_archive_says_which_hand_off_is_the_design) {
  const kit::TemporaryFolder folder;
  const std::string design = kit::small_handoff().text();
  const std::string inner =
      "<EDKSYSTEM><SYSTEMINFO ARCH=\"zynq\" DEVICE=\"7z020\" NAME=\"bd\"/></EDKSYSTEM>";
  const std::string path = folder / "a.xsa";
  archive(path, {{"bd_0.hwh", inner},
                 {"small.hwh", design},
                 {"sysdef.xml",
                  list_of(listed("bd_0.hwh", "SCOPED_BD") + listed("small.hwh", "DEFAULT_BD"))}});
  BOOST_TEST(read_handoff(path).file == "a.xsa:small.hwh");
  archive(path, {{"bd_0.hwh", inner}, {"small.hwh", design}});
  BOOST_TEST(read_handoff(path).name == "small");
  archive(path, {{"other.hwh", design}, {"small.hwh", design}});
  BOOST_TEST(input_error([&] {
               read_handoff(path);
             }).find("holds 2 designs: choose one with --block-design, other or small") !=
             std::string::npos);
  BOOST_TEST(read_handoff(path, "other").file == "a.xsa:other.hwh");
  BOOST_TEST(input_error([&] { read_handoff(path, "none"); }).find("has no design 'none'") !=
             std::string::npos);
  archive(path, {{"a/small.hwh", design}, {"b/small.hwh", design}});
  BOOST_TEST(input_error([&] {
               read_handoff(path, "small");
             }).find("has no design 'small': there is a/small.hwh or b/small.hwh") !=
             std::string::npos);
  BOOST_TEST(read_handoff(path, "b/small.hwh").file == "a.xsa:b/small.hwh");
}

BOOST_AUTO_TEST_CASE(an_archive_has_the_drivers_of_own_ip) {
  const kit::TemporaryFolder folder;
  const std::string path = archive(
      folder / "a.xsa",
      {{"small.hwh", kit::small_handoff().text()},
       {"drivers/own_v1_0/data/own.mdd", "OPTION supported_peripherals = (own_v1_0 other);"},
       {"drivers/own_v1_0/data/own.tcl",
        "xdefine_include_file $h \"xparameters.h\" \"XOwn\" \\\n  \"NUM_INSTANCES\" \\\n  "
        "\"DEVICE_ID\"\n\"x\"\n::hsi::utils::define_config_file $h \"own_g.c\" \"Own\"\n"},
       {"drivers/own_v1_0/src/xown.c", "int own;"},
       {"drivers/own_v1_0/src/xown_linux.c", "int linux;"},
       {"drivers/own_v1_0/src/deep/er/xown.c", "int deeper;"},
       {"drivers/nameless_v1_0/src/nameless.h", ""},
       {"drivers/data/plain.mdd", "OPTION supported_peripherals = (plain);"},
       {"drivers/src/plain.h", "int plain;"}});
  const std::vector<OwnDriver> drivers = read_handoff(path).drivers;
  BOOST_TEST_REQUIRE(drivers.size() == 2u, "without a description of its IP one is no use");
  BOOST_TEST(drivers[0].name == "plain");
  const OwnDriver& own = drivers[1];
  BOOST_TEST(own.drives("own"));
  BOOST_TEST(own.drives("other"));
  BOOST_TEST(!own.drives("own_v1_0"));
  BOOST_TEST(own.has("xown.c"));
  BOOST_TEST(!own.has("xown_linux.c"));
  BOOST_TEST_REQUIRE(own.sources.size() == 1u);
  BOOST_TEST(own.sources[0].first == "xown.c");
  const std::vector<std::string> words{"xparameters.h", "XOwn", "NUM_INSTANCES", "DEVICE_ID"};
  BOOST_TEST(!is_of_driver("drivers/../src/hostile.h"));
  BOOST_TEST(own.scripts.at("xdefine_include_file") == words, boost::test_tools::per_element());
  BOOST_TEST(own.scripts.at("xdefine_config_file").front() == "own_g.c", "its name without an x");
}

BOOST_AUTO_TEST_CASE(archives_that_are_no_archives) {
  const kit::TemporaryFolder folder;
  const std::string path = folder / "a.xsa";
  const auto error = [&] { return input_error([&] { read_handoff(path); }); };
  archive(path, {{"small.hwh", kit::small_handoff().text()}});
  const std::string whole = vp::read_text(path, "zip", 1 << 26);
  for (std::size_t size = 4; size < whole.size(); size += whole.size() / 5) {
    vp::write_file(path, whole.substr(0, size));
    BOOST_TEST(error().find("damaged") != std::string::npos, error());
  }
  // Its data, between the local header and the directory.
  for (std::size_t at = 100; at < whole.size() - 200; at += 37) {
    std::string flipped = whole;
    flipped[at] = static_cast<char>(flipped[at] ^ 0x55);
    vp::write_file(path, flipped);
    BOOST_TEST(error().find("damaged") != std::string::npos, "byte " << at << ": " << error());
  }
  archive(path, {{"../small.hwh", "x"}});
  BOOST_TEST(error().find("'../small.hwh', which leaves its folder") != std::string::npos);
  archive(path, {{"readme.txt", "x"}});
  BOOST_TEST(error().find("holds no hand-off (.hwh)") != std::string::npos);
  archive(path, {{"old.hwh", "<MODULE MODTYPE=\"ps7_cortexa9\"/>"}});
  BOOST_TEST(error().find("lists the processing system in pieces") != std::string::npos);
  archive(path, {{"other.hwh", "<MODULE MODTYPE=\"axi_dma\"/>"}});
  BOOST_TEST(error().find("it is for another family") != std::string::npos);
  vp::write_file(path, "hello");
  BOOST_TEST(error().find("is neither XML nor a zip") != std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
