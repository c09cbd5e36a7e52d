#include <chip/cost/zynq_power.h>

#include <algorithm>

#include <chip/cost/clock_report.h>
#include <chip/cost/parts.h>
#include <chip/cost/power_sources.h>
#include <fpga/power/design_estimate.h>

namespace platform {

namespace {

/// As the design orders those of its parts, between the PS and what leaks.
std::vector<std::string> groups_of(Design& design, const std::vector<Part>& parts) {
  std::vector<std::string> groups{"ps"};
  const auto add = [&groups](const std::string& group) {
    if (std::find(groups.begin(), groups.end(), group) == groups.end()) groups.push_back(group);
  };
  for (const std::string& group : design.groups()) add(group);
  for (const Part& part : parts) add(part.group);
  for (const Design::ClockRole& role : design.clock_roles()) add(role.group);
  groups.emplace_back("static");
  return groups;
}

double nominal(const std::map<std::string, vp::Band>& sums, const std::string& key) {
  const auto found = sums.find(key);
  return found == sums.end() ? 0 : found->second.nominal;
}

bool inside(std::uint64_t ps, const std::vector<vp::Interval>& intervals) {
  return std::any_of(intervals.begin(), intervals.end(),
                     [ps](const vp::Interval& i) { return i.from_ps <= ps && ps < i.to_ps; });
}

double memories_of(const std::vector<Part>& parts) {
  double bram36 = 0;
  for (const Part& part : parts) bram36 += part.estimate.bram36;
  return bram36;
}

constexpr double mj_per_j = 1e3;

}  // namespace

ZynqPower::ZynqPower(sc_core::sc_module_name name, Zynq& zynq, bool uses_pl, PowerMode usual)
    : sc_module(name),
      options(uses_pl, usual, zynq.design()),
      zynq_(zynq),
      table_(power::PowerTable::load(options.table)),
      parts_(parts_of(zynq.pl())),
      leaking_(power::leaking(zynq.chip.data, options.pl_design ? memories_of(parts_) : 0)),
      is_known_(!options.pl_design ||
                std::all_of(parts_.begin(), parts_.end(),
                            [](const Part& part) { return part.estimate.known; })),
      groups_(groups_of(zynq.design(), parts_)),
      states_(zynq) {
  for (vp::PowerSource& source : power_sources(zynq, options, table_, parts_, states_)) {
    meter_.add(std::move(source));
  }
  states_.set_observer(this);
  timeline_.groups = groups_;
  double junction_c = 0;
  static_w_ =
      power::static_energy(table_, leaking_, options.thermal_path(), meter_.power(0), 1, junction_c)
          .total()
          .nominal;
  show(0);
}

void ZynqPower::states_changed(std::uint64_t ps) {
  if (follows_) show(ps);
}

void ZynqPower::show(std::uint64_t now_ps) {
  double of_pl = 0;
  for (const std::string& group : groups_) {
    if (group != "ps" && group != "static") of_pl += meter_.watts(now_ps, group);
  }
  ps = meter_.watts(now_ps, "ps");
  pl = of_pl;
  static_power = static_w_;
  total = ps + pl + static_power;
}

vp::EnergyLedger ZynqPower::with_static(vp::EnergyLedger ledger, double seconds,
                                        double& junction_c) const {
  ledger.add(power::static_energy(table_, leaking_, options.thermal_path(),
                                  ledger.total() * (1 / seconds), seconds, junction_c));
  return ledger;
}

void ZynqPower::frame_ends(facts::UnitReport& frame) {
  const std::uint64_t from_ps = periods_.end_ps();
  const std::vector<vp::Interval> period = periods_.next(frame);
  const std::uint64_t end_ps = periods_.end_ps();
  double seconds = 0;
  for (const vp::Interval& interval : period) seconds += interval.seconds();
  const vp::EnergyLedger taken = meter_.measure(period);
  open_.add(taken);
  open_seconds_ += seconds;
  if (frame.delivered() && open_seconds_ > 0) deliver(frame);
  if (seconds <= 0) return;
  if (records_) record(taken, period, seconds, from_ps, end_ps);
  states_.forget_before(end_ps);
  if (follows_) show(end_ps);
}

/// All that was taken since the last result is this one's.
void ZynqPower::deliver(facts::UnitReport& frame) {
  double junction_c = 0;
  const vp::EnergyLedger ledger = with_static(open_, open_seconds_, junction_c);
  const auto sums = ledger.by_group();
  for (const std::string& group : groups_) {
    if (!is_known_) break;
    frame.energy.push_back({group, nominal(sums, group) * mj_per_j});
  }
  static_w_ = nominal(sums, "static") / open_seconds_;
  ledger_.add(ledger);
  seconds_ += open_seconds_;
  junction_seconds_ += junction_c * open_seconds_;
  ++results_;
  open_ = {};
  open_seconds_ = 0;
}

/// What flowed since the frame before, event energy spread over the period.
void ZynqPower::record(const vp::EnergyLedger& ledger, const std::vector<vp::Interval>& period,
                       double seconds, std::uint64_t from_ps, std::uint64_t to_ps) {
  std::vector<std::uint64_t> times = states_.changes(from_ps, to_ps);
  times.push_back(from_ps);
  for (const vp::Interval& interval : period) {
    times.push_back(interval.from_ps);
    times.push_back(interval.to_ps);
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  std::map<std::string, double> events_w;
  for (const vp::EnergyEntry& entry : ledger.entries()) {
    if (entry.kind == vp::PowerKind::event) events_w[entry.group] += entry.joules.nominal / seconds;
  }
  if (!timeline_.points.empty()) timeline_.points.pop_back();  // the end, which no longer counts
  for (const std::uint64_t ps : times) {
    PowerTimeline::Point point{ps, std::vector<double>(groups_.size(), 0)};
    for (std::size_t i = 0; i < groups_.size() && ps < to_ps; ++i) {
      const std::string& group = groups_[i];
      point.watts[i] = group == "static" ? static_w_ : meter_.watts(ps, group);
      if (inside(ps, period)) point.watts[i] += events_w[group];
    }
    timeline_.points.push_back(std::move(point));
  }
}

facts::PowerReport ZynqPower::power_report(std::uint64_t end_ps) const {
  vp::EnergyLedger whole = ledger_;
  double seconds = seconds_, junction_seconds = junction_seconds_;
  if (results_ == 0) {
    const vp::Interval run{0, std::max<std::uint64_t>(end_ps, 1)};
    const bool gave_up = open_seconds_ > 0;
    seconds = gave_up ? open_seconds_ : run.seconds();
    double junction_c = 0;
    whole = with_static(gave_up ? open_ : meter_.measure({run}), seconds, junction_c);
    junction_seconds = junction_c * seconds;
  }
  facts::PowerReport report;
  report.mode = options.mode.text();
  report.table = table_.name();
  report.ambient_c = options.ambient;
  report.junction_c = junction_seconds / seconds;
  const vp::Band total = whole.total();
  report.low_w = total.low / seconds;
  report.total_w = total.nominal / seconds;
  report.high_w = total.high / seconds;
  const auto sums = whole.by_group();
  report.ps_w = nominal(sums, "ps") / seconds;
  report.static_w = nominal(sums, "static") / seconds;
  for (const auto& [group, band] : sums) {
    if (group != "ps" && group != "static") report.pl_w += band.nominal / seconds;
  }
  for (const auto& [rail, band] : whole.by_rail()) report.rails[rail] = band.nominal / seconds;
  const double mj = results_ == 0 ? 0 : mj_per_j / static_cast<double>(results_);
  for (const vp::EnergyEntry& entry : whole.entries()) {
    report.modules.push_back({entry.module, entry.rail, vp::to_string(entry.kind),
                              entry.joules.nominal / seconds, entry.joules.nominal * mj,
                              entry.source});
  }
  report.activity = activity(whole);
  report.per_frame = results_ != 0;
  report.energy_per_frame_mj = total.nominal * mj;
  return report;
}

/// What a ledger has of RTL, taken back to changes and clocks.
std::vector<facts::PowerReport::Activity> ZynqPower::activity(
    const vp::EnergyLedger& ledger) const {
  std::vector<facts::PowerReport::Activity> found;
  for (const Part& part : parts_) {
    const vp::IpEstimate& e = part.estimate;
    const auto bits = static_cast<double>(e.foreign.toggles.bits);
    double changes = 0, clocks = 0;
    for (const vp::EnergyEntry& entry : ledger.entries()) {
      if (bits == 0 || e.lut == 0 || e.ff == 0 || entry.module != part.module) continue;
      const std::string coefficient = entry.source.substr(0, entry.source.find(' '));
      if (coefficient == "pl.logic_simulated")
        changes = entry.joules.nominal / power::change_energy(table_, e.lut, e.ff, bits).nominal;
      if (coefficient == "pl.clock")
        clocks = entry.joules.nominal / power::clock_energy(table_, e.ff).nominal;
    }
    if (clocks > 0 && options.mode == PowerMode::activity)
      found.push_back({part.module, changes / (bits * clocks), e.foreign.toggles.bits});
  }
  return found;
}

facts::ResourceReport ZynqPower::resource_report() const {
  return platform::resource_report(options.pl_design ? parts_ : std::vector<Part>{},
                                   zynq_.chip.data);
}

facts::ClockReport ZynqPower::clock_report() const {
  return platform::clock_report(zynq_, options, states_, parts_);
}

facts::TimingReport ZynqPower::timing_report(const TimingClosure& timing) const {
  if (!options.pl_design) return {};
  return timing.report([this](const vp::Clock& clock) { return states_.fastest_hz(clock); },
                       [this](const vp::Clock& clock, double hz) {
                         return states_.is_external(clock) ? hz : zynq_.ps.highest_fclk_hz(hz);
                       });
}

}  // namespace platform
