#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include <fpga/synthesis/rtl_design.h>

/// What RTL in the place of an IP has to do, and at which inputs.
namespace platform::proof {

/// The pins of an IP as a system drives them and looks at them, as `rtl check` does: what is said
/// of RTL in its place holds under these conditions. Names are those of ports.
struct Contract {
  std::string ip;
  /// The least legal ones that its function depends on: the sooner a proof closes.
  synthesis::Parameters least = {};
  /// Of them those that choose a structure, not a function: other RTL need not have them.
  std::set<std::string> structural = {};
  std::vector<std::string> resets = {};  ///< high; all of them are on the first clock

  /// An output that is looked at while another port is high, or once it was.
  struct Gate {
    std::string output, by;
    bool once = false;
  };
  std::vector<Gate> gates = {};
  /// Outputs that only reports look at: other RTL may lack them, or have fewer bits.
  std::set<std::string> reports = {};

  /// Pixels come in raster order, from the first one of a frame on.
  struct Frames {
    std::string valid, x, y;
    bool whole = false;     ///< only a reset cuts a frame
    std::string gap = "1";  ///< clocks between two frames at least, an expression of parameters
    std::string may_begin = {};  ///< an output that is high before a frame begins; empty: none
  };
  std::optional<Frames> frames = {};

  /// A toggle from another clock changes when its last change was seen; a reset clears it.
  struct Toggle {
    std::string toggle, seen;
  };
  std::vector<Toggle> toggles = {};
  std::vector<std::string> streams_in = {}, streams_out = {};  ///< prefixes of their pins: "m"
};

/// Throws vp::InputError for an unknown IP, with those that have one.
const Contract& contract_of(const std::string& ip);

/// The same in words, a line each: what is assumed of the inputs, with these parameters.
std::vector<std::string> assumptions(const Contract& contract);

}  // namespace platform::proof
