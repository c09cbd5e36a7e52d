#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <systemc>
#include <vector>

#include <vp/parameter.h>
#include <vp/signal.h>

namespace xilinx {

/// Concat (xlconcat): single wires become one vector, input 0 in bit 0. Combinational.
class Concat : public sc_core::sc_module, private vp::SignalListener {
 public:
  /// `inputs` 1 to 32. Inputs left open read 0.
  Concat(sc_core::sc_module_name name, unsigned inputs);
  const char* kind() const override { return "xilinx::Concat"; }

  /// Input number `i`. Throws std::out_of_range if it does not exist.
  vp::In<bool>& in(unsigned i) { return in_.at(i); }
  /// Connects `line` to input `i`. Throws vp::InputError if there is no such input, or another line
  /// has it.
  void connect(unsigned i, vp::Signal<bool>& line);
  /// For a concat that drives IRQ_F2P: connects `line` so that it is interrupt `id`, 61 to 68 or 84
  /// to 91. That is a property beside the line, `<line>_id`, with `id` as its default. Adds inputs
  /// as needed. Throws vp::InputError for another number, or one that another line has.
  void connect_interrupt(vp::Signal<bool>& line, std::uint32_t id);

  /// As wide as there are inputs.
  class Vector final : public vp::Signal<std::uint32_t> {
   public:
    explicit Vector(const Concat& concat) : Signal("dout"), concat_(concat) {}
    using Signal::operator=;
    unsigned width() const override { return static_cast<unsigned>(concat_.in_.size()); }

   private:
    const Concat& concat_;
  };
  Vector dout{*this};

 private:
  void end_of_elaboration() override;
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  void grow(unsigned inputs);

  std::deque<vp::In<bool>> in_;
  std::vector<std::unique_ptr<vp::Parameter<std::uint32_t>>> ids_;
};

}  // namespace xilinx
