#include <pl/common/rtl_pins.h>

#include <algorithm>

#include <vp/clock_scheduler.h>
#include <vp/error.h>
#include <vp/report.h>

namespace pl {

namespace {

std::string direction(bool output) {
  return output ? "output" : "input";
}

std::string declaration(const std::string& name, unsigned bits, bool output) {
  const std::string range = bits == 1 ? "" : "[" + std::to_string(bits - 1) + ":0] ";
  return "'" + direction(output) + " logic " + range + name + "'";
}

}  // namespace

void add_stream(IpPorts& ports, vp::AxiStreamMaster& m) {
  ports.input(m.tready);
  const auto valid = [&m] { return m.tvalid.get(); };
  using Word = std::uint32_t;
  using Lanes = std::uint8_t;
  ports.output<Word>(
      "m_tdata", 32, [&m]() -> auto& { return m.link().tdata; }, valid);
  ports.output<Lanes>(
      "m_tkeep", 4, [&m]() -> auto& { return m.link().tkeep; }, valid);
  ports.outputs.back().fixed = true;
  ports.output<bool>(
      "m_tvalid", 1, [&m]() -> auto& { return m.link().tvalid; });
  ports.output<bool>(
      "m_tlast", 1, [&m]() -> auto& { return m.link().tlast; });
}

RtlPins::RtlPins(const std::string& file, std::uint64_t seed, const std::string& ip,
                 const std::string& instance, IpPorts ports)
    : ip_(ip),
      ports_(std::move(ports)),
      object_(file, seed, instance, *ports_.clocks.front().clock),
      risen_ps_(ports_.clocks.size(), vp::Clock::never),
      connected_(object_.descriptor().port_count),
      rest_(object_.descriptor().state_bytes, ports_.clocks.size()) {
  const RtlDescriptor& rtl = object_.descriptor();
  if (*rtl.ip == '\0') {
    refuse(rtl.place,
           "it was built without IP, as a part of a design: build it with "
           "markervp_add_rtl(… IP " +
               ip + " …)");
  }
  if (rtl.ip != ip)
    refuse(rtl.place, std::string("it was built as ") + rtl.ip + "; set pl.fidelity." + rtl.ip);
  leave_out_what_it_lacks();
  for (const IpPorts::ClockPin& clock : ports_.clocks)
    levels_.push_back(static_cast<std::uint8_t*>(pin(clock.name, 1, false)));
  evaluate();  // with the clocks low: the first edge would be none otherwise
  for (const IpPorts::Input& input : ports_.inputs)
    inputs_.push_back({pin(input.name, input.bits, false), input.bits, &input.read});
  for (const IpPorts::Output& output : ports_.outputs)
    outputs_.push_back({pin(output.name, output.bits, true), output.bits, output.clock});
  for (const IpPorts::MemoryOutput& output : ports_.memory_outputs)
    memory_outputs_.push_back(pin(output.name, output.bits, true));
  for (const IpPorts::Input& input : ports_.memory_inputs)
    memory_inputs_.push_back(pin(input.name, input.bits, false));
  for (const IpPorts::IdlePin& idle : ports_.idle_pins) {
    if (find(idle.name)) pin(idle.name, idle.bits, idle.output);
  }
  for (const IpPorts::Parameter& parameter : ports_.parameters) check(parameter);
  for (std::uint32_t i = 0; i < rtl.port_count; ++i) {
    if (!connected_[i]) {
      refuse(rtl.ports[i].place, std::string("the IP has no port '") + rtl.ports[i].name +
                                     "': remove it from module '" + rtl.top + "'");
    }
  }
  reset();
  for (InputPin& pin : inputs_) pin.value = load_pin(pin.place, pin.bits);
}

// As a system reset does before time 0, after which models begin: all other inputs are 0.
void RtlPins::reset() {
  const auto set_resets = [this](std::uint64_t level) {
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      const std::string& name = ports_.inputs[i].name;
      if (name == "rst" || name == "por") store_pin(inputs_[i].place, inputs_[i].bits, level);
    }
  };
  // What has no reset yet is unknown.
  object_.check(false);
  set_resets(1);
  for (unsigned edge = 0; edge < rtl_reset_clocks; ++edge) cycle_clocks();
  set_resets(0);
  object_.check(true);
}

void RtlPins::cycle_clocks() {
  for (const std::uint8_t value : {1, 0}) {
    for (std::uint8_t* level : levels_) *level = value;
    evaluate();
  }
}

// A signal's type is at least as wide as the pin, and its lowest byte comes first, as that of the
// pin.
void RtlPins::find_signals() {
  for (std::size_t i = 0; i < inputs_.size(); ++i) {
    if (ports_.inputs[i].port) inputs_[i].signal = ports_.inputs[i].place();
  }
  bound_ = true;
  const sc_core::sc_object* module = sc_core::sc_find_object(object_.instance().c_str());
  if (module && !ports_.watched) {
    vp::info(*module, "/markervp/rtl/seed",
             "registers without reset start at " + start() +
                 (object_.descriptor().check ? "" : "; built with NO_ASSERTIONS"),
             sc_core::SC_LOW);
  }
}

std::uint64_t RtlPins::now_ps() const {
  return ports_.clocks.front().clock->scheduler().now_ps();
}

void RtlPins::raise(std::size_t clock) {
  const std::uint64_t now = now_ps();
  risen_ = 0;
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    if (i != clock && ports_.clocks[i].clock->edge_at_or_after(now) != now) continue;
    *levels_[i] = 1;
    risen_ps_[i] = now;
    risen_ |= 1u << i;
  }
}

void RtlPins::leave_out_what_it_lacks() {
  auto& outputs = ports_.outputs;
  outputs.erase(std::remove_if(outputs.begin(), outputs.end(),
                               [this](const IpPorts::Output& output) {
                                 return output.optional && !find(output.name);
                               }),
                outputs.end());
  for (IpPorts::Output& output : outputs) {
    if (output.optional) output.bits = std::min(output.bits, find(output.name)->bits);
  }
}

void RtlPins::check(const IpPorts::Parameter& parameter) const {
  const std::string value = std::to_string(parameter.value);
  const RtlDescriptor& rtl = object_.descriptor();
  for (std::uint32_t i = 0; i < rtl.parameter_count; ++i) {
    const RtlParameter& built = rtl.parameters[i];
    if (built.name != parameter.name || built.value == parameter.value) continue;
    refuse(rtl.place, parameter.name + " is " + std::to_string(built.value) + ", and " +
                          parameter.key + " " + value + ": build it with PARAMETERS " +
                          parameter.name + "=" + value);
  }
}

void RtlPins::ask_memory() {
  evaluate();  // address and enable may depend on inputs
  for (std::size_t i = 0; i < memory_outputs_.size(); ++i) {
    if (ports_.memory_outputs[i].take) ports_.memory_outputs[i].take(memory_value(i));
  }
}

void* RtlPins::pin(const std::string& name, unsigned bits, bool output) {
  const RtlDescriptor& rtl = object_.descriptor();
  const RtlPort* port = find(name);
  const std::string wanted = declaration(name, bits, output);
  if (!port) {
    refuse(rtl.place, std::string("module '") + rtl.top + "' lacks the port '" + name +
                          "': declare " + wanted);
  }
  if (port->bits != bits || (port->output != 0) != output) {
    refuse(port->place, "port '" + name + "' is an " + direction(port->output != 0) + " of " +
                            std::to_string(port->bits) + " bits: declare " + wanted);
  }
  const auto index = static_cast<std::uint32_t>(port - rtl.ports);
  connected_[index] = true;
  return object_.pin(index);
}

void RtlPins::refuse(const std::string& place, const std::string& why) const {
  throw vp::InputError("RTL '" + object_.file() + "' does not fit " + ip_ + ": " + place + ": " +
                       why);
}

}  // namespace pl
