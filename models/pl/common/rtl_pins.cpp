#include <pl/common/rtl_pins.h>

#include <dlfcn.h>

#include <algorithm>

#include <vp/clock_scheduler.h>
#include <vp/error.h>
#include <vp/foreign_object.h>
#include <vp/report.h>
#include <vp/unit.h>

namespace pl {

namespace {

constexpr const char* rebuild = "build it with markervp_add_rtl() of this markervp";

const RtlDescriptor& open(const std::string& file) {
  const std::string whose = "RTL '" + file + "' ";
  void* library = vp::load_object(vp::rtl_object, file);
  void* symbol = ::dlsym(library, RTL_SYMBOL);
  if (!symbol) throw vp::InputError(whose + "is not RTL: it has no '" RTL_SYMBOL "'; " + rebuild);
  vp::keep_object(vp::rtl_object, file, library);
  const RtlDescriptor* rtl = nullptr;
  std::uint32_t interface = 0;
  const std::string stopped = vp::stopped_by([&] {
    rtl = reinterpret_cast<const RtlDescriptor* (*)()>(symbol)();
    interface = rtl->interface;
  });
  if (!stopped.empty()) throw vp::ProtocolError(whose + "is damaged: " + stopped + "; " + rebuild);
  if (interface != RTL_INTERFACE) {
    throw vp::InputError(whose + "has interface " + std::to_string(interface) + ", this is " +
                         std::to_string(RTL_INTERFACE) + ": " + rebuild);
  }
  return *rtl;
}

/// Of the peripherals by Processor System Reset (PG164).
constexpr unsigned reset_clocks = 16;

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
    : file_(file),
      seed_(seed),
      ip_(ip),
      instance_(instance),
      ports_(std::move(ports)),
      rtl_(open(file)),
      model_(rtl_.create(instance.c_str(), seed), rtl_.destroy),
      risen_ps_(ports_.clocks.size(), vp::Clock::never),
      connected_(rtl_.port_count),
      rest_(rtl_.state_bytes, ports_.clocks.size()) {
  if (rtl_.ip != ip)
    refuse(rtl_.place, std::string("it was built as ") + rtl_.ip + "; set pl.fidelity." + rtl_.ip);
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
  for (std::uint32_t i = 0; i < rtl_.port_count; ++i) {
    if (!connected_[i]) {
      refuse(rtl_.ports[i].place, std::string("the IP has no port '") + rtl_.ports[i].name +
                                      "': remove it from module '" + rtl_.top + "'");
    }
  }
  reset();
  for (InputPin& pin : inputs_) pin.value = load(pin.place, pin.bits);
}

vp::IpEstimate::Foreign RtlPins::foreign() const {
  vp::IpEstimate::Foreign foreign;
  foreign.file = file_;
  foreign.sources.assign(rtl_.sources, rtl_.sources + rtl_.source_count);
  for (std::uint32_t i = 0; i < rtl_.parameter_count; ++i)
    foreign.parameters[rtl_.parameters[i].name] = rtl_.parameters[i].value;
  return foreign;
}

// As a system reset does before time 0, after which models begin: all other inputs are 0.
void RtlPins::reset() {
  const auto set_resets = [this](std::uint64_t level) {
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      const std::string& name = ports_.inputs[i].name;
      if (name == "rst" || name == "por") store(inputs_[i].place, inputs_[i].bits, level);
    }
  };
  // What has no reset yet is unknown.
  if (rtl_.check) rtl_.check(model_.get(), 0);
  set_resets(1);
  for (unsigned edge = 0; edge < reset_clocks; ++edge) cycle_clocks();
  set_resets(0);
  if (rtl_.check) rtl_.check(model_.get(), 1);
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
  const sc_core::sc_object* module = sc_core::sc_find_object(instance_.c_str());
  if (module && !ports_.watched) {
    vp::info(*module, "/markervp/rtl/seed",
             "registers without reset start at " + start() +
                 (rtl_.check ? "" : "; built with NO_ASSERTIONS"),
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
  for (std::uint32_t i = 0; i < rtl_.parameter_count; ++i) {
    const RtlParameter& built = rtl_.parameters[i];
    if (built.name != parameter.name || built.value == parameter.value) continue;
    refuse(rtl_.place, parameter.name + " is " + std::to_string(built.value) + ", and " +
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

const RtlPort* RtlPins::find(const std::string& name) const {
  for (std::uint32_t i = 0; i < rtl_.port_count; ++i) {
    if (rtl_.ports[i].name == name) return &rtl_.ports[i];
  }
  return nullptr;
}

void* RtlPins::pin(const std::string& name, unsigned bits, bool output) {
  const RtlPort* port = find(name);
  const std::string wanted = declaration(name, bits, output);
  if (!port) {
    refuse(rtl_.place, std::string("module '") + rtl_.top + "' lacks the port '" + name +
                           "': declare " + wanted);
  }
  if (port->bits != bits || (port->output != 0) != output) {
    refuse(port->place, "port '" + name + "' is an " + direction(port->output != 0) + " of " +
                            std::to_string(port->bits) + " bits: declare " + wanted);
  }
  const auto index = static_cast<std::uint32_t>(port - rtl_.ports);
  connected_[index] = true;
  return rtl_.pin(model_.get(), index);
}

std::string RtlPins::start() const {
  return seed_ < 2 ? std::to_string(seed_) : "random values (seed " + std::to_string(seed_) + ")";
}

void RtlPins::ended(const RtlEnd& end) const {
  const vp::Clock& clk = *ports_.clocks.front().clock;
  const std::string place = *end.place ? std::string(" (") + end.place + ")" : "";
  const std::string text = "RTL '" + file_ + "' ended itself behind edge " +
                           std::to_string(clk.cycle()) + " of " + clk.name() + ", at " +
                           vp::format_time(now_ps()) + ": " + end.why + place;
  const sc_core::sc_object* module = sc_core::sc_find_object(instance_.c_str());
  if (module && sc_core::sc_is_running()) vp::error(*module, rtl_ended, text);
  throw vp::ProtocolError(instance_ + ": " + text);
}

void RtlPins::refuse(const std::string& place, const std::string& why) const {
  throw vp::InputError("RTL '" + file_ + "' does not fit " + ip_ + ": " + place + ": " + why);
}

}  // namespace pl
