// A design with the mistake that MISTAKE names.
#include <chip/system/design_plugin.h>
#include <marker/designs/marker/marker_design.h>

#include <vp/clock.h>
#include <vp/systemc_pins.h>

namespace {

enum Mistake {
  ADDRESS_TWICE,
  COMBINATIONAL_RING,
  INTERRUPT_TWICE,
  MISSING_PROGRAM,
  NO_PROGRAM,
  NOTHING_MADE,
  OTHER_VERSION,
  PART_OUTSIDE,
  UNBOUND_PORT
};

/// Has an input that the design forgets.
class Part : public vp::Clocked {
 public:
  Part(sc_core::sc_module_name name, vp::Clock& clk) : Clocked(name, clk) {}
  vp::In<bool> enable{"enable", this};

 private:
  void edge() override { sleep(); }
};

/// Knows only SystemC: out = !in, at once.
struct Inverter : sc_core::sc_module {
  SC_HAS_PROCESS(Inverter);
  explicit Inverter(sc_core::sc_module_name name) : sc_module(name) {
    SC_METHOD(drive);
    sensitive << in;
  }
  void drive() { out.write(!in.read()); }
  sc_core::sc_in<bool> in{"in"};
  sc_core::sc_out<bool> out{"out"};
};

/// The inverter's output comes back to it as one of our signals.
struct Ring {
  Ring() {
    inverter.out(wire);
    inverter.in(back.signal);
  }
  sc_core::sc_signal<bool> wire{"wire"};
  vp::Follower<bool, bool> back{"back", wire};
  Inverter inverter{"inverter"};
};

/// Is a part, and made where `pl` is complete already.
class Outside : public platform::MarkerDesign {
 public:
  Outside(const char* name, platform::PlPorts& ports)
      : MarkerDesign(name, ports), memory_("memory", 16) {}

 private:
  xilinx::Bram memory_;
};

class Mistaken : public platform::MarkerDesign {
 public:
  Mistaken(sc_core::sc_module_name name, platform::PlPorts& ports) : MarkerDesign(name, ports) {
    if (MISTAKE == ADDRESS_TWICE) axi_interconnect.map("second", 0x4120'0000, 0x1'0000);
    if (MISTAKE == INTERRUPT_TWICE) concat.connect_interrupt(line_, 62);
    if (MISTAKE == COMBINATIONAL_RING) ring_ = std::make_unique<Ring>();
    if (MISTAKE == UNBOUND_PORT) part_ = std::make_unique<Part>("part", ports.fclk_clk(0));
  }

 private:
  vp::Signal<bool> line_{"line"};
  std::unique_ptr<Part> part_;
  std::unique_ptr<Ring> ring_;
};

const platform::DesignInfo& info() {
  static platform::DesignInfo info{
      "mistaken",
      "has a mistake",
      {"hybrid"},
      true,
      platform::no_words,
      [](const char* name, platform::PlPorts& ports) -> std::unique_ptr<platform::Design> {
        if (MISTAKE == PART_OUTSIDE) return std::make_unique<Outside>(name, ports);
        return std::make_unique<Mistaken>(name, ports);
      }};
  if (MISTAKE == MISSING_PROGRAM) info.programs = {"absent"};
  if (MISTAKE == NO_PROGRAM) info.programs.clear();
  if (MISTAKE == NOTHING_MADE) info.make = nullptr;
  return info;
}

}  // namespace

extern "C" __attribute__((visibility("default")))
const platform::DesignDescriptor markervp_design = {
    platform::design_abi, MISTAKE == OTHER_VERSION ? "0.0.9" : MARKERVP_VERSION, __VERSION__, info};
