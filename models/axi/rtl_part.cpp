#include <axi/rtl_part.h>

#include <algorithm>
#include <utility>

#include <vp/clock_scheduler.h>
#include <vp/error.h>
#include <vp/report.h>
#include <vp/rule_reports.h>
#include <vp/text.h>

namespace axi {

namespace {

constexpr std::uint64_t usual_seed = 1000;  // as RTL in the place of an IP has
constexpr std::uint32_t settle_id = ~0u;    // of settles_ among the signals listened to
/// Changes within one instant, behind which logic will not settle: more than a path through as many
/// parts has.
constexpr unsigned most_settlings = 1000;

}  // namespace

/// The edges of one clock.
class RtlPart::Side final : public vp::Clocked {
 public:
  Side(const char* name, vp::Clock& clk, RtlPart& part, std::size_t number)
      : Clocked(name, clk), part_(part), number_(number) {}
  using Clocked::sleep;

 private:
  void edge() override { part_.edge_of(number_); }

  RtlPart& part_;
  const std::size_t number_;
};

RtlPart::RtlPart(sc_core::sc_module_name name, const std::string& file, const ClockPins& clocks)
    : sc_module(name),
      Ip(clocks.empty() ? nullptr : clocks.front().second),
      seed_("seed", usual_seed, vp::Unit::none, vp::Source::decision,
            "how registers without reset start: 0 zeros, 1 ones, otherwise random values of this "
            "seed"),
      figures_("figures", "", vp::Source::decision,
               "what synthesis makes of this RTL: a file of 'markervp rtl synth --output'; by "
               "default <name>.figures.json beside the object"),
      registers_("registers", "", vp::Source::decision,
                 "what describes its registers: component.xml, SystemRDL or a header of Vitis HLS; "
                 "by default <name>.registers.xml, .rdl or .h beside the object") {
  const RtlDescriptor& descriptor = pl::open_rtl(file);
  kind_ = std::string("RTL ") + descriptor.top;
  if (*descriptor.ip != '\0') {
    throw vp::InputError(std::string(this->name()) + ": RTL '" + file + "' was built in place of " +
                         descriptor.ip +
                         ": as a part of a design, build it with markervp_add_rtl() without IP");
  }
  interfaces_ = find_interfaces(descriptor);
  if (clocks.empty()) {
    throw vp::InputError(
        std::string(this->name()) + ": RTL '" + file +
        "' needs a clock, for its edges and its reports; of logic without any give "
        "one for no port, ''");
  }
  rtl_ = std::make_unique<pl::RtlObject>(file, seed_, this->name(), *clocks.front().second);
  connect_clocks(clocks);
  reset();
  rest_ = std::make_unique<pl::RtlRest>(descriptor.state_bytes, sides_.size());
  vp::IpEstimate::Foreign foreign = rtl_->foreign();
  foreign.figures = figures_.get();
  activity_ = std::make_unique<pl::RtlActivity>(*rtl_);
  if (!is_logic_) foreign.toggles = activity_->toggles();
  set_foreign(std::move(foreign));
  settles_.defer_writes();
  settles_.attach(*this, settle_id);
}

RtlPart::~RtlPart() = default;

void RtlPart::connect_clocks(const ClockPins& clocks) {
  for (const auto& [pin, clock] : clocks) {
    if (pin.empty()) {
      is_logic_ = true;
      sides_.push_back(std::make_unique<Side>("no_edges", *clock, *this, sides_.size()));
      continue;
    }
    const Interface& interface = find(pin, {Kind::clock});
    claim(pin, {Kind::clock}, true);
    levels_.push_back(static_cast<std::uint8_t*>(rtl_->pin(interface.ports.at(""))));
    sides_.push_back(
        std::make_unique<Side>((pin + "_edges").c_str(), *clock, *this, sides_.size()));
  }
  for (const Interface& interface : interfaces_) {
    if (interface.kind == Kind::clock && !connected_[interface.name])
      refuse(interface, "clock '" + interface.name + "' is not connected");
  }
  fall_unseen_ = clocks_fall_unseen();
  registered_ = has_note("registered");
}

// As a system reset does before time 0, after which the platform begins: all other inputs are 0.
void RtlPart::reset() {
  for (const Interface& interface : interfaces_) {
    if (interface.kind == Kind::reset) resets_.push_back({pin_of(interface), interface.active_low});
  }
  const auto set_resets = [this](bool active) {
    for (const ResetPin& reset : resets_) reset.pin.set(active != reset.active_low);
  };
  rtl_->check(false);
  set_resets(true);
  rtl_->evaluate();
  for (unsigned edge = 0; edge < pl::rtl_reset_clocks; ++edge) {
    for (const std::uint8_t level : {1, 0}) {
      for (std::uint8_t* clock : levels_) *clock = level;
      rtl_->evaluate();
    }
  }
  set_resets(false);
  rtl_->check(true);
}

const Interface& RtlPart::find(const std::string& name, std::initializer_list<Kind> kinds) const {
  std::vector<std::string> names;
  for (const Interface& interface : interfaces_) {
    if (std::find(kinds.begin(), kinds.end(), interface.kind) == kinds.end()) continue;
    if (interface.name == name) return interface;
    names.push_back(interface.name);
  }
  std::string wanted;
  for (const Kind kind : kinds)
    wanted += (wanted.empty() ? "" : " or ") + std::string(to_string(kind));
  throw vp::InputError(std::string(this->name()) + ": RTL '" + rtl_->file() + "' has no " + wanted +
                       " '" + name + "'" +
                       (names.empty() ? std::string() : ": it has " + vp::one_of(names)));
}

void RtlPart::refuse(const Interface& interface, const std::string& why) const {
  const RtlPort& port = rtl_->descriptor().ports[interface.ports.begin()->second];
  throw vp::InputError(std::string(name()) + ": " + port.place + ": " + why);
}

const Interface& RtlPart::claim(const std::string& name, std::initializer_list<Kind> kinds,
                                bool slave) {
  const Interface& interface = find(name, kinds);
  if (interface.slave != slave) {
    refuse(interface,
           "'" + name + "' is " +
               (interface.ports.size() == 1 ? (interface.slave ? "an input" : "an output")
                                            : (interface.slave ? "a slave" : "a master")) +
               ", and is connected as the other");
  }
  if (std::exchange(connected_[name], true)) refuse(interface, "'" + name + "' is connected twice");
  return interface;
}

Pin RtlPart::pin_of(const Interface& interface, const std::string& signal) const {
  const std::uint32_t port = interface.ports.at(signal);
  return {rtl_->pin(port), rtl_->descriptor().ports[port].bits};
}

std::size_t RtlPart::clock_of(const Interface& interface) const {
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    if (sides_[i]->basename() == interface.clock + "_edges") return i;
  }
  return 0;
}

template <class Link>
Link* RtlPart::made(const std::string& name) const {
  for (const auto& link : links_) {
    auto* found = dynamic_cast<Link*>(link.get());
    if (found && found->name == name) return found;
  }
  return nullptr;
}

template <class Link>
Link& RtlPart::add(std::unique_ptr<Link> link) {
  Link& added = *link;
  links_.push_back(std::move(link));
  return added;
}

TlmToPins& RtlPart::slave(const std::string& name) {
  if (SlaveLink* link = made<SlaveLink>(name)) return link->adapter();
  const Interface& interface = claim(name, {Kind::axi4, Kind::axi_lite}, true);
  const vp::HierarchyScope inside(*this);
  const std::size_t clock = clock_of(interface);
  auto& link = add(std::make_unique<SlaveLink>(
      interface, clock, *rtl_, sides_[clock]->clock(),
      [this, number = links_.size()](bool behind_edge) { begin(*links_[number], behind_edge); }));
  buses_.push_back(&link);
  return link.adapter();
}

PinsToTlm& RtlPart::master(const std::string& name) {
  if (MasterLink* link = made<MasterLink>(name)) return link->adapter();
  const Interface& interface = claim(name, {Kind::axi4, Kind::axi_lite}, false);
  const vp::HierarchyScope inside(*this);
  const std::size_t clock = clock_of(interface);
  auto& link = add(std::make_unique<MasterLink>(interface, clock, *rtl_, sides_[clock]->clock()));
  buses_.push_back(&link);
  return link.adapter();
}

unsigned RtlPart::stream_bytes(const std::string& name) const {
  constexpr unsigned bits_per_byte = 8;
  const Interface& interface = find(name, {Kind::axi_stream});
  if (!interface.has("tdata")) return 0;
  return rtl_->descriptor().ports[interface.ports.at("tdata")].bits / bits_per_byte;
}

vp::AxiStreamSlave& RtlPart::stream_in(const std::string& name) {
  if (StreamInLink* link = made<StreamInLink>(name)) return link->port();
  const Interface& interface = claim(name, {Kind::axi_stream}, true);
  const std::size_t clock = clock_of(interface);
  auto& link = add(std::make_unique<StreamInLink>(interface, clock, *rtl_, *sides_[clock]));
  streams_.push_back(&link);
  return link.port();
}

vp::AxiStreamMaster& RtlPart::stream_out(const std::string& name, unsigned packet_beats) {
  if (StreamOutLink* link = made<StreamOutLink>(name)) return link->port();
  const Interface& interface = claim(name, {Kind::axi_stream}, false);
  if (!interface.has("tlast") && packet_beats == never_said) {
    refuse(interface, "stream '" + name +
                          "' has no TLAST: say how many beats a packet has, 0 for a stream without "
                          "packets");
  }
  const std::size_t clock = clock_of(interface);
  auto& link =
      add(std::make_unique<StreamOutLink>(interface, clock, *rtl_, *sides_[clock], packet_beats));
  streams_.push_back(&link);
  return link.port();
}

RtlPart::Output& RtlPart::add_output(const std::string& name, unsigned bits) {
  const Interface& interface = claim(name, {Kind::interrupt, Kind::wire}, false);
  const Pin pin = pin_of(interface);
  if (pin.bits() > bits)
    refuse(interface, "output '" + name + "' has " + std::to_string(pin.bits()) +
                          " bits, and what it drives " + std::to_string(bits));
  Output& output = outputs_.emplace_back();
  output.name = name;
  output.pin = pin;
  return output;
}

void RtlPart::input(const std::string& name, vp::SignalBase& signal) {
  const Interface& interface = claim(name, {Kind::reset, Kind::wire}, true);
  if (pin_of(interface).bits() > 64)
    refuse(interface, "input '" + name + "' has more than 64 bits: signals have 64 at most");
  inputs_.push_back(
      {&signal, pin_of(interface), has_note("edge", name), interface.kind == Kind::reset});
  named_inputs_.push_back({&interface, &signal});
  if (interface.kind == Kind::reset)
    reset_signals_.push_back({&signal, interface.active_low, clock_of(interface)});
}

void RtlPart::tie(const std::string& name, std::uint64_t value) {
  const Interface& interface = claim(name, {Kind::reset, Kind::wire}, true);
  const Pin pin = pin_of(interface);
  if (interface.kind == Kind::reset && (value != 0) != interface.active_low)
    refuse(interface, "reset '" + name +
                          "' would hold the RTL for ever: leave it open, and it stays "
                          "inactive");
  if (pin.bits() < 64 && value >> pin.bits() != 0)
    refuse(interface, "input '" + name + "' has " + std::to_string(pin.bits()) + " bits, and " +
                          vp::hex(value) + " does not fit");
  pin.set(value);
}

void RtlPart::leave_open(const std::string& name) {
  const Interface& interface = find(name, {Kind::axi4, Kind::axi_lite, Kind::axi_stream,
                                           Kind::reset, Kind::wire, Kind::interrupt});
  claim(name, {interface.kind}, interface.slave);
}

// A reset that is not connected stays inactive; outputs may be left open.
void RtlPart::check_connections() const {
  for (const Interface& interface : interfaces_) {
    const bool bus = interface.kind == Kind::axi4 || interface.kind == Kind::axi_lite ||
                     interface.kind == Kind::axi_stream;
    const bool input = interface.kind == Kind::wire && interface.slave;
    const auto found = connected_.find(interface.name);
    if ((!bus && !input) || (found != connected_.end() && found->second)) continue;
    refuse(interface, std::string(to_string(interface.kind)) + " '" + interface.name +
                          "' is not connected: connect it, " +
                          (bus ? "or leave it open on purpose" : "or tie it to a value"));
  }
}

void RtlPart::before_end_of_elaboration() {
  check_connections();
  for (const auto& link : links_) {
    auto* master = dynamic_cast<MasterLink*>(link.get());
    if (master && !master->is_bound())
      refuse(find(master->name, {Kind::axi4, Kind::axi_lite}),
             "master '" + master->name +
                 "' reaches no memory: connect both of its ports, read and write, to an "
                 "interconnect");
    auto* stream = dynamic_cast<StreamOutLink*>(link.get());
    for (const ResetSignal& reset : reset_signals_)
      if (stream && stream->clock == reset.clock)
        stream->port().reset_by(*reset.signal, reset.active_low);
  }
  show_pins();
}

void RtlPart::follow(vp::SignalBase& signal, const Pin& pin) {
  if (pin) inputs_.push_back({&signal, pin, false, false});
}

void RtlPart::end_of_elaboration() {
  for (const auto& link : links_) {
    link->connect([this](vp::SignalBase& signal, const Pin& pin) { follow(signal, pin); });
  }
  for (std::uint32_t i = 0; i < inputs_.size(); ++i) {
    inputs_[i].signal->attach(*this, i);
    inputs_[i].signal->defer_writes();
  }
}

/// Of other RTL, or of the clocked model that writes it; null: a process does.
const vp::Clock* RtlPart::clock_of_writer(const vp::SignalBase& signal) const {
  if (const auto* other = dynamic_cast<const RtlPart*>(signal.get_parent_object()))
    return other->is_logic_ ? nullptr
                            : &other
                                   ->sides_[other->clock_of(other->find(
                                       signal.basename(), {Kind::wire, Kind::interrupt}))]
                                   ->clock();
  const vp::Clocked* writer = signal.writer();
  return writer ? &writer->clock() : nullptr;
}

void RtlPart::watch_inputs() {
  if (is_logic_) return;  // it samples nothing
  for (const auto& [interface, signal] : named_inputs_) {
    const vp::Clock& clock = sides_[clock_of(*interface)]->clock();
    if (interface->kind == Kind::reset) {
      checker_.watch_reset(interface->name, *signal, interface->active_low, clock);
    } else if (const vp::Clock* from = clock_of_writer(*signal)) {
      checker_.watch_wire(interface->name, *signal, *from, clock);
    }
  }
}

void RtlPart::start_of_simulation() {
  const bool watched = vp::links_are_watched();
  if (watched) watch_inputs();
  for (const auto& link : links_) {
    link->watch(watched);
    if (link->samples()) samplers_.push_back(link.get());
  }
  for (const Input& input : inputs_) input.pin.set(input.signal->bits());
  in_reset_ = in_reset();
  rtl_->evaluate();
  show_outputs();
  vp::info(*this, "/markervp/rtl/seed",
           "registers without reset start at " + rtl_->start() +
               (rtl_->descriptor().check ? "" : "; built with NO_ASSERTIONS"),
           sc_core::SC_LOW);
}

// Several inputs change in one instant, in any order: the RTL is evaluated once, when they have. A
// signal whose writes are deferred becomes visible behind all that were written before it.
void RtlPart::on_change(vp::SignalBase& signal, std::uint32_t id) {
  if (id == settle_id) return settle();
  const Input& input = inputs_[id];
  input.pin.set(signal.bits());
  if (input.resets) in_reset_ = in_reset();
  // Behind an edge, registers sample it on the next one, and no output shows it before.
  if (registered_ && !input.has_edge && now_ps() == edge_ps_) return wake();
  settles_ = !settles_.get();
}

std::uint64_t RtlPart::now_ps() const {
  return sides_.front()->clock().scheduler().now_ps();
}

void RtlPart::settle() {
  const std::uint64_t now = now_ps();
  settled_ = now == settle_ps_ ? settled_ + 1 : 0;
  settle_ps_ = now;
  if (settled_ > most_settlings) {
    vp::error(*this, "/markervp/rtl/loop",
              "its outputs and inputs keep changing within one instant: a combinational loop leads "
              "through RTL '" +
                  rtl_->file() + "'");
  }
  rest_->inputs_changed();
  rtl_->evaluate();
  show_outputs();
  wake();
}

void RtlPart::show_outputs() {
  for (RtlLink* stream : streams_) stream->show_outputs();
  for (Output& output : outputs_) {
    const std::uint64_t now = output.pin.get();
    if (now == output.value) continue;
    output.value = now;
    output.write(now);
  }
}

/// The clocks that rise now, `clock` among them: a bit for each.
unsigned RtlPart::rising_now(std::size_t clock) const {
  const std::uint64_t now = now_ps();
  unsigned risen = 1u << clock;
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const vp::Clock& other = sides_[i]->clock();
    if (i != clock && other.frequency_hz() != 0 && other.edge_at_or_after(now) == now)
      risen |= 1u << i;
  }
  return risen;
}

void RtlPart::edge_of(std::size_t clock) {
  const std::uint64_t now = now_ps();
  unsigned risen = 1;
  if (sides_.size() > 1) {
    if (edge_ps_ == now) return;  // it has risen together with another
    risen = rising_now(clock);
  }
  edge_ps_ = now;
  const auto rises = [risen](const auto& link) { return (risen >> link->clock & 1) != 0; };
  for (RtlLink* link : samplers_) {
    if (rises(link)) link->sample(in_reset_);
  }
  for (std::size_t i = 0; i < levels_.size(); ++i) *levels_[i] = risen >> i & 1;
  rtl_->evaluate();
  bool changed = false;
  for (RtlLink* bus : buses_) {
    if (rises(bus) && bus->drive()) changed = true;
  }
  lower(changed && !registered_);
  activity_->edge();
  show_outputs();
  if (changed) rest_->inputs_changed();
  if (rest_->due()) rest(risen);
}

bool RtlPart::in_reset() const {
  return std::any_of(resets_.begin(), resets_.end(), [](const ResetPin& reset) {
    return (reset.pin.get() != 0) != reset.active_low;
  });
}

void RtlPart::end_of_simulation() {
  for (const auto& link : links_) link->finish();
  checker_.finish();
  rtl_->finish();
}

void RtlPart::lower(bool inputs_changed) {
  if (fall_unseen_ && !inputs_changed) return rtl_->lower();
  for (std::uint8_t* level : levels_) *level = 0;
  rtl_->evaluate();
}

bool RtlPart::has_note(const std::string& what, const std::string& port) const {
  const RtlDescriptor& rtl = rtl_->descriptor();
  return std::any_of(rtl.notes, rtl.notes + rtl.note_count,
                     [&](const RtlNote& note) { return note.what == what && note.port == port; });
}

/// RtlObject::lower() knows just the clocks that are connected.
bool RtlPart::clocks_fall_unseen() const {
  std::size_t known = 0;
  const RtlDescriptor& rtl = rtl_->descriptor();
  for (std::uint32_t i = 0; i < rtl.note_count; ++i) {
    if (std::string(rtl.notes[i].what) != "unseen") continue;
    const char* const clock = rtl.notes[i].port;
    if (std::none_of(interfaces_.begin(), interfaces_.end(), [&](const Interface& one) {
          return one.kind == Kind::clock && one.name == clock;
        }))
      return false;
    ++known;
  }
  return rtl_->lowers() && known == levels_.size();
}

void RtlPart::rest(unsigned risen) {
  if (rtl_->descriptor().state_bytes == 0) return;
  for (const auto& link : links_) {
    if (link->busy()) return rest_->inputs_changed();
  }
  if (!rest_->reached(rtl_->state(), risen)) return;
  for (const auto& side : sides_) side->sleep();
}

void RtlPart::begin(RtlLink& slave, bool behind_edge) {
  if (behind_edge && slave.drive() && !registered_) {
    rtl_->evaluate();
    show_outputs();
  }
  wake();
}

void RtlPart::wake() {
  rest_->inputs_changed();
  for (const auto& side : sides_) side->wake();
}

}  // namespace axi
