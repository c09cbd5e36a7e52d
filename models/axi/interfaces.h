#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <pl/common/rtl_interface.h>

namespace axi {

enum class Kind { axi4, axi_lite, axi_stream, interrupt, clock, reset, wire };

const char* to_string(Kind kind);

/// Ports of RTL that belong together.
struct Interface {
  Kind kind = Kind::wire;
  std::string name;    ///< of its ports without the signal: "s_axi_control"; of one port its name
  bool slave = false;  ///< the RTL answers: AWVALID, ARVALID or TVALID, or a single port, is input
  bool edge = false;   ///< an interrupt by its rising edge
  bool active_low = false;  ///< a reset
  std::string clock;        ///< the port of its clock; empty: RTL without one
  /// Number of the port, by the name of the signal in small letters: "awvalid", "tdata"; of a
  /// single port by "".
  std::map<std::string, std::uint32_t> ports;

  bool has(const std::string& signal) const { return ports.count(signal) != 0; }
};

/// Finds the interfaces among the ports of RTL, in the order of their first ports.
///
/// A port is `interface_signal`, whatever the interface is called (UG1118); the direction of
/// VALID says which side it is. X_INTERFACE_INFO and X_INTERFACE_PARAMETER of the source win over
/// names, what the user says (INTERFACES) over both: "<port or prefix>: <kind> [high|low] [rising]
/// [clock <port>]". Clocks and resets are found as the vendor's packager does it; an interface
/// belongs to the clock that names it, that shares most words of its name, or that is the only one.
///
/// Throws vp::InputError with file and line: half an interface; a reset whose polarity neither an
/// attribute nor the name tells; several clocks of which none is the interface's; a note about a
/// port that is not there. `option` is what messages call that by which users say what a port is.
std::vector<Interface> find_interfaces(const RtlDescriptor& rtl,
                                       const std::string& option = "INTERFACES");

}  // namespace axi
