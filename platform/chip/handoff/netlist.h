#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <chip/handoff/handoff.h>

namespace platform::handoff {

/// A pin of a module, or of the block design if `module` is null.
struct Pin {
  const Module* module = nullptr;
  const Port* port = nullptr;
};

/// A bit of a pin.
struct PinBit {
  Pin pin;
  unsigned bit = 0;
};

/// Whether an IP selects, joins or fixes wires: concat, slice and constant, inline ones too.
bool is_concat(const Module& module);
bool is_slice(const Module& module);
bool is_constant(const Module& module);

/// Who drives what in a block design. The hand-off must outlive it.
class Netlist {
 public:
  explicit Netlist(const Handoff& handoff);

  /// What drives the net of a port; none if it is open, or nothing drives it.
  std::optional<Pin> driver(const Port& port) const;
  /// The frequency of the clock at an input, which is its driver's; none if the hand-off has none.
  std::optional<double> clock_hz(const Port& port) const;

  /// One end of a bus.
  struct BusEnd {
    const Module* module;
    const BusInterface* interface;
  };
  /// The master or initiator at the other end of a slave's bus; none if it leaves the design.
  std::optional<BusEnd> sender(const BusInterface& slave) const;

  /// Where bit `bit` of an input comes from, through concats and slices; none if it is open or
  /// constant.
  std::optional<PinBit> origin(const Port& input, unsigned bit) const;

  /// An interrupt of the PL.
  struct Interrupt {
    std::uint32_t id;  ///< at the PS: 61 to 68, 84 to 91; of an axi_intc its input
    PinBit source;
    const Module* controller = nullptr;  ///< the axi_intc that takes it; null: the PS
  };
  /// Those that are wired to the PS, by bit of IRQ_F2P.
  std::vector<Interrupt> interrupts() const;
  /// Those that are wired to each axi_intc of the design, by its input.
  std::vector<Interrupt> interrupts_of_controllers() const;

 private:
  std::optional<PinBit> behind(const PinBit& output, unsigned depth) const;
  std::optional<PinBit> trace(const Port& input, unsigned bit, unsigned depth) const;

  const Handoff& handoff_;
  std::map<std::string, Pin> drivers_;
  std::map<std::string, BusEnd> senders_;
};

}  // namespace platform::handoff
