#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <facts/result.h>

namespace platform::handoff {

/// The registers behind one interface of an IP.
struct RegisterMap {
  std::string interface;  ///< "s_axi_control", of an HLS header "control"; "": any
  std::vector<facts::HardwareMap::Register> registers;
};

/// What a file says of an IP's registers: a component.xml (IP-XACT, the vendor's or that of
/// Accellera), a header of Vitis HLS (x<ip>_hw.h), or SystemRDL (.rdl). Throws vp::InputError with
/// file and line for what is damaged, and for what is not read.
std::vector<RegisterMap> read_registers(const std::string& file);

/// The registers of `maps` behind an interface, which may be the only one that the IP has.
const std::vector<facts::HardwareMap::Register>* registers_behind(
    const std::vector<RegisterMap>& maps, const std::string& interface, bool only);

}  // namespace platform::handoff
