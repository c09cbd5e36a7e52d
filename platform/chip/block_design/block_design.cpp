#include <chip/block_design/block_design.h>
#include <chip/block_design/place_ports.h>
#include <gic_registers.h>

#include <vp/error.h>
#include <vp/ip.h>
#include <vp/report.h>
#include <vp/text.h>
#include <xilinx/axi_uartlite/axi_uartlite.h>
#include <xilinx/blk_mem_gen/blk_mem_gen.h>
#include <xilinx/register_stub/register_stub.h>
#include <xilinx/wiring/wiring.h>

#include <algorithm>
#include <utility>

namespace platform::block_design {

ExternalInput::ExternalInput(sc_core::sc_module_name name, vp::ClockScheduler& scheduler,
                             const ExternalPin& description)
    : sc_module(name), pin("pin", description.width) {
  if (description.hz != 0) {
    frequency = std::make_unique<vp::Parameter<std::uint64_t>>(
        "frequency", description.hz, vp::Unit::frequency,
        vp::Range<std::uint64_t>{1, 1'000'000'000}, vp::Source::decision,
        "of the oscillator at this pin");
    clk = std::make_unique<vp::Clock>("clk", scheduler, frequency->get());
    return;
  }
  const std::uint64_t most =
      description.width >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << description.width) - 1;
  level = std::make_unique<vp::Parameter<std::uint64_t>>(
      "level", description.level, vp::Unit::none, vp::Range<std::uint64_t>{0, most},
      vp::Source::decision, "what is at the pin from time 0 on");
  pin = level->get();
}

BlockDesign::BlockDesign(sc_core::sc_module_name name, PlPorts& ports, const DesignFile& design)
    : sc_module(name), ports_(ports), design_(design) {
  for (const PlacedPart& part : design_.parts) {
    if (vp::split(part.vlnv, ':').at(2) == "processing_system7") ps_ = part.name;
  }
  try {
    build();
  } catch (...) {
    take_apart();  // no destructor runs
    throw;
  }
}

void BlockDesign::build() {
  place_all();
  for (const PlacedPart& part : design_.parts) join_pins(part);
  join_serial_lines();
  join_memories();
  join_streams();
  join_addresses();
  close_open_streams();
  close_open_ports();
  find_delivery();
  if (design_.unit.end.part.empty()) return;
  unit_end_ = &signal_of(design_.unit.end);
  if (unit_end_->width() != 1)
    refuse(design_.unit.end, "has several bits, and a unit ends where one rises");
}

namespace {

/// What a design delivers that says nothing of it.
class NoDelivery : public Design {
 public:
  facts::Work work() const override { return {"", "the program ends well"}; }
};

}  // namespace

void BlockDesign::find_delivery() {
  std::string of;
  for (const PlacedPart& part : design_.parts) {
    const OwnIp* own = part.is_stub() ? nullptr : own_ip(part.vlnv);
    if (!own || !own->deliver) continue;
    const Surroundings around{
        part, ports_, design_,
        [this](const std::string& name) -> const Placed& { return placed(name); },
        [this, &part](const std::string& pin) -> vp::Clock* {
          const auto source = part.pins.find(pin);
          return source == part.pins.end() ? nullptr : clock_of(source->second);
        }};
    if (has_own_)
      around.refuse("a design delivers what one part does, and " + of +
                    " is another: make one a stub ('as: stub')");
    delivery_ = own->deliver(around);
    has_own_ = true;
    of = part.name;
  }
  if (!has_own_) delivery_ = std::make_unique<NoDelivery>();
}

facts::Work BlockDesign::work() const {
  const std::string& unit = design_.unit.name;
  return unit.empty() ? of_own().work() : facts::Work{unit, "every " + unit + " is delivered"};
}

std::vector<Design::ClockRole> BlockDesign::clock_roles() {
  return has_own_ ? of_own().clock_roles() : Design::clock_roles();
}

// What ends one begins the next: there is nothing else by which a program as it is shows its units.
bool BlockDesign::report(const Publication& publication, facts::UnitReport& unit) {
  if (design_.unit.name.empty()) return of_own().report(publication, unit);
  unit.start_ps = std::exchange(unit_from_ps_, publication.ps);
  unit.end_ps = publication.ps;
  return true;
}

BlockDesign::~BlockDesign() {
  take_apart();
}

// What is clocked goes before its clock.
void BlockDesign::take_apart() {
  delivery_.reset();
  blocked_.clear();
  silent_.clear();
  adapters_.clear();
  for (auto name = order_.rbegin(); name != order_.rend(); ++name) placed_.at(*name).object.reset();
}

void BlockDesign::refuse(const End& end, const std::string& problem,
                         const std::vector<std::string>& names) const {
  const std::string nearest = vp::nearest_match(end.port, names);
  throw vp::InputError(end.place + ": '" + end.text() + "' " + problem +
                       (nearest.empty() ? "" : ": did you mean '" + nearest + "'?"));
}

void BlockDesign::place_all() {
  for (const ExternalPin& pin : design_.external) {
    external_[pin.name] =
        std::make_unique<ExternalInput>(("external_" + pin.name).c_str(), ports_.scheduler, pin);
  }
  for (const PlacedPart& part : design_.parts) placed(part.name);
}

// Clock managers are placed before what they clock.
Placed& BlockDesign::placed(const std::string& name) {
  const auto known = placed_.find(name);
  if (known != placed_.end()) return known->second;
  const PlacedPart& part = *design_.part(name);
  if (std::find(being_placed_.begin(), being_placed_.end(), name) != being_placed_.end())
    throw vp::InputError(part.place + ": the clock of " + name + " is made from itself");
  being_placed_.push_back(name);
  const Placement placement{part,
                            ports_,
                            design_,
                            [this, &part](const std::string& pin) -> vp::Clock* {
                              const auto source = part.pins.find(pin);
                              return source == part.pins.end() ? nullptr : clock_of(source->second);
                            },
                            [this](const End& source) { return clock_of(source); },
                            adapters_};
  Placed made = name == ps_ ? place_processing_system(part) : place_part(placement);
  being_placed_.pop_back();
  order_.push_back(name);
  return placed_.emplace(name, std::move(made)).first->second;
}

Placed BlockDesign::place_processing_system(const PlacedPart& part) {
  Placed placed;
  ProcessingSystem& ps = ports_.ps;
  for (unsigned n = 0; n < 4; ++n) {
    const std::string number = std::to_string(n);
    const bool asked_for =
        n < 2 ||
        std::any_of(design_.settings.begin(), design_.settings.end(), [&](const auto& setting) {
          return setting.first == "ps.fclk_clk" + number + ".frequency";
        });
    if (asked_for) placed.clocks["FCLK_CLK" + number] = &ports_.fclk_clk(n);
  }
  placed.outputs = {
      {"FCLK_RESET0_N", &ps.slcr.fclk_reset0_n}, {"FCLK_RESET1_N", &ps.slcr.fclk_reset1_n},
      {"FCLK_RESET2_N", &ps.slcr.fclk_reset2_n}, {"FCLK_RESET3_N", &ps.slcr.fclk_reset3_n},
      {"GPIO_O", &ps.gpio.emio_gpio_o},          {"GPIO_T", &ps.gpio.emio_gpio_t}};
  placed.inputs["GPIO_I"] = [this, &part](vp::SignalBase& source) {
    auto pins = std::make_unique<xilinx::WireAdapter<std::uint64_t>>(
        (part.name + "_GPIO_I").c_str(), source);
    ports_.ps.gpio.emio_gpio_i(pins->out);
    adapters_.push_back(std::move(pins));
  };
  placed.inputs["IRQ_F2P"] = [this, &part](vp::SignalBase& source) {
    auto lines = std::make_unique<xilinx::WireAdapter<std::uint32_t>>(
        (part.name + "_IRQ_F2P").c_str(), source);
    ports_.irq_f2p(lines->out);
    adapters_.push_back(std::move(lines));
  };
  for (const auto& [pin, id] :
       {std::pair{"Core0_nFIQ", gic::n_fiq_id}, {"Core0_nIRQ", gic::n_irq_id}}) {
    const std::string name = part.name + "_" + pin;
    placed.inputs[pin] = [this, name, number = id](vp::SignalBase& source) {
      auto line = std::make_unique<xilinx::WireAdapter<bool>>(name.c_str(), source);
      ports_.ps.connect(number, line->out);
      adapters_.push_back(std::move(line));
    };
  }
  placed.masters["M_AXI_GP0"] = {[this](vp::Router& way) { ports_.m_axi_gp0(way); }};
  placed.masters["M_AXI_GP1"] = {[this, &part](vp::Router& way) {
    const auto clock = part.pins.find("M_AXI_GP1_ACLK");
    vp::Clock* aclk = clock == part.pins.end() ? nullptr : clock_of(clock->second);
    if (!aclk) refuse({part.name, "M_AXI_GP1_ACLK", part.place}, "has no clock");
    ports_.m_axi_gp1(way, *aclk);
  }};
  for (const char* port : {"S_AXI_HP0", "S_AXI_HP1", "S_AXI_HP2", "S_AXI_HP3", "S_AXI_GP0",
                           "S_AXI_GP1", "S_AXI_ACP"}) {
    placed.slaves[port] = {[&ps](RegionSocket& socket) { socket.bind(ps.s_axi_hp0.socket); }, true};
  }
  for (const auto& [pin, source] : part.pins) {
    if (placed.inputs.count(pin) != 0) continue;
    placed.unused_inputs.insert(pin);
    if (pin == "Core1_nFIQ" || pin == "Core1_nIRQ") tell_of_lost_interrupt(pin, source);
  }
  return placed;
}

/// Private interrupts of core 1 are not modelled. A constant at the pin needs no warning.
void BlockDesign::tell_of_lost_interrupt(const std::string& pin, const End& source) {
  const PlacedPart* driver = design_.part(source.part);
  const IpRule* rule = driver ? driver->rule() : nullptr;
  if (rule && rule->ip == "xlconstant") return;
  lacking_.push_back(ps_ + "." + pin);
  vp::warn(*this, "/markervp/block_design/interrupt",
           source.place + ": '" + ps_ + "." + pin + "' is not modelled: interrupts of '" +
               source.text() + "' never come, and verdicts that rest on them are unknown; " +
               "IRQ_F2P reaches both cores");
}

vp::Clock* BlockDesign::clock_of(const End& source) {
  if (source.part == "external") return external_.at(source.port)->clk.get();
  const PlacedPart& part = *design_.part(source.part);
  // Known before it is placed: stubs and RTL may drive each other in a ring.
  const bool drives_wires = part.is_stub() || !part.rtl.empty();
  if (drives_wires && part.clocks.count(source.port) == 0) return nullptr;
  // Block memory has the clock of the logic at its ports, which it drives.
  if (!drives_wires && part.rule() && part.rule()->ip == "blk_mem_gen") return nullptr;
  Placed& driver = placed(source.part);
  const auto found = driver.clocks.find(source.port);
  return found == driver.clocks.end() ? nullptr : found->second;
}

// What the platform does not model of the PS drives 0, and of other IP its idle level.
vp::SignalBase& BlockDesign::signal_of(const End& source) {
  if (source.part == "external") return external_.at(source.port)->pin;
  Placed& driver = placed(source.part);
  const auto found = driver.outputs.find(source.port);
  if (found != driver.outputs.end()) return *found->second;
  if (driver.any_output) return *driver.any_output(source.port);
  const IpRule* rule = design_.part(source.part)->rule();
  if (source.part != ps_ && (!rule || !lacks_output(*rule, source.port))) {
    std::vector<std::string> names;
    for (const auto& [name, signal] : driver.outputs) names.push_back(name);
    refuse(source, "is no output of " + source.part, names);
  }
  auto& tied = tied_[source.text()];
  if (!tied) tied = tie(source);
  return *tied;
}

std::unique_ptr<vp::Signal<std::uint64_t>> BlockDesign::tie(const End& source) {
  const std::string name = "tied_" + source.part + "_" + source.port;
  auto tied = std::make_unique<vp::Signal<std::uint64_t>>(name.c_str(), 64u);
  if (source.part == ps_) return tied;
  const bool high = idles_high(source.port);
  *tied = high ? 1 : 0;
  lacking_.push_back(source.text());
  vp::warn(*this, "/markervp/block_design/output",
           "'" + source.text() + "' is not modelled: it stays " + (high ? "1" : "0") +
               ", and verdicts that rest on it are unknown");
  return tied;
}

void BlockDesign::join_pins(const PlacedPart& part) {
  Placed& here = placed(part.name);
  if (!here.object && part.name != ps_) return;
  for (const auto& [pin, source] : part.pins) {
    if (clock_of(source) || here.unused_inputs.count(pin) != 0 || here.any_output) continue;
    const auto input = here.inputs.find(pin);
    if (input != here.inputs.end()) {
      input->second(signal_of(source));
      continue;
    }
    if (is_bus(part.name)) continue;  // resets of interconnects
    std::vector<std::string> names;
    for (const auto& [name, join] : here.inputs) names.push_back(name);
    refuse({part.name, pin, source.place}, "is no input of " + part.vlnv, names);
  }
  for (const auto& [pin, join] : here.inputs) {
    if (here.open_input && part.pins.count(pin) == 0) here.open_input(pin);
  }
}

// Each counts its bits with its own clock: what has another rate would read others.
void BlockDesign::join_serial_lines() {
  for (const PlacedPart& part : design_.parts) {
    xilinx::AxiUartlite* receiver = placed(part.name).serial;
    const PlacedPart* driver = receiver ? serial_driver(design_, part) : nullptr;
    if (!driver) continue;
    xilinx::AxiUartlite& sender = *placed(driver->name).serial;
    if (!sender.understands(*receiver)) {
      refuse(part.pins.at("rx"),
             "and " + part.name + ".rx have other baud rates or formats: give both the same");
    }
    sender.connect(*receiver);
  }
}

// A port of a memory at a controller is what software sees of it.
void BlockDesign::join_memories() {
  for (const PlacedPart& part : design_.parts) {
    xilinx::BlkMemGen* memory = placed(part.name).memory;
    if (!memory) continue;
    for (const PlacedPart* controller : controllers_of(design_, part))
      memory->share(*placed(controller->name).controller);
  }
}

bool BlockDesign::is_bus(const std::string& name) const {
  const PlacedPart* part = design_.part(name);
  const IpRule* rule = part ? part->rule() : nullptr;
  return rule && rule->kind == Kind::bus;
}

// A bus that no segment of addresses goes through is a stream, if one of its ends says so.
void BlockDesign::join_streams() {
  for (const PlacedPart& part : design_.parts) {
    Placed& here = placed(part.name);
    for (const auto& [bus, master] : part.buses) {
      Placed& there = placed(master.part);
      const bool is_stream =
          here.stream_slaves.count(bus) != 0 || there.stream_masters.count(master.port) != 0;
      if (is_stream) join_stream(master, {part.name, bus, master.place});
    }
  }
}

vp::AxiStream& BlockDesign::make_stream(const End& master) {
  return streams_.emplace_back((master.part + "_" + master.port).c_str());
}

void BlockDesign::join_stream(const End& master, const End& slave) {
  const auto port = [this](const End& end, std::map<std::string, StreamPort>& known,
                           const auto& any) -> StreamPort {
    const auto found = known.find(end.port);
    if (found != known.end()) return found->second;
    if (any) return any(end.port);
    std::vector<std::string> names;
    names.reserve(known.size());
    for (const auto& [name, stream] : known) names.push_back(name);
    refuse(end, "is no stream of " + design_.part(end.part)->vlnv, names);
  };
  Placed& source = placed(master.part);
  Placed& sink = placed(slave.part);
  const StreamPort from = port(master, source.stream_masters, source.any_stream_master);
  const StreamPort to = port(slave, sink.stream_slaves, sink.any_stream_slave);
  if (from.clock && to.clock && from.clock != to.clock) {
    refuse(slave, "and " + master.text() +
                      " have different clocks: put an AXI4-Stream clock "
                      "converter between them");
  }
  vp::Clock& clock = from.clock ? *from.clock : to.clock ? *to.clock : ports_.fclk_clk(0);
  if (from.bytes != 0 && to.bytes != 0 && from.bytes != to.bytes) {
    refuse(slave, "takes beats of " + std::to_string(to.bytes) + " bytes, and " + master.text() +
                      " sends " + std::to_string(from.bytes) + ": put a width converter between");
  }
  vp::AxiStream& link = make_stream(master);
  from.bind(link, clock);
  to.bind(link, clock);
  streams_joined_[master.text()] = streams_joined_[slave.text()] = true;
}

// Nothing comes from an open input, and an open output is never ready.
void BlockDesign::close_open_streams() {
  for (auto& [name, part] : placed_) {
    for (auto& [bus, port] : part.stream_masters) {
      if (streams_joined_.count(name + "." + bus) != 0) continue;
      vp::AxiStream& link = make_stream({name, bus, ""});
      port.bind(link, *port.clock);
      auto& end = blocked_.emplace_back((name + "_" + bus + "_open").c_str(), *port.clock);
      end.ready_on = [](std::uint64_t) { return false; };
      end.s_axis(link);
    }
    for (auto& [bus, port] : part.stream_slaves) {
      if (streams_joined_.count(name + "." + bus) != 0) continue;
      vp::AxiStream& link = make_stream({name, bus, ""});
      silent_.emplace_back((name + "_" + bus + "_open").c_str(), *port.clock).m_axis(link);
      port.bind(link, *port.clock);
    }
  }
}

std::vector<std::string> BlockDesign::used_stubs() const {
  std::vector<std::string> names = lacking_;
  for (const auto* stub : vp::all_below<xilinx::RegisterStub>(*this))
    if (stub->used()) names.emplace_back(stub->basename());
  return names;
}

namespace {

/// Parameters of a part that are the platform's, too. Its RTL was built with its own.
void add_settings(const PlacedPart& part, DesignInfo& info) {
  const IpRule* rule = part.rule();
  for (const auto& [name, value] : part.parameters) {
    const ParameterRule* known = rule ? find_parameter(*rule, name) : nullptr;
    if (known && !known->sets.empty())
      info.defaults.emplace_back("pl." + part.name + "." + known->sets, unquoted(value));
  }
}

}  // namespace

DesignInfo load(const std::string& file) {
  const auto design = std::make_shared<const DesignFile>(read_design_file(file));
  DesignInfo info;
  info.name = design->name;
  info.description = "the block design of " + file;
  info.programs = design->programs;
  info.defaults = design->settings;
  for (const PlacedPart& part : design->parts) add_settings(part, info);
  info.make = [design](const char* name, PlPorts& ports) -> std::unique_ptr<Design> {
    return std::make_unique<BlockDesign>(name, ports, *design);
  };
  return info;
}

}  // namespace platform::block_design
