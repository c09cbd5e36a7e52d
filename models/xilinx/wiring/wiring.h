#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <systemc>
#include <vector>

#include <vp/signal.h>

namespace xilinx {

/// Where a bit comes from: a signal that is not a function of others, and its bit there.
struct BitOrigin {
  const vp::SignalBase* signal = nullptr;  ///< null: the bit is constant, or its input is open
  unsigned bit = 0;
};

/// Logic without a clock: one output of up to 64 bits, which follows its inputs at once.
///
/// Concat, slice, constant and gates are made of it (wiring_parts.h). Inputs left open read 0.
class Wiring : public sc_core::sc_module, private vp::SignalListener {
 public:
  using Function = std::function<std::uint64_t(const std::vector<std::uint64_t>& inputs)>;
  /// Bit `bit` of the output is bit `source_bit` of input `input`; `input` beyond the inputs: it
  /// comes from none.
  struct Source {
    std::size_t input;
    unsigned source_bit;
  };
  using Trace = std::function<Source(unsigned bit)>;

  /// `output`: the name of the output. `trace` null: no output bit is an input bit.
  Wiring(sc_core::sc_module_name name, const char* output, unsigned width, std::size_t inputs,
         Function function, Trace trace = nullptr);
  const char* kind() const override { return "xilinx::Wiring"; }

  std::size_t inputs() const { return inputs_.size(); }
  /// Joins `source` to an input; before the simulation. Throws vp::InputError for a second one.
  void connect(std::size_t input, vp::SignalBase& source);
  const vp::SignalBase* input(std::size_t number) const { return inputs_.at(number); }

  vp::Signal<std::uint64_t> out;

  /// Where a bit of a signal comes from, through wiring.
  static BitOrigin origin(const vp::SignalBase& signal, unsigned bit);

 private:
  void end_of_elaboration() override { update(); }
  void on_change(vp::SignalBase&, std::uint32_t) override { update(); }
  void update();
  std::uint64_t mask() const;

  Function function_;
  Trace trace_;
  std::vector<vp::SignalBase*> inputs_;
  std::vector<std::uint64_t> values_;
  bool updating_ = false;
};

/// What an adapter is, whatever the type of its output.
class WireAdapterBase : public sc_core::sc_module, protected vp::SignalListener {
 public:
  const char* kind() const override { return "xilinx::WireAdapter"; }
  const vp::SignalBase& source() const { return source_; }

 protected:
  WireAdapterBase(sc_core::sc_module_name name, vp::SignalBase& source)
      : sc_module(name), source_(source) {
    source.defer_writes();
    source.attach(*this);
  }

  vp::SignalBase& source_;
};

/// A signal of another type that follows `source`, or its inverse: for inputs of one bit, or of a
/// word.
template <class T>
class WireAdapter : public WireAdapterBase {
 public:
  WireAdapter(sc_core::sc_module_name name, vp::SignalBase& source, bool inverted = false)
      : WireAdapterBase(name, source), inverted_(inverted) {}

  vp::Signal<T> out{"out"};

 private:
  void end_of_elaboration() override { follow(); }
  void on_change(vp::SignalBase&, std::uint32_t) override { follow(); }
  void follow() {
    const std::uint64_t bits = inverted_ ? ~source_.bits() : source_.bits();
    out = std::is_same_v<T, bool> ? static_cast<T>((bits & 1) != 0) : static_cast<T>(bits);
  }

  bool inverted_;
};

/// A concat (xlconcat): `widths` of its inputs, the first in the lowest bits. Throws vp::InputError
/// for more than 64 bits in all.
std::unique_ptr<Wiring> make_concat(const char* name, const std::vector<unsigned>& widths);
/// A slice (xlslice): bits `to` to `from` of an input.
std::unique_ptr<Wiring> make_slice(const char* name, unsigned from, unsigned to);
/// A constant (xlconstant).
std::unique_ptr<Wiring> make_constant(const char* name, unsigned width, std::uint64_t value);
/// Gates of two inputs, or inverters, bit by bit (util_vector_logic): "and", "or", "xor", "not".
std::unique_ptr<Wiring> make_gates(const char* name, const std::string& operation, unsigned width);
/// One gate of all bits of an input (util_reduced_logic): "and", "or", "xor".
std::unique_ptr<Wiring> make_reduction(const char* name, const std::string& operation,
                                       unsigned width);

}  // namespace xilinx
