#include <zynq/clock_report.h>

#include <cmath>

namespace platform {

namespace {

using device::ClockKind;
using report::ClockReport;

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
  clock.limit_mhz = verdict.limit_hz / device::hz_per_mhz;
  clock.limit_confidence = to_string(verdict.confidence);
  clock.margin_percent = verdict.margin_percent;
  clock.within = verdict.within;
  if (!verdict.within) {
    const auto legal = ps.clock_planner().neighbours(verdict.limit_hz, use.kind, ps.clock_plan());
    if (legal.below) clock.legal_mhz = legal.below->hz / device::hz_per_mhz;
  }
  clock.makeable = verdict.makeable;
  return clock;
}

}  // namespace

std::uint64_t ddr_hz(const Zynq& zynq, const PowerOptions& options) {
  if (!zynq.ps.clocks_are_made()) return options.ddr.frequency;
  return static_cast<std::uint64_t>(std::llround(made_ddr(zynq, options).hz));
}

report::ClockReport clock_report(Zynq& zynq, const PowerOptions& options,
                                 const PowerStates& states) {
  ProcessingSystem& ps = zynq.ps;
  ClockReport report;
  report.device = zynq.chip.data.name();
  report.mode = zynq.chip.clocks.text();
  const auto add = [&](const Use& use) {
    report.clocks.push_back(judged(ps, use));
    report.legal = report.legal && report.clocks.back().within && report.clocks.back().makeable;
  };
  const auto add_source = [&](const ClockSource& source, ClockKind kind,
                              const device::MadeClock& made) {
    add({source.name(), kind, source.frequency, made, states.fastest_hz(source.clk)});
  };
  add_source(ps.cpu_clk, ps.slcr.ratio_621() ? ClockKind::cpu_621 : ClockKind::cpu_421,
             ps.clock_plan().cpu);
  auto made = ps.clock_plan().fclk.begin();
  for (const auto& [number, source] : ps.fclks()) add_source(*source, ClockKind::fclk, *made++);
  add({"power.ddr", ClockKind::ddr, options.ddr.frequency, made_ddr(zynq, options),
       ddr_hz(zynq, options)});
  return report;
}

}  // namespace platform
