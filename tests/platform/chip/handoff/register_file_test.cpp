// Registers of RTL, as IP-XACT, SystemRDL and the headers of Vitis HLS describe them.
#include <chip/handoff/register_file.h>
#include <boost/test/unit_test.hpp>

#include <string>
#include <vector>

#include "input_error.h"
#include "temporary_files.h"

using namespace platform;
using handoff::RegisterMap;

namespace {

struct Folder : kit::TemporaryFolder {
  std::vector<RegisterMap> read(const std::string& name, const std::string& text) const {
    kit::write_file(*this / name, text);
    return handoff::read_registers(*this / name);
  }
  /// What is said of a file that is refused, without its folder.
  std::string refusal(const std::string& name, const std::string& text) const {
    const std::string message = input_error([&] { read(name, text); });
    const std::string folder = path() + "/";
    return message.rfind(folder, 0) == 0 ? message.substr(folder.size()) : message;
  }
};

/// "CTRL 0x0 rw =1 ~0x3 {GO 0x1 rw, DONE 0x2 ro}" for each: offset, access, reset, writable.
std::string text_of(const RegisterMap& map) {
  std::string text;
  const auto hex = [](std::uint32_t value) {
    char digits[16];
    std::snprintf(digits, sizeof digits, "%x", value);
    return std::string(digits);
  };
  for (const auto& r : map.registers) {
    text += r.name + " " + hex(r.offset) + " " + r.access + " =" + hex(r.reset) + " ~" +
            hex(r.writable);
    for (const auto& f : r.fields) text += " " + f.name + ":" + hex(f.mask) + ":" + f.access;
    text += "\n";
  }
  return text;
}

std::string tag(const std::string& name, const std::string& inside) {
  return "<spirit:" + name + ">" + inside + "</spirit:" + name + ">";
}

std::string component(const std::string& block) {
  return "<spirit:component xmlns:spirit=\"x\">\n" +
         tag("busInterfaces",
             tag("busInterface",
                 tag("name", "S_AXI") +
                     tag("slave", "<spirit:memoryMapRef spirit:memoryMapRef=\"map\"/>"))) +
         tag("memoryMaps", tag("memoryMap", tag("name", "map") + block)) + "\n</spirit:component>";
}

std::string block(const std::string& registers) {
  return tag("addressBlock",
             tag("baseAddress", "0x10") + tag("range", "4096") + tag("width", "32") + registers);
}

std::string one(const std::string& name, const std::string& offset, const std::string& more) {
  return "\n" + tag("register", tag("name", name) + tag("addressOffset", offset) + more);
}

constexpr const char* hls = R"(// control
// 0x00 : Control signals
//        bit 0  - ap_start (Read/Write/COH)
//        bit 1  - ap_done (Read/COR)
//        others - reserved
// 0x0c : IP Interrupt Status Register (Read/TOW)
//        bit 0 - ap_done (Read/TOW)
// 0x10 : Data signal of size
//        bit 31~0 - size[31:0] (Read/Write)
// 0x18 : Data signal of ap_return
//        bit 31~0 - ap_return[31:0] (Read)
// 0x20 ~
// 0x27 : Memory 'taps' (2 * 32b)
#define XFIR_CONTROL_ADDR_AP_CTRL   0x00
#define XFIR_CONTROL_ADDR_ISR       0x0c
#define XFIR_CONTROL_ADDR_SIZE_DATA 0x10
#define XFIR_CONTROL_BITS_SIZE_DATA 32
#define XFIR_CONTROL_ADDR_AP_RETURN 0x18
#define XFIR_CONTROL_ADDR_TAPS_BASE 0x20
#define XFIR_CONTROL_ADDR_TAPS_HIGH 0x27
#define XFIR_CONTROL_WIDTH_TAPS     32
)";

constexpr const char* rdl = R"(// A comment
addrmap filter {
  name = "A filter"; default sw = rw;
  reg { desc = "what it does";
    field { } go = 0; field { sw = r; onread = rclr; } done[2:1] = 2'b10;
    field { woclr; hw = w; } error[31:31];
  } CTRL;
  reg tap_t { field { } value[16] = 16'hAA; };
  tap_t TAP[2] @0x10 += 8;
  regfile { tap_t LOW; tap_t HIGH; } BANK @0x40;
  BANK -> desc = "two";
  reg { regwidth = 64; field {} value[64] = 64'h1_0000_0002; } STAMP @ 0x80;
};
)";

}  // namespace

BOOST_FIXTURE_TEST_CASE(a_component_of_vivado_has_registers_behind_its_interface, Folder) {
  const std::string field =
      tag("field", tag("name", "GO") + tag("bitOffset", "0") + tag("bitWidth", "1")) +
      tag("field", tag("name", "DONE") + tag("bitOffset", "1") + tag("bitWidth", "2") +
                       tag("access", "read-only")) +
      tag("field", tag("name", "ERR") + tag("bitOffset", "8") + tag("bitWidth", "1") +
                       tag("modifiedWriteValue", "oneToClear"));
  const auto maps =
      read("component.xml",
           component(block(one("CTRL", "0x0",
                               tag("size", "32") + tag("access", "read-write") +
                                   tag("reset", tag("value", "0x3")) + field) +
                           one("TIME", "0x8", tag("size", "64") + tag("access", "read-only")) +
                           one("TAP", "'h20", tag("dim", "2") + tag("size", "32")))));
  BOOST_REQUIRE(maps.size() == 1u);
  BOOST_TEST(maps.front().interface == "S_AXI");
  BOOST_TEST(text_of(maps.front()) ==
             "CTRL 10 rw =3 ~101 GO:1:rw DONE:6:ro ERR:100:w1c\n"
             "TIME 18 ro =0 ~0\nTIME_HI 1c ro =0 ~0\n"
             "TAP[0] 30 rw =0 ~ffffffff\nTAP[1] 34 rw =0 ~ffffffff\n");
}

// Vivado HLS states their size in bytes.
BOOST_FIXTURE_TEST_CASE(a_memory_of_vivado_hls_is_its_words, Folder) {
  const std::string access = tag("access", "read-write");
  const auto maps = read(
      "component.xml", component(block(one("CTRL", "0", tag("size", "32") + access) +
                                       one("Memory_taps_V", "0x40", tag("size", "80") + access))));
  BOOST_TEST_REQUIRE(maps.front().registers.size() == 21u);
  BOOST_TEST(maps.front().registers[1].name == "taps_V[0]");
  BOOST_TEST(maps.front().registers[1].offset == 0x50u);
  BOOST_TEST(maps.front().registers[20].name == "taps_V[19]");
  BOOST_TEST(maps.front().registers[20].offset == 0x9Cu);
  BOOST_TEST(maps.front().registers[20].access == "rw");
  BOOST_TEST(refusal("a.xml", component(block(one("Memory_m", "0", tag("size", "400000"))))) ==
             "a.xml:3: a memory of more than 65536 words");
}

BOOST_FIXTURE_TEST_CASE(a_header_of_vitis_names_registers_bits_and_memories, Folder) {
  const auto maps = read("xfir_hw.h", hls);
  BOOST_REQUIRE(maps.size() == 1u);
  BOOST_TEST(text_of(maps.front()) ==
             "AP_CTRL 0 rw =0 ~1 ap_start:1:rw ap_done:2:ro\n"
             "ISR c rw =0 ~1 ap_done:1:w1t\n"
             "SIZE_DATA 10 rw =0 ~ffffffff size:ffffffff:rw\n"
             "AP_RETURN 18 ro =0 ~0 ap_return:ffffffff:ro\n"
             "TAPS[0] 20 rw =0 ~ffffffff\nTAPS[1] 24 rw =0 ~ffffffff\n");
  BOOST_TEST(handoff::registers_behind(maps, "s_axi_control", false) == &maps.front().registers);
  BOOST_TEST(handoff::registers_behind(maps, "s_axi_data", false) == nullptr);
}

BOOST_FIXTURE_TEST_CASE(system_rdl_lays_registers_out, Folder) {
  const auto maps = read("filter.rdl", rdl);
  BOOST_REQUIRE(maps.size() == 1u);
  BOOST_TEST(text_of(maps.front()) ==
             "CTRL 0 rw =4 ~80000001 go:1:rw done:6:ro error:80000000:w1c\n"
             "TAP[0] 10 rw =aa ~ffff value:ffff:rw\nTAP[1] 18 rw =aa ~ffff value:ffff:rw\n"
             "BANK_LOW 40 rw =aa ~ffff value:ffff:rw\nBANK_HIGH 44 rw =aa ~ffff value:ffff:rw\n"
             "STAMP 80 rw =2 ~ffffffff value:ffffffff:rw\nSTAMP_HI 84 rw =1 ~ffffffff "
             "value:ffffffff:rw\n");
  BOOST_TEST(maps.front().registers.front().documentation == "what it does");
  BOOST_TEST(maps.front().registers.front().fields[1].documentation == "cleared by reading");
}

BOOST_FIXTURE_TEST_CASE(damaged_files_are_refused_with_their_line, Folder) {
  BOOST_TEST(refusal("a.xml", component(block(one("A", "0x0", tag("size", "32")) +
                                              one("B", "none", tag("size", "32"))))) ==
             "a.xml:4: 'none' is no number");
  BOOST_TEST(refusal("a.xml", component(block(one("A", "0x0", "")))) ==
             "a.xml:3: no <spirit:size> in it");
  BOOST_TEST(refusal("a.xml", component(block(one("A", "0", tag("size", "128"))))) ==
             "a.xml:3: register 'A' has 128 bits: 1 to 64 are read");
  const std::string far =
      tag("field", tag("name", "F") + tag("bitOffset", "30") + tag("bitWidth", "4"));
  BOOST_TEST(refusal("a.xml", component(block(one("A", "0", tag("size", "32") + far)))) ==
             "a.xml:3: register 'A' of 32 bits has field 'F' of 4 from bit 30 on");
  BOOST_TEST(refusal("a.xml", "<spirit:component>").find("this is not whole XML") !=
             std::string::npos);
  BOOST_TEST(refusal("a.h", "int main;\n").find("is it x<ip>_hw.h?") != std::string::npos);
  BOOST_TEST(refusal("a.h", "\n#define XF_C_ADDR_A 0xZZ\n") == "a.h:2: '0xZZ' is no number");
  BOOST_TEST(refusal("a.rdl", "addrmap a {\n reg { field {} x; } R\n}") ==
             "a.rdl:3: '}' where ';' belongs");
  BOOST_TEST(refusal("a.rdl", "addrmap a {\n") == "a.rdl:2: the file ends inside of a component");
  BOOST_TEST(refusal("a.rdl", "/* a\n").find("a.rdl:1: a comment that does not end") == 0u);
  BOOST_TEST(refusal("a.rdl", "\n`define A\n").find("a.rdl:2: a macro") == 0u);
  BOOST_TEST(refusal("a.rdl", "reg r #(n = 1) {};").find("parameters") != std::string::npos);
  BOOST_TEST(
      refusal("a.rdl", "addrmap a { reg { field {} x; } R[1000000]; };").find("more than 65536") !=
      std::string::npos);
  BOOST_TEST(refusal("a.txt", "").find("registers are read from .xml") != std::string::npos);
}
