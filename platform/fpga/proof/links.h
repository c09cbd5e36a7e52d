#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

/// The AXI links of RTL, whose rules a proof looks at.
namespace platform::proof {

struct Port;

struct Link {
  enum class Kind { axi4, axi_lite, axi_stream };
  Kind kind = Kind::axi_lite;
  std::string name;
  bool slave = false;  ///< the RTL answers
  /// Its ports, by the name of the signal in small letters: "awvalid", "tdata".
  std::map<std::string, std::string> ports = {};
};

/// What is known of the pins of RTL.
struct Pins {
  struct Reset {
    std::string port;
    bool active_low;
  };
  std::string clock;  ///< the port of the only one
  std::vector<Reset> resets = {};
  std::vector<Link> links = {};
  std::map<std::string, std::uint64_t> ties = {};  ///< inputs that never change
};

/// Finds them among the ports of a module. Throws vp::InputError for what cannot be told, or has no
/// links.
using FindPins = std::function<Pins(const std::vector<Port>& ports)>;

/// In words, a line each: what is assumed of the inputs of RTL with these pins.
std::vector<std::string> assumptions(const Pins& pins);

}  // namespace platform::proof
