#include <xilinx/concat/concat.h>

#include <gic_registers.h>
#include <vp/error.h>
#include <vp/ip.h>
#include <stdexcept>
#include <string>

namespace xilinx {

namespace {

constexpr unsigned widest = 32;

}  // namespace

Concat::Concat(sc_core::sc_module_name name, unsigned inputs) : sc_module(name) {
  if (inputs < 1 || inputs > widest) {
    throw std::logic_error(std::string(this->name()) + ": " + std::to_string(inputs) +
                           " inputs, 1 to 32 are possible");
  }
  grow(inputs);
}

void Concat::grow(unsigned inputs) {
  while (in_.size() < inputs) in_.emplace_back(("in" + std::to_string(in_.size())).c_str());
}

void Concat::connect(unsigned i, vp::Signal<bool>& line) {
  const std::string input = std::string(name()) + ".in" + std::to_string(i);
  if (i >= in_.size()) {
    throw vp::InputError(std::string(line.name()) + " cannot be connected to " + input +
                         ": there are inputs 0 to " + std::to_string(in_.size() - 1) +
                         "; build it with more");
  }
  const vp::SignalBase* other = in_[i].signal();
  if (other && other != &line) {
    throw vp::InputError(std::string(line.name()) + " and " + other->name() +
                         " are both connected to " + input + ": give one of them another number");
  }
  in_[i](line);
}

void Concat::connect_interrupt(vp::Signal<bool>& line, std::uint32_t id) {
  const vp::HierarchyScope scope(dynamic_cast<sc_core::sc_module&>(*line.get_parent_object()));
  const auto& chosen = *ids_.emplace_back(std::make_unique<vp::Parameter<std::uint32_t>>(
      (std::string(line.basename()) + "_id").c_str(), id, vp::Unit::none, vp::Source::decision,
      "interrupt at the PS: 61 to 68 or 84 to 91 (IRQ_F2P)"));
  const unsigned bit = gic::irq_f2p_bit(chosen);
  const std::string setting = std::string(chosen.name()) + " is " + chosen.text();
  constexpr const char* numbers = "61 to 68 or 84 to 91";
  if (bit == gic::irq_f2p_bits) {
    throw vp::InputError(setting + ": interrupts of the PL are " + numbers);
  }
  grow(bit + 1);
  if (const vp::SignalBase* other = in_[bit].signal()) {
    throw vp::InputError(setting + ", which is the interrupt of " + other->name() +
                         ": give one of them another, " + numbers);
  }
  in_[bit](line);
}

void Concat::end_of_elaboration() {
  std::uint32_t vector = 0;
  for (unsigned i = 0; i < in_.size(); ++i) {
    if (!in_[i].bound()) continue;
    in_[i].signal()->attach(*this, i);
    vector |= std::uint32_t{in_[i].read()} << i;
  }
  dout = vector;
}

void Concat::on_change(vp::SignalBase& line, std::uint32_t i) {
  const std::uint32_t bit = 1u << i;
  dout = line.bits() != 0 ? dout | bit : dout & ~bit;
}

}  // namespace xilinx
