#include <xilinx/fabric_clock/fabric_clock.h>

#include <vp/clock_scheduler.h>
#include <vp/error.h>
#include <vp/text.h>
#include <vp/unit.h>

#include <algorithm>
#include <cmath>

namespace xilinx {

namespace {

constexpr double hz_per_mhz = 1e6;

/// A divider or multiplier in eighths.
std::uint64_t in_eighths(const vp::Parameter<std::string>& parameter, double lowest, double highest,
                         bool fractional) {
  const auto value = vp::Decimal::parse(parameter.get());
  const auto whole = value ? value->scaled(eighths, 0).whole() : std::nullopt;
  const bool fits = whole && *whole >= static_cast<vp::Decimal::Whole>(lowest * eighths) &&
                    *whole <= static_cast<vp::Decimal::Whole>(highest * eighths) &&
                    (fractional || *whole % eighths == 0);
  if (fits) return static_cast<std::uint64_t>(*whole);
  throw vp::InputError(std::string(parameter.name()) + " = " + vp::excerpt(parameter.get()) +
                       ": must be " + vp::format_fixed(lowest, 0) + " to " +
                       vp::format_fixed(highest, 0) +
                       (fractional ? " in steps of 0.125" : ", a whole number"));
}

}  // namespace

FabricClock::Output::Output(sc_core::sc_module_name name, vp::ClockScheduler& scheduler,
                            const std::string& usual, bool fractional)
    : sc_module(name),
      divide("divide", usual, vp::Source::published, "divider of this output (UG472)"),
      divider(in_eighths(divide, 1, 128, fractional)),
      clk("clk", scheduler, 0) {}

FabricClock::FabricClock(sc_core::sc_module_name name, vp::Clock& clk_in1, unsigned grade,
                         const FabricClockBuild& build)
    : sc_module(name),
      Ip(&clk_in1),
      divclk_divide("divclk_divide", build.input_divider, vp::Source::published,
                    "divider of the input (UG472)"),
      clkfbout_mult("clkfbout_mult", build.multiplier, vp::Source::published,
                    "multiplier of the oscillator (UG472)"),
      input_(clk_in1),
      input_eighths_(
          in_eighths(divclk_divide, 1, manager_limits(build.pll, grade).divclk_max, false)),
      multiplier_eighths_(in_eighths(clkfbout_mult, 2, 64, !build.pll)) {
  bool fractional = !build.pll;
  for (const auto& [output, divider] : build.outputs) {
    outputs_.emplace_back(output.c_str(), clk_in1.scheduler(), divider, fractional);
    fractional = false;
  }
  check_oscillator(grade, build.pll);
  input_.add_listener(*this);
  follow();
}

vp::Clock* FabricClock::output(const std::string& name) {
  const auto found = std::find_if(outputs_.begin(), outputs_.end(),
                                  [&](const Output& one) { return one.basename() == name; });
  return found == outputs_.end() ? nullptr : &found->clk;
}

double FabricClock::vco_hz() const {
  return static_cast<double>(input_.frequency_hz()) * static_cast<double>(multiplier_eighths_) /
         static_cast<double>(input_eighths_);
}

void FabricClock::check_oscillator(unsigned grade, bool pll) const {
  const ManagerLimits limits = manager_limits(pll, grade);
  const double vco = vco_hz();
  const double detector =
      static_cast<double>(input_.frequency_hz()) * eighths / static_cast<double>(input_eighths_);
  if (vco >= limits.vco_min && vco <= limits.vco_max && detector >= limits.detector_min) return;
  const auto mhz = [](double hz, int decimals) {
    return vp::format_fixed(hz / hz_per_mhz, decimals);
  };
  throw vp::InputError(
      std::string(name()) + ": its oscillator would run at " + mhz(vco, 3) +
      " MHz, its phase detector at " + mhz(detector, 3) + " MHz; a" + (pll ? " PLL" : "n MMCM") +
      " of speed grade -" + std::to_string(grade) + " runs from " + mhz(limits.vco_min, 0) +
      " to " + mhz(limits.vco_max, 0) + " MHz, the detector from " + mhz(limits.detector_min, 0) +
      " MHz: 'markervp clocks --for " + (pll ? "pll" : "mmcm") + "' lists settings");
}

// Input · multiplier / divider of the input / divider of the output; the eighths of the dividers
// cancel those of the multiplier but once.
void FabricClock::follow() {
  using Wide = unsigned __int128;
  for (Output& output : outputs_) {
    const Wide over = Wide{input_eighths_} * output.divider;
    const Wide made = Wide{input_.frequency_hz()} * multiplier_eighths_ * eighths;
    const auto hz = static_cast<std::uint64_t>((made + over / 2) / over);
    if (output.clk.frequency_hz() != hz) output.clk.set_frequency(hz);
  }
}

// No logic of the fabric. Its power is that of the clocks that it makes.
vp::IpEstimate FabricClock::own_estimate() const {
  vp::IpEstimate estimate;
  estimate.source = "published: an MMCM or PLL is a block of its own, without LUT (PG065)";
  estimate.fmax_hz = 800'000'000;
  estimate.fmax_origin = vp::FmaxOrigin::published;
  estimate.fmax_documentation = "highest input of an MMCM or PLL, -1 (DS187)";
  estimate.active_clocks = [] { return std::uint64_t{0}; };
  return estimate;
}

}  // namespace xilinx
