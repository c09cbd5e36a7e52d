#include <xilinx/wiring/wiring.h>

#include <vp/error.h>

#include <string>
#include <utility>

namespace xilinx {

namespace {

constexpr unsigned widest = 64;

std::uint64_t ones(unsigned width) {
  return width >= widest ? ~std::uint64_t{0} : (std::uint64_t{1} << width) - 1;
}

unsigned checked(const char* name, unsigned width) {
  if (width >= 1 && width <= widest) return width;
  throw vp::InputError(std::string(name) + " is " + std::to_string(width) +
                       " bits wide: wires of 1 to 64 bits are modelled");
}

}  // namespace

Wiring::Wiring(sc_core::sc_module_name name, const char* output, unsigned width, std::size_t inputs,
               Function function, Trace trace)
    : sc_module(name),
      out(output, width),
      function_(std::move(function)),
      trace_(std::move(trace)),
      inputs_(inputs, nullptr),
      values_(inputs, 0) {}

void Wiring::connect(std::size_t input, vp::SignalBase& source) {
  if (inputs_.at(input)) {
    throw vp::InputError(std::string(name()) + ": " + source.name() + " and " +
                         inputs_[input]->name() + " both drive its input " + std::to_string(input));
  }
  inputs_[input] = &source;
  source.defer_writes();
  source.attach(*this);
}

std::uint64_t Wiring::mask() const {
  return ones(out.width());
}

// A change that comes back to where it began would never end.
void Wiring::update() {
  if (updating_) {
    throw vp::InputError(std::string(name()) +
                         ": its output leads back to its own input: break the ring of wires");
  }
  updating_ = true;
  for (std::size_t i = 0; i < inputs_.size(); ++i) {
    if (inputs_[i]) values_[i] = inputs_[i]->bits() & ones(inputs_[i]->width());
  }
  out = function_(values_) & mask();
  updating_ = false;
}

BitOrigin Wiring::origin(const vp::SignalBase& signal, unsigned bit) {
  const vp::SignalBase* at = &signal;
  while (bit < at->width()) {
    const sc_core::sc_object* parent = at->get_parent_object();
    if (const auto* adapter = dynamic_cast<const WireAdapterBase*>(parent)) {
      at = &adapter->source();
      continue;
    }
    const auto* wiring = dynamic_cast<const Wiring*>(parent);
    if (!wiring || !wiring->trace_) return {at, bit};
    const Source source = wiring->trace_(bit);
    if (source.input >= wiring->inputs_.size() || !wiring->inputs_[source.input]) return {};
    at = wiring->inputs_[source.input];
    bit = source.source_bit;
  }
  return {};
}

std::unique_ptr<Wiring> make_concat(const char* name, const std::vector<unsigned>& widths) {
  unsigned width = 0;
  for (const unsigned one : widths) width += one;
  checked(name, width);
  const auto join = [widths](const std::vector<std::uint64_t>& inputs) {
    std::uint64_t word = 0;
    unsigned at = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      word |= (inputs[i] & ones(widths[i])) << at;
      at += widths[i];
    }
    return word;
  };
  const auto trace = [widths](unsigned bit) {
    std::size_t input = 0;
    while (input < widths.size() && bit >= widths[input]) bit -= widths[input++];
    return Wiring::Source{input, bit};
  };
  return std::make_unique<Wiring>(name, "dout", width, widths.size(), join, trace);
}

std::unique_ptr<Wiring> make_slice(const char* name, unsigned from, unsigned to) {
  if (from < to || from >= widest) {
    throw vp::InputError(std::string(name) + " takes bits " + std::to_string(from) + " to " +
                         std::to_string(to) + ": DIN_FROM is the upper one, at most 63");
  }
  return std::make_unique<Wiring>(
      name, "Dout", from - to + 1, 1,
      [to](const std::vector<std::uint64_t>& in) { return in[0] >> to; },
      [to](unsigned bit) {
        return Wiring::Source{0, bit + to};
      });
}

std::unique_ptr<Wiring> make_constant(const char* name, unsigned width, std::uint64_t value) {
  return std::make_unique<Wiring>(
      name, "dout", checked(name, width), 0,
      [value](const std::vector<std::uint64_t>&) { return value; },
      [](unsigned) {
        return Wiring::Source{0, 0};
      });
}

std::unique_ptr<Wiring> make_gates(const char* name, const std::string& operation, unsigned width) {
  using Inputs = std::vector<std::uint64_t>;
  Wiring::Function gate;
  if (operation == "not") {
    gate = [](const Inputs& in) { return ~in[0]; };
  } else if (operation == "and") {
    gate = [](const Inputs& in) { return in[0] & in[1]; };
  } else if (operation == "or") {
    gate = [](const Inputs& in) { return in[0] | in[1]; };
  } else {
    gate = [](const Inputs& in) { return in[0] ^ in[1]; };
  }
  return std::make_unique<Wiring>(name, "Res", checked(name, width), operation == "not" ? 1 : 2,
                                  gate);
}

std::unique_ptr<Wiring> make_reduction(const char* name, const std::string& operation,
                                       unsigned width) {
  const std::uint64_t all = ones(checked(name, width));
  return std::make_unique<Wiring>(
      name, "Res", 1, 1, [operation, all](const std::vector<std::uint64_t>& in) -> std::uint64_t {
        const std::uint64_t bits = in[0] & all;
        if (operation == "and") return bits == all ? 1 : 0;
        if (operation == "or") return bits != 0 ? 1 : 0;
        return static_cast<std::uint64_t>(__builtin_parityll(bits));
      });
}

}  // namespace xilinx
