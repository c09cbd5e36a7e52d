#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <systemc>
#include <vector>

#include <chip/block_design/design_file.h>
#include <chip/block_design/own_ip.h>
#include <chip/block_design/shelf.h>
#include <chip/system/design.h>
#include <tlm_utils/simple_initiator_socket.h>
#include <vp/axi_stream.h>
#include <vp/clock.h>
#include <vp/mm_link.h>
#include <vp/router.h>
#include <vp/signal.h>
#include <xilinx/axi_dma/memory_port.h>

namespace xilinx {
class AxiBramCtrl;
class AxiUartlite;
class BlkMemGen;
}  // namespace xilinx

namespace platform::block_design {

using RegionSocket = tlm_utils::simple_initiator_socket<vp::MmLink>;

/// A master of the PL, as buses see it.
struct MasterPort {
  std::function<void(vp::Router& way)> bind;
  /// Shares the way with other masters; may be null.
  std::function<void(xilinx::MemoryPath& path)> share = nullptr;
};

/// A slave.
struct SlavePort {
  std::function<void(RegionSocket& socket)> bind;
  /// It sees the addresses of its master, not offsets: a port of the PS.
  bool absolute = false;
};

/// One end of a stream, and the clock that it belongs to.
struct StreamPort {
  std::function<void(vp::AxiStream& link, vp::Clock& clock)> bind;
  vp::Clock* clock = nullptr;  ///< null: that of the other end
  unsigned bytes = 0;          ///< of a beat; 0: as the other end
};

/// A part in its place: its pins and buses by the vendor's names.
struct Placed {
  std::unique_ptr<sc_core::sc_module> object;  ///< what it is; null: nothing, or the PS
  std::vector<std::unique_ptr<sc_core::sc_module>> made = {};  ///< clocks that it makes
  std::map<std::string, vp::SignalBase*> outputs = {};
  std::map<std::string, vp::Clock*> clocks = {};  ///< outputs that are clocks
  std::map<std::string, std::function<void(vp::SignalBase& source)>> inputs = {};
  std::set<std::string> unused_inputs = {};   ///< that change nothing; and clocks
  xilinx::AxiUartlite* serial = nullptr;      ///< whose pins rx and tx carry characters, not levels
  xilinx::AxiBramCtrl* controller = nullptr;  ///< of block memory
  xilinx::BlkMemGen* memory = nullptr;        ///< block memory, which controllers may have
  std::map<std::string, MasterPort> masters = {};
  std::map<std::string, SlavePort> slaves = {};
  std::map<std::string, StreamPort> stream_masters = {}, stream_slaves = {};
  /// Called for each input, and for each slave, that the design leaves open; may be null.
  std::function<void(const std::string& pin)> open_input = nullptr;
  std::function<void(const std::string& interface)> open_slave = nullptr;
  /// Makes an output, or a slave, that the rest of the design asks for by name: of a stub. Null:
  /// only those above exist.
  std::function<vp::SignalBase*(const std::string& pin)> any_output = nullptr;
  std::function<SlavePort(const std::string& interface)> any_slave = nullptr;
  std::function<StreamPort(const std::string&interface)> any_stream_master = nullptr,
                                                         any_stream_slave = nullptr;
};

/// What a part is placed with.
struct Placement {
  const PlacedPart& part;
  PlPorts& ports;
  const DesignFile& design;
  /// The clock at a pin of this part; null if the pin is open.
  std::function<vp::Clock*(const std::string& pin)> clock_at;
  /// The same of any pin that drives something.
  std::function<vp::Clock*(const End& source)> clock_of;
  /// Holds what is made for its pins as long as the design.
  std::vector<std::unique_ptr<sc_core::sc_module>>& adapters;

  /// The value of a parameter: the design's, or the usual one.
  std::string text(const std::string& name) const;
  /// The same as a number. Throws vp::InputError with file and line.
  std::uint64_t number(const std::string& name) const;
  bool flag(const std::string& name) const { return number(name) != 0; }
  /// The clock at the first of these pins that is driven. Throws vp::InputError if none is, or if
  /// two of them have different clocks.
  vp::Clock& clock(const std::vector<std::string>& pins) const;
  [[noreturn]] void refuse(const std::string& problem) const;
};

/// What the maker of an own IP is shown of the design around it, once all is wired.
struct Surroundings {
  const PlacedPart& part;
  PlPorts& ports;
  const DesignFile& design;
  /// A part by its name in the design.
  std::function<const Placed&(const std::string& name)> placed;
  /// The clock at a pin of the own IP; null if the pin is open.
  std::function<vp::Clock*(const std::string& pin)> clock_at;

  [[noreturn]] void refuse(const std::string& problem) const;
};

/// Makes the part: a model, wiring, the user's RTL, or a stub in its place.
Placed place_part(const Placement& placement);

/// The user's RTL, Verilated.
Placed place_rtl(const Placement& placement);

}  // namespace platform::block_design
