#include <axi/interfaces.h>
#include <axi/rtl_part.h>
#include <chip/block_design/place.h>
#include <chip/block_design/place_ports.h>
#include <strings.h>
#include <vp/error.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <utility>

// The user's RTL as a part: its interfaces under the names that the design has for them.
namespace platform::block_design {

namespace {

/// Vivado writes S00_AXI for the ports s00_axi_…; HLS keeps the case.
bool same(const std::string& a, const std::string& b) {
  return ::strcasecmp(a.c_str(), b.c_str()) == 0;
}

/// The name that the design has for an interface: of a bus or pin that it joins, else the RTL's
/// own.
std::string name_in_design(const Placement& at, const std::string& name) {
  for (const auto& [bus, master] : at.part.buses)
    if (same(bus, name)) return bus;
  for (const PlacedPart& other : at.design.parts) {
    for (const auto& [bus, master] : other.buses)
      if (master.part == at.part.name && same(master.port, name)) return master.port;
  }
  return name;
}

MasterPort master_of(axi::RtlPart& part, const std::string& name) {
  return {[&part, name](vp::Router& way) {
            auto& master = part.master(name);
            bind_master(way, master.read, master.write);
          },
          [&part, name](xilinx::MemoryPath& path) {
            part.master(name).read.share(path);
            part.master(name).write.share(path);
          }};
}

void offer(const Placement& at, axi::RtlPart& part, const axi::Interface& interface,
           vp::Clock* clock, Placed& placed) {
  const std::string name = interface.name, known = name_in_design(at, name);
  switch (interface.kind) {
    case axi::Kind::axi4:
    case axi::Kind::axi_lite:
      if (interface.slave) {
        placed.slaves[known] = {
            [&part, name](RegionSocket& socket) { socket.bind(part.slave(name).socket); }};
      } else {
        placed.masters[known] = master_of(part, name);
      }
      return;
    case axi::Kind::axi_stream:
      if (interface.slave) {
        placed.stream_slaves[known] = {
            [&part, name](vp::AxiStream& link, vp::Clock&) { part.stream_in(name)(link); }, clock,
            part.stream_bytes(name)};
      } else {
        placed.stream_masters[known] = {
            [&part, name](vp::AxiStream& link, vp::Clock&) { part.stream_out(name, 0)(link); },
            clock, part.stream_bytes(name)};
      }
      return;
    case axi::Kind::clock:
      placed.unused_inputs.insert(name);
      return;
    case axi::Kind::interrupt:
    case axi::Kind::reset:
    case axi::Kind::wire:
      break;
  }
  if (interface.slave) {
    placed.inputs[name] = [&part, name](vp::SignalBase& source) { part.input(name, source); };
  } else {
    placed.outputs[name] = &part.output<std::uint64_t>(name);
  }
}

/// A clock that RTL makes.
class MadeClock : public sc_core::sc_module {
 public:
  MadeClock(sc_core::sc_module_name name, vp::ClockScheduler& scheduler, std::uint64_t hertz)
      : sc_module(name), clk("clk", scheduler, hertz) {}
  const char* kind() const override { return "MadeClock"; }
  vp::Clock clk;
};

/// What the design says of clocks that the RTL makes. One that is as fast as a clock of its own is
/// that clock, passed on (assumed).
void make_clocks(const Placement& at, const axi::RtlPart& part, const axi::RtlPart::ClockPins& own,
                 Placed& placed) {
  for (const auto& [pin, hertz] : at.part.clocks) {
    const auto& all = part.interfaces();
    const bool is_output =
        std::any_of(all.begin(), all.end(), [name = pin](const axi::Interface& one) {
          return one.name == name && !one.slave && one.ports.size() == 1;
        });
    if (!is_output) at.refuse("'clocks' names '" + pin + "', which is no output of its RTL");
    for (const auto& [name, clock] : own)
      if (clock->frequency_hz() == hertz) placed.clocks[pin] = clock;
    if (placed.clocks.count(pin) != 0) continue;
    auto made =
        std::make_unique<MadeClock>((at.part.name + "_" + pin).c_str(), at.ports.scheduler, hertz);
    placed.clocks[pin] = &made->clk;
    placed.made.push_back(std::move(made));  // what it clocks goes first
  }
}

}  // namespace

Placed place_rtl(const Placement& at) {
  namespace fs = std::filesystem;
  const std::string file = (fs::path(at.design.file).parent_path() / at.part.rtl).string();
  axi::RtlPart::ClockPins clocks;
  for (const auto& [pin, source] : at.part.pins) {
    if (vp::Clock* clock = at.clock_at(pin)) clocks.emplace_back(pin, clock);
  }
  // Logic without a clock has reports, too; what has one refuses this.
  if (clocks.empty()) clocks.emplace_back("", &at.ports.fclk_clk(0));
  std::error_code ignored;
  if (!fs::exists(file, ignored))
    at.refuse("its RTL '" + file +
              "' is missing: build the folder of the design, or write 'as: stub'");
  auto part = std::make_unique<axi::RtlPart>(at.part.name.c_str(), file, clocks);
  Placed placed;
  std::map<std::string, std::string> names;  // in the RTL, by those in the design
  for (const axi::Interface& interface : part->interfaces()) {
    offer(at, *part, interface, at.clock_at(interface.clock), placed);
    names[name_in_design(at, interface.name)] = interface.name;
  }
  make_clocks(at, *part, clocks, placed);
  axi::RtlPart* rtl = part.get();
  // A reset that is left open is not active.
  placed.open_input = [rtl](const std::string& pin) {
    const auto& all = rtl->interfaces();
    const bool high = std::any_of(all.begin(), all.end(), [&](const axi::Interface& one) {
      return one.name == pin && one.kind == axi::Kind::reset && one.active_low;
    });
    rtl->tie(pin, high ? 1 : 0);
  };
  placed.open_slave = [rtl, names = std::move(names)](const std::string& interface) {
    rtl->leave_open(names.at(interface));
  };
  placed.object = std::move(part);
  return placed;
}

}  // namespace platform::block_design
