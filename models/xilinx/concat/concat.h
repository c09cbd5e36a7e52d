#pragma once

#include <cstdint>
#include <deque>
#include <systemc>

#include <vp/signal.h>

namespace xilinx {

/// Concat (xlconcat): single wires become one vector, input 0 in bit 0. Combinational.
class Concat : public sc_core::sc_module, private vp::SignalListener {
 public:
  /// `inputs` 1 to 32. Inputs left open read 0.
  Concat(sc_core::sc_module_name name, unsigned inputs);
  const char* kind() const override { return "xilinx::Concat"; }

  /// Input number `i`. Throws std::out_of_range if there is none.
  vp::In<bool>& in(unsigned i) { return in_.at(i); }
  /// Connects `line` to input `i`. Throws vp::InputError if there is no such input, or another line
  /// has it.
  void connect(unsigned i, vp::Signal<bool>& line);
  vp::Signal<std::uint32_t> dout;

 private:
  void end_of_elaboration() override;
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;

  std::deque<vp::In<bool>> in_;
};

}  // namespace xilinx
