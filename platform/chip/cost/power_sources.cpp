#include <chip/cost/power_sources.h>

#include <chip/cost/parts.h>
#include <chip/system/design.h>
#include <fpga/power/design_estimate.h>
#include <vp/error.h>
#include <vp/ip.h>
#include <vp/systemc_pins.h>
#include <xilinx/axi_dma/dma_channel.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

namespace platform {

PowerOptions::PowerOptions(bool uses_pl, PowerMode usual, Design& design)
    : mode("mode", usual,
           {{"vivado-default", PowerMode::vivado_default}, {"activity", PowerMode::activity}},
           vp::Source::decision,
           "what is estimated: as the vendor's tool does by default (reproduces the thesis' 1.5 W "
           "and 0.4 W), or by load, traffic and events of the simulation"),
      table("table", "zynq7020", vp::Source::decision,
            "coefficients: the name of an installed table, or a file .json"),
      ambient("ambient", 25, vp::Unit::temperature, {-40, 100}, vp::Source::published,
              "temperature around the board (default of the vendor's estimates)"),
      theta_ja(
          "theta_ja", 11.5, vp::Unit::none, {0, 100}, vp::Source::published,
          "how much hotter the junction gets, C/W (vendor's estimates: medium board, 250 LFM)"),
      pl_design("pl_design", uses_pl, vp::Source::decision,
                "whether the PL holds the design; a system without it leaves the PL unconfigured") {
  mode.follows("camera.rate");
  pl_design.follows("design");
  design.add_power_options();
}

PowerOptions::Ddr::Ddr(sc_core::sc_module_name name)
    : sc_module(name),
      width("width", 32, vp::Unit::none, {16, 32}, vp::Source::published,
            "data lines to the DDR chips, 16 or 32 (ZedBoard: 32)"),
      frequency("frequency", 533'333'333, vp::Unit::frequency, {200'000'000, 533'333'334},
                vp::Source::published, "memory clock; two transfers a clock"),
      voltage("voltage", 1.5, vp::Unit::voltage, {1.35, 1.5}, vp::Source::published,
              "supply of the DDR lines: 1.5 V, or 1.35 V for DDR3L") {
  if (width == 16 || width == 32) return;
  throw vp::InputError(std::string(width.name()) + " is " + std::to_string(width) +
                       ": give 16 or 32");
}

namespace {

double hz(const vp::Clock& clock) {
  return static_cast<double>(clock.frequency_hz());
}

}  // namespace

PowerStates::PowerStates(Zynq& zynq)
    : cpu_hz(hz(zynq.ps.cpu_clk.clk)),
      cpu_awake_hz(hz(zynq.ps.cpu_clk.clk)),
      zynq_(zynq),
      busy_(zynq.design().busy()),
      fastest_cpu_hz_(zynq.ps.cpu_clk.clk.frequency_hz()) {
  zynq.ps.cpu_clk.clk.add_listener(*this);
  for (const auto& [number, source] : zynq.ps.fclks()) {
    source->clk.add_listener(*this);
    add_pl_clock(source->clk, false);
  }
  for (const Design::ClockRole& role : zynq.design().clock_roles()) {
    if (!knows(*role.clock)) add_pl_clock(*role.clock, true);
  }
  for (ps::Cpu* core : zynq.ps.cpus()) core->asleep.attach(*this);
  if (busy_) busy_->attach(*this);
}

PowerStates::~PowerStates() {
  for (ps::Cpu* core : zynq_.ps.cpus()) core->asleep.detach(*this);
  if (busy_) busy_->detach(*this);
}

unsigned PowerStates::awake_cores() const {
  const auto* second = zynq_.ps.second_core();
  return (zynq_.ps.cpu.asleep ? 0u : 1u) + (second && !second->cpu.asleep ? 1u : 0u);
}

std::uint64_t PowerStates::fastest_hz(const vp::Clock& clock) const {
  return &clock == &zynq_.ps.cpu_clk.clk ? fastest_cpu_hz_ : pl_clock(clock).fastest_hz;
}

void PowerStates::add_pl_clock(const vp::Clock& clock, bool external) {
  pl_clocks_.push_back({&clock, vp::PiecewiseConstant(hz(clock)),
                        vp::PiecewiseConstant(frame_runs() ? hz(clock) : 0), clock.frequency_hz(),
                        external});
}

bool PowerStates::knows(const vp::Clock& clock) const {
  return std::any_of(pl_clocks_.begin(), pl_clocks_.end(),
                     [&](const PlClock& known) { return known.clock == &clock; });
}

const PowerStates::PlClock& PowerStates::pl_clock(const vp::Clock& clock) const {
  for (const PlClock& known : pl_clocks_) {
    if (known.clock == &clock) return known;
  }
  throw std::logic_error(std::string(clock.name()) +
                         " is no clock that the PS makes for the PL, nor one of the design's");
}

// A core falls asleep and wakes with every burst of an upload: nothing else is looked at.
void PowerStates::on_change(vp::SignalBase& signal, std::uint32_t) {
  if (&signal == busy_) return update();
  const std::uint64_t now = zynq_.scheduler.now_ps();
  cpu_awake_hz.set(now, awake_cores() * hz(zynq_.ps.cpu_clk.clk));
  if (observer_) observer_->states_changed(now);
}

void PowerStates::update() {
  const std::uint64_t now = zynq_.scheduler.now_ps();
  const double cpu = hz(zynq_.ps.cpu_clk.clk);
  fastest_cpu_hz_ = std::max(fastest_cpu_hz_, zynq_.ps.cpu_clk.clk.frequency_hz());
  cpu_hz.set(now, cpu);
  cpu_awake_hz.set(now, awake_cores() * cpu);
  for (PlClock& pl : pl_clocks_) {
    pl.hz.set(now, hz(*pl.clock));
    pl.frame_hz.set(now, frame_runs() ? hz(*pl.clock) : 0);
    pl.fastest_hz = std::max(pl.fastest_hz, pl.clock->frequency_hz());
  }
  if (observer_) observer_->states_changed(now);
}

template <class Visit>
void PowerStates::for_each_history(Visit visit) {
  visit(cpu_hz);
  visit(cpu_awake_hz);
  for (PlClock& pl : pl_clocks_) {
    visit(pl.hz);
    visit(pl.frame_hz);
  }
}

std::vector<std::uint64_t> PowerStates::changes(std::uint64_t from_ps, std::uint64_t to_ps) {
  std::vector<std::uint64_t> times;
  for_each_history([&](const vp::PiecewiseConstant& history) {
    for (const auto& step : history.steps()) {
      if (step.ps > from_ps && step.ps < to_ps) times.push_back(step.ps);
    }
  });
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

void PowerStates::forget_before(std::uint64_t ps) {
  for_each_history([ps](vp::PiecewiseConstant& history) { history.forget_before(ps); });
}

namespace {

using power::nano;
using power::pico;
using power::PowerTable;
using vp::Band;
using vp::PowerKind;

constexpr double line_bytes = 32;      // of the L2 cache
constexpr double hp_port_bytes = 8;    // a beat
constexpr double hp_port_usage = 0.5;  // at which its coefficient was read

/// What the memory masters of the PL write, which goes past the DDR's own counters where it is
/// direct access. Their reads only upload inputs here, which is no unit's work.
class Written {
 public:
  explicit Written(const Zynq& zynq) {
    for (const auto* port : vp::all_below<xilinx::MemoryPort>(zynq.pl()))
      links_.push_back(&port->link);
  }
  double bytes() const {
    std::uint64_t sum = 0;
    for (const vp::MmLink* link : links_) sum += link->bytes_written;
    return static_cast<double>(sum);
  }

 private:
  std::vector<const vp::MmLink*> links_;
};

class Builder {
 public:
  Builder(Zynq& zynq, const PowerOptions& options, const PowerTable& table,
          const PowerStates& states)
      : zynq_(zynq),
        options_(options),
        table_(table),
        states_(states),
        written_(zynq),
        by_activity_(options.mode == PowerMode::activity) {}

  void add_processing_system() {
    add_cores();
    state("ps.uncore", "Vccpint", wide("ps.uncore_"));
    state("ps.pll", "Vccpll", "ps.pll");
    state("ps.aux", "Vccpaux", wide("ps.aux_"));
    state("ps.mio", "Vcco_mio", "ps.mio");
    add_ddr();
  }

  void add_design(const std::vector<Part>& parts) {
    for (const Part& ip : parts) add_ip(ip);
    for (const Design::ClockRole& role : zynq_.design().clock_roles()) add_clock_root(role);
    add_hp_port();
  }

  std::vector<vp::PowerSource> take() { return std::move(sources_); }

 private:
  std::string wide(const std::string& name) const {
    return power::of_width(name, options_.ddr.width);
  }
  std::string origin(const std::string& coefficient) const {
    const power::Coefficient& entry = table_.at(coefficient);
    return coefficient + " (" + entry.status + ")";
  }

  void add(const std::string& module, const std::string& group, const std::string& rail,
           PowerKind kind, const std::string& source, const Band& joules,
           const vp::PiecewiseConstant* state, std::function<double()> count = nullptr) {
    sources_.push_back({module, group, rail, kind, source, joules, state, std::move(count),
                        power::cause_of(source.substr(0, source.find(' ')))});
  }
  void state(const std::string& module, const std::string& rail, const std::string& coefficient) {
    add(module, "ps", rail, PowerKind::state, origin(coefficient), table_.value(coefficient),
        &states_.always);
  }

  // Vendor: two cores are busy half of the time, also on a device that has one. Activity: a core is
  // busy while its program does not wait for an interrupt or an event; core 1 sleeps in WFE until
  // it is started.
  void add_cores() {
    const Band cycle = table_.value("ps.core_cycle") * nano;
    if (by_activity_) {
      add("ps.cores", "ps", "Vccpint", PowerKind::state, origin("ps.core_cycle"), cycle,
          &states_.cpu_awake_hz);
    } else {
      add("ps.cores", "ps", "Vccpint", PowerKind::state, origin("ps.core_cycle"),
          cycle * table_.value("ps.default_load") * power::default_cores(table_), &states_.cpu_hz);
    }
  }

  Band full_ddr() const {
    return power::ddr_io_power(table_, {options_.ddr.width, ddr_mhz(), options_.ddr.voltage});
  }
  double ddr_mhz() const {
    return static_cast<double>(ddr_hz(zynq_, options_)) / device::hz_per_mhz;
  }

  void add_ddr() {
    const std::string source = origin(wide("ps.ddr_current_"));
    if (!by_activity_) {
      add("ps.ddr_io", "ps", "Vcco_ddr", PowerKind::state, source, full_ddr(), &states_.always);
      return;
    }
    const Band& idle = table_.value("ps.ddr_idle_share");
    const Band busy{1 - idle.low, 1 - idle.nominal, 1 - idle.high};
    const double most_bytes_per_s =
        2.0 * static_cast<double>(ddr_hz(zynq_, options_)) * options_.ddr.width / 8;
    add("ps.ddr_io", "ps", "Vcco_ddr", PowerKind::state, origin("ps.ddr_idle_share"),
        full_ddr() * idle, &states_.always);
    const double stall_ns = table_.value("ps.ddr_line_stall").nominal;
    add("ps.ddr_io", "ps", "Vcco_ddr", PowerKind::event, source,
        full_ddr() * busy * (1 / most_bytes_per_s), nullptr,
        [&zynq = zynq_, written = written_, stall_ns] {
          return written.bytes() + missed_bytes(zynq, stall_ns);
        });
  }

  /// What cache misses moved.
  static double missed_bytes(Zynq& zynq, double stall_ns_per_line) {
    double stalls_ns = 0;
    for (const ps::Cpu* core : zynq.ps.cpus()) {
      for (const ps::WorkCount& work : core->work().counts())
        stalls_ns += work.stall_ns * static_cast<double>(work.count);
    }
    const double lines = stall_ns_per_line > 0 ? stalls_ns / stall_ns_per_line : 0;
    return lines * line_bytes;
  }

  void add_hp_port() {
    const Band clock = table_.value("ps.hp_port") * nano;
    if (!by_activity_) {
      add("ps.s_axi_hp0", "ps", "Vccpint", PowerKind::state, origin("ps.hp_port"), clock,
          &states_.pl_clock(zynq_.ps.fclk_clk0.clk).hz);
      return;
    }
    add("ps.s_axi_hp0", "ps", "Vccpint", PowerKind::event, origin("ps.hp_port"),
        clock * (1 / (hp_port_usage * hp_port_bytes)), nullptr,
        [written = written_] { return written.bytes(); });
  }

  void add_clock_root(const Design::ClockRole& role) {
    add("pl.clocks." + role.role, role.group, "Vccint", PowerKind::clock, origin("pl.clock_root"),
        power::clock_root_energy(table_), &states_.pl_clock(*role.clock).hz);
  }

  void add_ip(const Part& ip) {
    const vp::IpEstimate& e = ip.estimate;
    const Band clock = power::clock_energy(table_, e.ff);
    add(ip.module, ip.group, "Vccint", PowerKind::clock, origin("pl.clock"), clock,
        &states_.pl_clock(*ip.clock).hz);
    const std::string coefficient = logic_coefficient(ip);
    add_activity(ip, "Vccint", coefficient, logic(ip, coefficient, clock));
    if (e.dsp != 0) add_activity(ip, "Vccint", "pl.dsp", power::dsp_energy(table_, e.dsp));
    if (e.bram36 > 0) add_block_memory(ip);
  }

  /// The coefficient of an IP that has one of its own; else that of logic in general.
  std::string logic_coefficient(const Part& ip) const {
    const std::string own = "ip." + ip.estimate.kind;
    if (zynq_.design().has_net_figures() && has(own + "_net")) return own + "_net";
    return has(own) ? own : "pl.logic";
  }

  bool has(const std::string& coefficient) const {
    const auto& entries = table_.entries();
    return std::any_of(entries.begin(), entries.end(),
                       [&](const power::Coefficient& entry) { return entry.name == coefficient; });
  }

  /// Energy of a clock in which the logic works. A coefficient of an IP is for all of it.
  Band logic(const Part& ip, const std::string& coefficient, const Band& clock) const {
    if (coefficient == "pl.logic")
      return power::logic_energy(table_, ip.estimate.lut, ip.estimate.ff);
    const Band value = table_.value(coefficient) * nano * ip.estimate.size - clock;
    if (!ip.estimate.includes_memory) return value;
    return value - power::block_memory_energy(table_, ip.estimate.bram36);
  }

  void add_activity(const Part& ip, const char* rail, const std::string& coefficient,
                    const Band& joules) {
    const PowerStates::PlClock& clock = states_.pl_clock(*ip.clock);
    if (!by_activity_) {
      add(ip.module, ip.group, rail, PowerKind::state, origin(coefficient), joules, &clock.hz);
    } else if (ip.estimate.active_clocks) {
      const auto& clocks = ip.estimate.active_clocks;
      add(ip.module, ip.group, rail, PowerKind::event, origin(coefficient), joules, nullptr,
          [clocks] { return static_cast<double>(clocks()); });
    } else {
      add(ip.module, ip.group, rail, PowerKind::state, origin(coefficient), joules,
          &clock.frame_hz);
    }
  }

  // As its logic does, if it does not count its reads.
  void add_block_memory(const Part& ip) {
    if (by_activity_ && ip.estimate.memory_reads) {
      const auto& reads = ip.estimate.memory_reads;
      add(ip.module, ip.group, "Vccbram", PowerKind::event, origin("pl.bram_read"),
          table_.value("pl.bram_read") * pico, nullptr,
          [reads] { return static_cast<double>(reads()); });
      return;
    }
    add_activity(ip, "Vccbram", "pl.bram", power::block_memory_energy(table_, ip.estimate.bram36));
  }

  Zynq& zynq_;
  const PowerOptions& options_;
  const PowerTable& table_;
  const PowerStates& states_;
  const Written written_;
  const bool by_activity_;
  std::vector<vp::PowerSource> sources_;
};

}  // namespace

std::vector<vp::PowerSource> power_sources(Zynq& zynq, const PowerOptions& options,
                                           const PowerTable& table, const std::vector<Part>& parts,
                                           const PowerStates& states) {
  Builder builder(zynq, options, table, states);
  builder.add_processing_system();
  if (options.pl_design) builder.add_design(parts);
  return builder.take();
}

namespace {

using device::ClockKind;
using facts::ClockReport;

device::MadeClock made_ddr(const Zynq& zynq, const PowerOptions& options) {
  const auto wish_hz = static_cast<double>(options.ddr.frequency);
  return zynq.ps.clock_planner().own_pll(wish_hz, ClockKind::ddr);
}

/// A clock that was asked for, what is made of that, and the highest frequency that it had.
struct Use {
  std::string name;
  ClockKind kind;
  std::uint64_t wish_hz;
  device::MadeClock made;
  std::uint64_t fastest_hz;
};

void add_verdict(ClockReport::Clock& clock, const device::ClockVerdict& verdict) {
  clock.limit_mhz = verdict.limit_hz / device::hz_per_mhz;
  clock.limit_confidence = to_string(verdict.confidence);
  clock.margin_percent = verdict.margin_percent;
  clock.within = verdict.within;
  clock.makeable = verdict.makeable;
}

ClockReport::Clock judged(const ProcessingSystem& ps, const Use& use) {
  const device::MadeClock& made = use.made;
  const auto wish_hz = static_cast<double>(use.wish_hz), hz = static_cast<double>(use.fastest_hz);
  ClockReport::Clock clock;
  clock.name = use.name;
  clock.wish_mhz = wish_hz / device::hz_per_mhz;
  clock.frequency_mhz = hz / device::hz_per_mhz;
  clock.made_mhz = made.hz / device::hz_per_mhz;
  clock.pll = to_string(made.pll);
  clock.vco_mhz = made.vco_hz / device::hz_per_mhz;
  clock.feedback = made.feedback;
  clock.divisor0 = made.divisor0;
  clock.divisor1 = made.divisor1;
  clock.is_made = device::same_frequency(made.hz, wish_hz);
  const auto near = ps.clock_planner().neighbours(wish_hz, use.kind, ps.clock_plan());
  if (near.below) clock.below_mhz = near.below->hz / device::hz_per_mhz;
  if (near.above) clock.above_mhz = near.above->hz / device::hz_per_mhz;
  const device::ClockVerdict verdict = judge(ps.clock_planner(), use.kind, hz);
  add_verdict(clock, verdict);
  if (!verdict.within) {
    const auto legal = ps.clock_planner().neighbours(verdict.limit_hz, use.kind, ps.clock_plan());
    if (legal.below) clock.legal_mhz = legal.below->hz / device::hz_per_mhz;
  }
  return clock;
}

/// The clocks that something in the configured PL runs on.
class UsedClocks {
 public:
  UsedClocks(Zynq& zynq, const PowerOptions& options, const std::vector<Part>& parts) {
    if (!options.pl_design) return;
    for (const Part& part : parts) clocks_.insert(part.clock);
    for (const Design::ClockRole& role : zynq.design().clock_roles()) clocks_.insert(role.clock);
    for (const vp::Clocked* module : vp::all_below<vp::Clocked>(zynq.pl()))
      clocks_.insert(&module->clock().source());
    // What foreign modules take from a pin is unknown.
    all_ = !vp::all_objects<vp::ClockPin>().empty();
  }
  bool has(const vp::Clock& clock) const { return all_ || clocks_.count(&clock) != 0; }

 private:
  std::set<const vp::Clock*> clocks_;
  bool all_ = false;
};

/// Of a clock that comes in at a pin.
ClockReport::Clock judged(const ProcessingSystem& ps, const PowerStates::PlClock& external) {
  const auto hz = static_cast<double>(external.fastest_hz);
  ClockReport::Clock clock;
  clock.name = name_of(*external.clock);
  clock.wish_mhz = clock.frequency_mhz = clock.made_mhz = hz / device::hz_per_mhz;
  clock.external = true;
  add_verdict(clock, judge(ps.clock_planner(), ClockKind::external, hz));
  return clock;
}

}  // namespace

std::uint64_t ddr_hz(const Zynq& zynq, const PowerOptions& options) {
  if (!zynq.ps.clocks_are_made()) return options.ddr.frequency;
  return static_cast<std::uint64_t>(std::llround(made_ddr(zynq, options).hz));
}

facts::ClockReport clock_report(Zynq& zynq, const PowerOptions& options, const PowerStates& states,
                                const std::vector<Part>& parts) {
  ProcessingSystem& ps = zynq.ps;
  const UsedClocks used(zynq, options, parts);
  ClockReport report;
  report.device = zynq.chip.data.name();
  report.mode = zynq.chip.clocks.text();
  const auto add = [&](const auto& use, bool is_used = true) {
    report.clocks.push_back(judged(ps, use));
    ClockReport::Clock& clock = report.clocks.back();
    clock.used = is_used;
    report.legal = report.legal && (!is_used || (clock.within && clock.makeable));
  };
  const auto add_source = [&](const ClockSource& source, ClockKind kind,
                              const device::MadeClock& made, bool is_used = true) {
    add(Use{source.name(), kind, source.frequency, made, states.fastest_hz(source.clk)}, is_used);
  };
  add_source(ps.cpu_clk, ps.slcr.ratio_621() ? ClockKind::cpu_621 : ClockKind::cpu_421,
             ps.clock_plan().cpu);
  auto made = ps.clock_plan().fclk.begin();
  for (const auto& [number, source] : ps.fclks())
    add_source(*source, ClockKind::fclk, *made++, used.has(source->clk));
  for (const PowerStates::PlClock& clock : states.pl_clocks()) {
    if (clock.external) add(clock);
  }
  add(Use{"power.ddr", ClockKind::ddr, options.ddr.frequency, made_ddr(zynq, options),
          ddr_hz(zynq, options)});
  return report;
}

}  // namespace platform
