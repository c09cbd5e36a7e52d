#include <pl/common/rtl_model.h>

#include <vp/clock_scheduler.h>
#include <vp/report.h>
#include <vp/text.h>
#include <vp/unit.h>

namespace pl {

namespace {

/// Behind the first difference, for a trace, with those of both clocks where there are two.
constexpr std::uint64_t clocks_shown = 32;

std::uint64_t mask(unsigned bits) {
  return bits == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
}

std::string number(std::uint64_t value, unsigned bits) {
  return bits <= 4 ? std::to_string(value) : vp::hex(value);
}

}  // namespace

void RtlInPlace::listen() {
  for (const IpPorts::Input& input : pins_.ports().inputs) {
    if (input.port) input.port->signal()->attach(*this);
  }
  listening_ = sleeping_ = true;
}

void RtlInPlace::stop_listening() {
  for (const IpPorts::Input& input : pins_.ports().inputs) {
    if (input.port) input.port->signal()->detach(*this);
  }
  listening_ = false;
}

void RtlInPlace::on_change(vp::SignalBase&, std::uint32_t) {
  sleeping_ = false;
  for (vp::Clocked* module : modules_) module->wake();
}

PortTaps::PortTaps(const IpPorts& ports, vp::Clocked& owner) {
  for (const IpPorts::Input& input : ports.inputs) {
    if (input.port) taps_.emplace_back([port = input.port] { return port->signal(); }, owner);
  }
  for (const IpPorts::Output& output : ports.outputs) taps_.emplace_back(output.port, owner);
}

PortWatcher::PortWatcher(sc_core::sc_module_name name, const IpPorts& ports)
    : Clocked(name, *ports.clocks.front().clock), taps_(ports, *this) {
  for (std::size_t i = 1; i < ports.clocks.size(); ++i) further_.emplace_back(*this, ports, i);
}

RtlShadow::RtlShadow(sc_core::sc_module_name name, RtlPins& pins)
    : PortWatcher(name, pins.ports()),
      pins_(pins),
      model_("model", pins.ports()),
      last_edges_(pins.ports().clocks.size()),
      edges_left_(clocks_shown) {
  for (const IpPorts::Output& output : pins_.ports().outputs)
    outputs_.emplace_back(output.name.c_str(), output.bits);
}

RtlShadow::Wires::Wires(sc_core::sc_module_name name, const IpPorts& ports) : sc_module(name) {
  for (const IpPorts::Output& output : ports.outputs) {
    if (output.of_link) list.emplace_back(output.name.c_str(), output.bits);
  }
}

void RtlShadow::end_of_elaboration() {
  PortWatcher::end_of_elaboration();
  std::uint32_t wire = 0;
  for (const IpPorts::Output& output : pins_.ports().outputs) {
    if (!output.of_link) continue;
    model_.list[wire] = output.port()->bits();
    output.port()->attach(*this, wire++);
  }
}

void RtlShadow::on_change(vp::SignalBase& signal, std::uint32_t wire) {
  model_.list[wire] = signal.bits();
}

void RtlShadow::edge_of(std::size_t clock) {
  if (difference_.empty()) {
    compare(clock);
  } else if (--edges_left_ == 0) {
    fail();
  }
  pins_.clock_edge(clock);
  note_outputs(clock);
  const vp::Clock& its = *pins_.ports().clocks[clock].clock;
  last_edges_[clock] = {its.cycle(), its.scheduler().now_ps()};
}

// Nobody looked behind the last edges yet.
void RtlShadow::end_of_simulation() {
  for (std::size_t i = 0; i < last_edges_.size() && difference_.empty(); ++i) compare(i);
  if (!difference_.empty()) fail();
}

void RtlShadow::note_outputs(std::size_t clock) {
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    if (pins_.ports().outputs[i].clock == clock) outputs_[i] = pins_.value(i);
  }
}

/// What stands behind the last edge of the clock.
void RtlShadow::compare(std::size_t clock) {
  const Edge& edge = last_edges_[clock];
  if (edge.number == 0) return;
  const IpPorts& ports = pins_.ports();
  if (ports.combinational || !ports.memory_outputs.empty()) pins_.settle();
  if (ports.combinational) note_outputs(clock);
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    const IpPorts::Output& output = ports.outputs[i];
    if (output.clock != clock || (output.valid && !output.valid())) continue;
    compare(output.name, output.bits, output.port()->bits() & mask(output.bits), outputs_[i].get());
  }
  for (std::size_t i = 0; i < ports.memory_outputs.size(); ++i) {
    const IpPorts::MemoryOutput& output = ports.memory_outputs[i];
    const auto model = output.expected ? output.expected() : std::nullopt;
    if (model) compare(output.name, output.bits, *model, pins_.memory_value(i));
  }
  differs = !difference_.empty();
  if (difference_.empty()) return;
  difference_ = "RTL '" + pins_.file() + "' differs from the model behind edge " +
                std::to_string(edge.number) + " of " + ports.clocks[clock].clock->basename() +
                ", at " + vp::format_time(edge.ps) + ": " + difference_;
}

void RtlShadow::compare(const std::string& port, unsigned bits, std::uint64_t model,
                        std::uint64_t rtl) {
  if (model == rtl) return;
  difference_ += (difference_.empty() ? "" : ", ") + port + " is " + number(model, bits) +
                 ", and " + number(rtl, bits) + " in the RTL";
}

void RtlShadow::fail() const {
  vp::error(*this, "/markervp/rtl/lockstep", difference_);
}

}  // namespace pl
