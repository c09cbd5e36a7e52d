#include <xilinx/concat/concat.h>

#include <vp/error.h>
#include <stdexcept>
#include <string>

namespace xilinx {

namespace {

constexpr unsigned widest = 32;

}  // namespace

Concat::Concat(sc_core::sc_module_name name, unsigned inputs)
    : sc_module(name), dout("dout", inputs) {
  if (inputs < 1 || inputs > widest) {
    throw std::logic_error(std::string(this->name()) + ": " + std::to_string(inputs) +
                           " inputs, 1 to 32 are possible");
  }
  for (unsigned i = 0; i < inputs; ++i) in_.emplace_back(("in" + std::to_string(i)).c_str());
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

void Concat::end_of_elaboration() {
  std::uint32_t vector = 0;
  for (unsigned i = 0; i < in_.size(); ++i) {
    if (!in_[i].bound()) continue;
    in_[i].signal()->attach(*this, i);
    vector |= std::uint32_t{in_[i].read()} << i;
  }
  dout = vector;
}

void Concat::on_change(vp::SignalBase&, std::uint32_t i) {
  const std::uint32_t bit = 1u << i;
  dout = in_[i].read() ? dout | bit : dout & ~bit;
}

}  // namespace xilinx
