#include <chip/handoff/netlist.h>

#include <gic_registers.h>
#include <vp/error.h>
#include <vp/unit.h>

namespace platform::handoff {

namespace {

constexpr unsigned deepest_wiring = 64;  ///< concats behind each other; more is a ring

unsigned number(const Module& module, const std::string& name) {
  const auto value = vp::Decimal::parse(parameter(module.parameters, name));
  const auto whole = value ? value->whole() : std::nullopt;
  return whole && *whole >= 0 && *whole < 65536 ? static_cast<unsigned>(*whole) : 0;
}

}  // namespace

bool is_concat(const Module& module) {
  return module.ip() == "xlconcat" || module.ip() == "ilconcat";
}

bool is_slice(const Module& module) {
  return module.ip() == "xlslice" || module.ip() == "ilslice";
}

bool is_constant(const Module& module) {
  return module.ip() == "xlconstant" || module.ip() == "ilconstant";
}

Netlist::Netlist(const Handoff& handoff) : handoff_(handoff) {
  const auto drive = [this](const Port& port, const Module* module) {
    if (!port.signal.empty()) drivers_.emplace(port.signal, Pin{module, &port});
  };
  for (const Module& module : handoff.modules) {
    for (const Port& port : module.ports)
      if (port.direction == 'O') drive(port, &module);
    for (const BusInterface& bus : module.interfaces)
      if (bus.sends && !bus.bus.empty()) senders_.emplace(bus.bus, BusEnd{&module, &bus});
  }
  for (const Port& port : handoff.ports)
    if (port.direction == 'I') drive(port, nullptr);
}

std::optional<Pin> Netlist::driver(const Port& port) const {
  const auto found = drivers_.find(port.signal);
  if (port.signal.empty() || found == drivers_.end()) return std::nullopt;
  return found->second;
}

std::optional<double> Netlist::clock_hz(const Port& port) const {
  const std::optional<Pin> source = driver(port);
  return source ? source->port->hz : std::nullopt;
}

std::optional<Netlist::BusEnd> Netlist::sender(const BusInterface& slave) const {
  const auto found = senders_.find(slave.bus);
  if (slave.bus.empty() || found == senders_.end()) return std::nullopt;
  return found->second;
}

std::optional<PinBit> Netlist::origin(const Port& input, unsigned bit) const {
  return trace(input, bit, 0);
}

std::optional<PinBit> Netlist::trace(const Port& input, unsigned bit, unsigned depth) const {
  const std::optional<Pin> source = driver(input);
  if (!source || bit >= source->port->width) return std::nullopt;
  return behind({*source, bit}, depth);
}

// An open input of a concat takes its bits all the same.
std::optional<PinBit> Netlist::behind(const PinBit& output, unsigned depth) const {
  const Module* module = output.pin.module;
  if (!module) return output;
  if (depth > deepest_wiring)
    throw vp::InputError("the wires at " + module->instance + " run in a ring");
  if (is_constant(*module)) return std::nullopt;
  if (is_slice(*module)) {
    const Port* in = module->port("Din");
    return in ? trace(*in, output.bit + number(*module, "DIN_TO"), depth + 1) : std::nullopt;
  }
  if (!is_concat(*module)) return output;
  unsigned first = 0;
  for (unsigned i = 0;; ++i) {
    const Port* in = module->port("In" + std::to_string(i));
    if (!in) return std::nullopt;
    if (output.bit < first + in->width) return trace(*in, output.bit - first, depth + 1);
    first += in->width;
  }
}

std::vector<Netlist::Interrupt> Netlist::interrupts() const {
  std::vector<Interrupt> result;
  const Port* lines = handoff_.ps().port("IRQ_F2P");
  if (!lines) return result;
  for (unsigned bit = 0; bit < lines->width && bit < gic::irq_f2p_bits; ++bit) {
    const std::optional<PinBit> source = origin(*lines, bit);
    if (source) result.push_back({gic::irq_f2p_id(bit), *source});
  }
  return result;
}

std::vector<Netlist::Interrupt> Netlist::interrupts_of_controllers() const {
  std::vector<Interrupt> result;
  for (const Module& module : handoff_.modules) {
    const Port* lines =
        module.is_vendors() && module.ip() == "axi_intc" ? module.port("intr") : nullptr;
    if (!lines) continue;
    for (unsigned bit = 0; bit < lines->width; ++bit) {
      const std::optional<PinBit> source = origin(*lines, bit);
      if (source) result.push_back({bit, *source, &module});
    }
  }
  return result;
}

}  // namespace platform::handoff
