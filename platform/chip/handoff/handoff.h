#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <chip/handoff/own_driver.h>

/// What a hand-off of Vivado (.hwh, .xsa, .hdf) says of a block design, as plain values.
namespace platform::handoff {

/// Parameters of an IP or an interface, as written.
using Parameters = std::map<std::string, std::string>;

/// The value of a parameter, whose name counts without capitals; "" if it is missing.
std::string parameter(const Parameters& parameters, const std::string& name);

/// A pin of a module or of the block design.
struct Port {
  std::string name;
  char direction = 'I';  ///< 'I' into the module (or the design), 'O', or 'B' for both
  unsigned width = 1;
  std::string kind;          ///< SIGIS: "clk", "rst", "INTERRUPT"; "" for others
  std::string signal;        ///< the net; "" if unconnected
  std::optional<double> hz;  ///< of a clock
  /// Of a reset: POLARITY says so. It says low of sources that say nothing, too.
  bool active_high = false;
};

/// A bundle of pins.
struct BusInterface {
  std::string name;
  std::string kind;      ///< the name in its VLNV: "aximm", "axis", "gpio"; "" at the design's edge
  bool sends = false;    ///< master or initiator
  bool listens = false;  ///< a monitor
  std::string bus;       ///< what it is joined to; "" if to nothing
  Parameters parameters;
  std::vector<std::pair<std::string, std::string>> pins;  ///< logical name, physical name
};

/// A segment of addresses as one master sees it.
struct Segment {
  std::string master;  ///< interface of the module that holds this
  std::string instance, slave;
  std::uint64_t base = 0, last = 0;
  bool memory = false;  ///< else registers
  /// The parameters of the slave that have its addresses: "C_S00_AXI_BASEADDR"; "": not said.
  std::string base_name = {}, last_name = {};
};

/// A register that the hand-off names.
struct RegisterName {
  struct Field {
    std::string name;
    std::uint32_t low = 0, bits = 1;
  };
  std::string interface, name;
  std::uint32_t offset = 0;
  std::vector<Field> fields = {};
};

/// One IP of the block design.
struct Module {
  std::string instance;   ///< levels of the hierarchy joined with '_'
  std::string full_name;  ///< the same with '/'
  std::string vlnv;       ///< "xilinx.com:ip:axi_dma:7.1"
  std::string type;       ///< of RTL: the module at the top
  std::string revision;   ///< of its packaging; "" in old files
  Parameters parameters;
  std::vector<Port> ports;
  std::vector<BusInterface> interfaces;
  std::vector<Segment> segments;
  std::vector<RegisterName> registers;

  const Port* port(const std::string& name) const;
  const BusInterface* interface(const std::string& name) const;
  /// The name in its VLNV: "axi_dma".
  std::string ip() const;
  /// Whether the vendor wrote it: library `ip` or `inline_hdl` of xilinx.com or amd.com.
  bool is_vendors() const;
};

struct Handoff {
  std::string file;    ///< that it was read from
  std::string name;    ///< of the block design
  std::string tool;    ///< "2020.2"
  std::string date;    ///< as written
  std::string part;    ///< "xc7z020clg400-1"
  std::string device;  ///< "xc7z020-1"
  std::string board;   ///< "" if none was chosen
  std::vector<Port> ports;
  std::vector<BusInterface> interfaces;
  std::vector<Module> modules;     ///< by instance
  std::vector<std::string> notes;  ///< what a reader should know of the file
  std::vector<OwnDriver> drivers;  ///< that an archive holds of own IP

  const Module* module(const std::string& instance) const;
  /// The processing system.
  const Module& ps() const;
};

/// Reads a hand-off. Of an archive with several designs the one called `design`, if it is not
/// empty. Throws vp::InputError with file and line for what is damaged, is for another family, has
/// no processing system, or holds several designs.
Handoff read_handoff(const std::string& file, const std::string& design = {});

/// What is said of a hand-off that is too old.
constexpr const char* in_pieces =
    "lists the processing system in pieces (ps7_…), as Vivado did until 2014: export the hardware "
    "again with a later one";

/// The same for the text of a .hwh.
Handoff read_hwh(std::string text, const std::string& origin);

}  // namespace platform::handoff
