#include <pl/common/rtl_model.h>

#include <vp/clock_scheduler.h>
#include <vp/report.h>
#include <vp/text.h>
#include <vp/unit.h>

#include <algorithm>

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

RtlShadow::RtlShadow(sc_core::sc_module_name name, std::deque<RtlPins>& copies)
    : PortWatcher(name, copies.front().ports()),
      ports_(copies.front().ports()),
      model_("model", ports_),
      last_edges_(ports_.clocks.size()),
      edges_left_(clocks_shown) {
  for (const IpPorts::Output& output : ports_.outputs)
    outputs_.emplace_back(output.name.c_str(), output.bits);
  for (RtlPins& pins : copies)
    copies_.push_back({&pins, std::vector<std::uint64_t>(outputs_.size())});
  shown_ = &copies_.front();
  for (const IpPorts::Input& input : ports_.inputs)
    use_.ports.push_back({input.name, input.bits, false, false});
  for (const IpPorts::Output& output : ports_.outputs)
    use_.ports.push_back({output.name, output.bits, true, output.fixed});
  for (const IpPorts::MemoryOutput& output : ports_.memory_outputs)
    use_.ports.push_back({output.name, output.bits, true, !output.expected});
  find_streams();
}

void RtlShadow::find_streams() {
  struct Wire {
    std::string name;
    std::size_t clock;
    std::function<std::uint64_t()> read;
  };
  std::vector<Wire> wires;
  for (const IpPorts::Input& input : ports_.inputs) wires.push_back({input.name, 0, input.read});
  for (const IpPorts::Output& output : ports_.outputs)
    wires.push_back({output.name, output.clock, [port = output.port] { return port()->bits(); }});
  const std::string valid = "_tvalid";
  for (const Wire& wire : wires) {
    const std::size_t end = wire.name.size() - std::min(wire.name.size(), valid.size());
    if (wire.name.substr(end) != valid) continue;
    const std::string stream = wire.name.substr(0, end);
    const auto ready = std::find_if(wires.begin(), wires.end(), [&](const Wire& other) {
      return other.name == stream + "_tready";
    });
    if (ready == wires.end()) continue;
    use_.streams.push_back({stream});
    handshakes_.push_back({std::max(wire.clock, ready->clock), wire.read, ready->read});
  }
}

RtlShadow::Wires::Wires(sc_core::sc_module_name name, const IpPorts& ports) : sc_module(name) {
  for (const IpPorts::Output& output : ports.outputs) {
    if (output.of_link) list.emplace_back(output.name.c_str(), output.bits);
  }
}

void RtlShadow::end_of_elaboration() {
  PortWatcher::end_of_elaboration();
  std::string starts;
  for (const Copy& copy : copies_) starts += (starts.empty() ? "" : ", ") + copy.pins->start();
  vp::info(*this, "/markervp/rtl/seed", "registers without reset start at " + starts,
           sc_core::SC_LOW);
  std::uint32_t wire = 0;
  for (const IpPorts::Output& output : ports_.outputs) {
    if (!output.of_link) continue;
    model_.list[wire] = output.port()->bits();
    output.port()->attach(*this, wire++);
  }
}

void RtlShadow::on_change(vp::SignalBase& signal, std::uint32_t wire) {
  model_.list[wire] = signal.bits();
}

void RtlShadow::edge_of(std::size_t clock) {
  note_use(clock);
  if (difference_.empty()) {
    compare(clock);
  } else if (--edges_left_ == 0) {
    fail();
  }
  for (Copy& copy : copies_) {
    copy.pins->clock_edge(clock);
    note_outputs(copy, clock);
  }
  const vp::Clock& its = *ports_.clocks[clock].clock;
  last_edges_[clock] = {its.cycle(), its.scheduler().now_ps()};
}

// The last edges have not been evaluated yet.
void RtlShadow::end_of_simulation() {
  for (std::size_t i = 0; i < last_edges_.size() && difference_.empty(); ++i) compare(i);
  lockstep_use() = use_;
  if (!lockstep_coverage().empty()) copies_.front().pins->write_coverage(lockstep_coverage());
  if (!difference_.empty()) fail();
  for (Copy& copy : copies_) copy.pins->finish();
}

/// What this edge samples. Inputs are noted on the edges of the first clock.
void RtlShadow::note_use(std::size_t clock) {
  for (std::size_t i = 0; i < handshakes_.size(); ++i) {
    const Handshake& handshake = handshakes_[i];
    if (handshake.clock != clock || handshake.valid() == 0) continue;
    ++(handshake.ready() != 0 ? use_.streams[i].beats : use_.streams[i].stalls);
  }
  if (clock != 0) return;
  ++use_.clocks;
  for (std::size_t i = 0; i < ports_.inputs.size(); ++i)
    use_.ports[i].note(ports_.inputs[i].read() & mask(ports_.inputs[i].bits));
}

void LockstepUse::Port::note(std::uint64_t value) {
  if (clocks++ > 0 && value != last) {
    ++changes;
    rises += value & ~last & 1;
  }
  last = value;
  high |= value;
  low |= ~value & mask(bits);
}

std::string& lockstep_coverage() {
  static std::string file;
  return file;
}

std::optional<LockstepUse>& lockstep_use() {
  static std::optional<LockstepUse> use;
  return use;
}

void RtlShadow::note_outputs(Copy& copy, std::size_t clock) {
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    if (ports_.outputs[i].clock == clock) copy.outputs[i] = copy.pins->value(i);
  }
  if (&copy == shown_) show(copy);
}

void RtlShadow::show(const Copy& copy) {
  shown_ = &copy;
  for (std::size_t i = 0; i < outputs_.size(); ++i) outputs_[i] = copy.outputs[i];
}

/// What is behind the last edge of the clock.
void RtlShadow::compare(std::size_t clock) {
  if (last_edges_[clock].number == 0) return;
  for (Copy& copy : copies_) {
    compare(copy, clock);
    if (!difference_.empty()) break;
  }
  differs = !difference_.empty();
}

void RtlShadow::compare(Copy& copy, std::size_t clock) {
  RtlPins& pins = *copy.pins;
  if (ports_.combinational || !ports_.memory_outputs.empty()) pins.settle();
  if (ports_.combinational) note_outputs(copy, clock);
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    const IpPorts::Output& output = ports_.outputs[i];
    if (output.clock != clock || (output.valid && !output.valid())) continue;
    const std::uint64_t model = output.port()->bits() & mask(output.bits);
    LockstepUse::Port& use = use_.ports[ports_.inputs.size() + i];
    if (&copy == &copies_.front()) use.note(model);
    if (&copy != &copies_.front() && output.unwritten && use.high == 0) continue;
    compare(output.name, output.bits, model, copy.outputs[i]);
  }
  for (std::size_t i = 0; i < ports_.memory_outputs.size(); ++i) {
    const IpPorts::MemoryOutput& output = ports_.memory_outputs[i];
    const auto model = output.expected ? output.expected() : std::nullopt;
    if (!model) continue;
    if (&copy == &copies_.front())
      use_.ports[ports_.inputs.size() + ports_.outputs.size() + i].note(*model);
    compare(output.name, output.bits, *model, pins.memory_value(i));
  }
  if (difference_.empty()) return;
  show(copy);
  const Edge& edge = last_edges_[clock];
  difference_ = "RTL '" + pins.file() + "' differs from the model behind edge " +
                std::to_string(edge.number) + " of " + ports_.clocks[clock].clock->basename() +
                ", at " + vp::format_time(edge.ps) + ": " + difference_;
  if (&copy != &copies_.front()) {
    difference_ += ", when registers without reset start at " + pins.start() +
                   " instead of 0: give them a reset";
  }
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
