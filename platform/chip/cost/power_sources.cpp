#include <chip/cost/power_sources.h>

#include <algorithm>
#include <string>
#include <utility>

#include <chip/cost/clock_report.h>
#include <chip/system/design.h>
#include <fpga/power/design_estimate.h>
#include <vp/ip.h>
#include <xilinx/axi_dma/dma_channel.h>

namespace platform {

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
    for (const Design::ClockRole& role : zynq_.design().clock_roles()) add_clock_net(role, parts);
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

  void add_clock_net(const Design::ClockRole& role, const std::vector<Part>& parts) {
    double ff = 0;
    for (const Part& ip : parts) {
      if (ip.clock == role.clock) ff += ip.estimate.ff;
    }
    add("pl.clocks." + role.role, role.group, "Vccint", PowerKind::clock, origin("pl.clock_root"),
        power::clock_net_energy(table_, ff), &states_.pl_clock(*role.clock).hz);
  }

  void add_ip(const Part& ip) {
    const vp::IpEstimate& e = ip.estimate;
    const Band clock = power::clock_energy(table_, e.ff);
    add(ip.module, ip.group, "Vccint", PowerKind::clock, origin("pl.clock"), clock,
        &states_.pl_clock(*ip.clock).hz);
    if (by_activity_ && e.foreign.toggles.bits != 0) return add_simulated(ip);
    const std::string coefficient = logic_coefficient(ip);
    add_activity(ip, "Vccint", coefficient, logic(ip, coefficient, clock));
    if (e.dsp != 0) add_activity(ip, "Vccint", "pl.dsp", power::dsp_energy(table_, e.dsp));
    if (e.bram36 > 0) add_block_memory(ip);
  }

  /// RTL of which nothing but its signals says when it works: by their changes, multipliers and
  /// memories by the clocks in which there are as many as usual.
  void add_simulated(const Part& ip) {
    const vp::IpEstimate& e = ip.estimate;
    const auto& toggles = e.foreign.toggles;
    toggles.begin();
    add(ip.module, ip.group, "Vccint", PowerKind::event, origin("pl.logic_simulated"),
        power::change_energy(table_, e.lut, e.ff, static_cast<double>(toggles.bits)), nullptr,
        toggles.changes);
    if (e.dsp != 0)
      add(ip.module, ip.group, "Vccint", PowerKind::event, origin("pl.dsp_busy"),
          power::dsp_energy(table_, e.dsp, "pl.dsp_busy"), nullptr, toggles.busy_clocks);
    if (e.bram36 > 0)
      add(ip.module, ip.group, "Vccbram", PowerKind::event, origin("pl.bram"),
          power::block_memory_energy(table_, e.bram36), nullptr, toggles.busy_clocks);
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

}  // namespace platform
