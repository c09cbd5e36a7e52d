#include <fpga/synthesis/cell_kinds.h>

#include <initializer_list>

namespace platform::synthesis {

namespace {

bool is_one_of(const std::string& type, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (type == name) return true;
  }
  return false;
}

}  // namespace

bool starts_with(const std::string& text, const char* begin) {
  return text.rfind(begin, 0) == 0;
}

Kind kind_of(const std::string& type) {
  if (type == "INV") return Kind::inverter;
  if (type == "CARRY4") return Kind::carry;
  if (type == "DSP48E1") return Kind::dsp;
  if (type == "MUXF7" || type == "MUXF8") return Kind::mux;
  // _1: at the falling edge.
  if (is_one_of(type, {"FDRE", "FDSE", "FDCE", "FDPE", "FDRE_1", "FDSE_1", "FDCE_1", "FDPE_1"}))
    return Kind::ff;
  if (is_one_of(type, {"LDCE", "LDPE"})) return Kind::latch;
  if (type.size() == 4 && starts_with(type, "LUT")) return Kind::lut;
  if (starts_with(type, "RAMB")) return Kind::bram;
  if (starts_with(type, "RAM")) return Kind::lutram;
  if (starts_with(type, "SRL")) return Kind::shift;
  if (is_one_of(type,
                {"IBUF",     "IBUFG",   "IBUFDS", "IBUFGDS",  "OBUF",  "OBUFDS", "OBUFT", "OBUFTDS",
                 "IOBUF",    "IOBUFDS", "PULLUP", "PULLDOWN", "VCC",   "GND",    "BUFG",  "BUFGCE",
                 "BUFGCTRL", "BUFGMUX", "BUFH",   "BUFHCE",   "BUFIO", "BUFMR",  "BUFR"}))
    return Kind::outside;
  return Kind::unknown;
}

unsigned luts_of(const std::string& type) {
  if (type == "RAM32M" || type == "RAM64M" || type == "RAM128X1D") return 4;
  if (type == "RAM32X1D" || type == "RAM64X1D" || type == "RAM128X1S") return 2;
  if (type == "RAM256X1S") return 4;
  return 1;
}

bool is_clock(Kind kind, const std::string& port) {
  if (kind == Kind::latch) return port == "G";
  return port == "C" || port == "CLK" || port == "WCLK" || starts_with(port, "CLKA") ||
         starts_with(port, "CLKB");
}

}  // namespace platform::synthesis
