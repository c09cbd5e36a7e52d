#include <chip/cost/clock_report.h>

#include <cmath>
#include <set>
#include <string>

#include <chip/system/design.h>
#include <vp/ip.h>
#include <vp/systemc_pins.h>

namespace platform {

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
