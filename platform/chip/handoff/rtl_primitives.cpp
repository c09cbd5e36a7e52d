#include <chip/handoff/rtl_primitives.h>

#include <vp/text.h>

#include <algorithm>
#include <cctype>
#include <regex>
#include <string_view>

namespace platform::handoff {

namespace {

/// Of the 7 series (UG953).
const std::regex& primitive_instance(bool vhdl) {
  static const std::string names =
      "(BSCANE2|BUFG|BUFGCE|BUFGCE_1|BUFGCTRL|BUFGMUX|BUFGMUX_1|BUFGMUX_CTRL|BUFH|BUFHCE|BUFIO|"
      "BUFMR|BUFMRCE|BUFR|CAPTUREE2|CARRY4|CFGLUT5|DNA_PORT|DSP48E1|EFUSE_USR|FD[CPRS]E|FDCE_1|"
      "FIFO18E1|FIFO36E1|FRAME_ECCE2|GT[HPX]E2_CHANNEL|GT[HPX]E2_COMMON|IBUF|IBUFDS|"
      "IBUFDS_DIFF_OUT|IBUFDS_GTE2|IBUFG|IBUFGDS|ICAPE2|IDDR|IDDR_2CLK|IDELAYCTRL|IDELAYE2|IN_FIFO|"
      "IOBUF|IOBUFDS|ISERDESE2|LD[CP]E|LUT[1-6]|LUT6_2|MMCME2_ADV|MMCME2_BASE|MUXF[78]|OBUF|OBUFDS|"
      "OBUFT|OBUFTDS|ODDR|ODELAYE2|OSERDESE2|OUT_FIFO|PLLE2_ADV|PLLE2_BASE|PS7|RAM(32|64)M|"
      "RAM(32|64|128|256)X1[DS]|RAMB18E1|RAMB36E1|SRL16E|SRLC32E|STARTUPE2|USR_ACCESSE2|XADC)";
  static const std::regex verilog("\\b" + names + "\\s*(#\\s*\\(|[A-Za-z_]\\w*\\s*\\()");
  static const std::regex entity(":\\s*" + names + "\\s+(generic|port)\\s+map\\b",
                                 std::regex::icase);
  return vhdl ? entity : verilog;
}

}  // namespace

bool has_model(const std::string& primitive, bool vhdl) {
  static const std::regex both(
      "BUFG|BUFGMUX|BUFH|BUFIO|BUFR|FD[CPRS]E|IBUF|IBUFDS|IBUFG|IBUFGDS|LUT[1-6]|OBUF|OBUFDS");
  static const std::regex verilog("BUFGCE|BUFGMUX_CTRL|CARRY4|LUT6_2|MUXF[78]|SRL16E|SRLC32E");
  return std::regex_match(primitive, both) || (!vhdl && std::regex_match(primitive, verilog));
}

std::string unconditional(const std::string& text, bool vhdl) {
  std::string result;
  bool in_block = false;
  unsigned depth = 0;
  for (const std::string& line : vp::split(text, '\n')) {
    std::string kept;
    for (std::size_t i = 0; i < line.size(); ++i) {
      const std::string_view two = std::string_view(line).substr(i, 2);
      if (in_block) {
        if (two == "*/") ++i;
        in_block = two != "*/";
      } else if (two == (vhdl ? "--" : "//")) {
        break;
      } else if (!vhdl && two == "/*") {
        in_block = true;
      } else {
        kept += line[i];
      }
    }
    if (kept.find("`ifdef") != kept.npos || kept.find("`ifndef") != kept.npos) ++depth;
    if (depth == 0) result += kept + '\n';
    if (kept.find("`endif") != kept.npos && depth != 0) --depth;
  }
  return result;
}

std::set<std::string> primitives_in(const std::string& source, bool vhdl) {
  std::set<std::string> found;
  const std::string text = unconditional(source, vhdl);
  for (std::sregex_iterator at(text.begin(), text.end(), primitive_instance(vhdl)), end; at != end;
       ++at) {
    std::string name = (*at)[1];
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return std::toupper(c); });
    found.insert(std::move(name));
  }
  return found;
}

}  // namespace platform::handoff
