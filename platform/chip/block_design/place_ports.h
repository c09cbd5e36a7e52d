#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include <chip/block_design/place.h>
#include <vp/register_bank.h>
#include <xilinx/axi_dma/memory_port.h>
#include <xilinx/axi_interconnect/axi_interconnect.h>
#include <xilinx/wiring/wiring.h>

/// How ports of models become those of a placed part.
namespace platform::block_design {

/// Binds a port of a model by the name that it has in the design.
template <class T>
std::function<void(vp::SignalBase&)> input(const Placement& at, const std::string& pin,
                                           vp::In<T>& port, bool inverted = false) {
  const std::string name = at.part.name + "_" + pin;
  return [&port, name, inverted, &adapters = at.adapters](vp::SignalBase& source) {
    auto* same = dynamic_cast<vp::Signal<T>*>(&source);
    if (same && !inverted) return port(*same);
    auto adapter = std::make_unique<xilinx::WireAdapter<T>>(name.c_str(), source, inverted);
    port(adapter->out);
    adapters.push_back(std::move(adapter));
  };
}

/// An output of a model, or its inverse.
inline vp::SignalBase* output(const Placement& at, const std::string& pin, vp::Signal<bool>& signal,
                              bool inverted) {
  if (!inverted) return &signal;
  const std::string name = at.part.name + "_" + pin;
  auto adapter = std::make_unique<xilinx::WireAdapter<bool>>(name.c_str(), signal, true);
  vp::SignalBase* out = &adapter->out;
  at.adapters.push_back(std::move(adapter));
  return out;
}

/// A parameter that is a number of at most 32 bits.
inline std::uint32_t word(const Placement& at, const std::string& name) {
  return static_cast<std::uint32_t>(at.number(name));
}

/// The registers of a model as a slave.
inline SlavePort registers(vp::RegisterBank& bank) {
  return {[&bank](RegionSocket& socket) { socket.bind(bank.socket); }};
}

/// Binds what belongs to one memory master. An interconnect is larger with each of them.
template <class... Ports>
void bind_master(vp::Router& way, Ports&... ports) {
  auto* interconnect = dynamic_cast<xilinx::AxiInterconnect*>(&way);
  if (interconnect) return interconnect->connect(ports...);
  (ports.link.socket.bind(way.socket), ...);
}

/// A memory master of a model.
inline MasterPort memory_master(xilinx::MemoryPort& port) {
  return {[&port](vp::Router& way) { bind_master(way, port); },
          [&port](xilinx::MemoryPath& path) { port.share(path); }};
}

/// What places an IP that has registers and little else; null for any other IP.
using Placer = Placed (*)(const Placement& at);
Placer peripheral_placer(const std::string& ip);
/// The same of IP of streams, which depends on its parameters, and of IP of video.
Placer stream_placer(const Placement& at);
Placer video_placer(const std::string& ip);

/// Block memory, and the controller of one.
Placed place_block_memory(const Placement& at);
Placed place_bram_ctrl(const Placement& at);
/// The BRAM controllers at the ports of a block memory, one for each port that has one.
std::vector<const PlacedPart*> controllers_of(const DesignFile& design, const PlacedPart& memory);

/// The UART Lite whose `tx` drives the `rx` of this one; null: none does.
const PlacedPart* serial_driver(const DesignFile& design, const PlacedPart& part);

/// A clock manager of the fabric: with registers, or without.
Placed place_clock_manager(const Placement& at);

}  // namespace platform::block_design
