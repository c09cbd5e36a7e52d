#include <fmt/format.h>

#include <algorithm>
#include <map>

#include <report/verdict.h>
#include <vp/text.h>

namespace platform::report {

namespace {

/// Highest junction temperature of a device of the commercial range (DS187).
constexpr double commercial_limit_c = 85;

std::string mhz(double value) {
  std::string text = vp::format_fixed(value, 3);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text + " MHz";
}

std::string power_line(const PowerReport& power) {
  std::string text =
      fmt::format("power    {:.2f} W ({:.2f} to {:.2f})", power.total_w, power.low_w, power.high_w);
  if (power.per_frame) text += fmt::format("   {:.1f} mJ per frame", power.energy_per_frame_mj);
  return text + fmt::format("   junction {:.0f} C   ({})\n", power.junction_c, power.mode);
}

std::string timing_line(const TimingReport& timing) {
  if (timing.modules.empty()) return "";
  const TimingReport::Module& critical = critical_module(timing);
  if (timing.met) {
    return fmt::format("timing   met, {:.0f} % to spare ({})\n", critical.margin_percent,
                       critical.name);
  }
  const bool unknown = critical.unknown();
  const auto alike =
      std::count_if(timing.modules.begin(), timing.modules.end(),
                    [&](const auto& m) { return unknown ? m.unknown() : m.missed(); });
  const std::string others = alike > 1 ? fmt::format(" and {} more", alike - 1) : "";
  const std::string reachable = critical.reachable_mhz > 0
                                    ? fmt::format("; the chip has {}", mhz(critical.reachable_mhz))
                                    : "";
  return fmt::format("timing   {} {}{}: {}, {} {}{}\n", unknown ? "unknown for" : "MISSED by",
                     critical.name, others, mhz(critical.frequency_mhz),
                     unknown ? "known to work up to" : "at most", mhz(critical.fmax_mhz),
                     reachable);
}

std::string resource_line(const ResourceReport& resources) {
  if (resources.modules.empty()) return "";
  std::string text = resources.over.empty() ? "fits     " : "TOO BIG  ";
  for (const Primitive& p : primitives) {
    text += fmt::format("{}{} {:.0f} of {:.0f}", &p == primitives ? "" : "   ", p.text,
                        resources.total.*p.amount, resources.available.*p.amount);
  }
  return text + fmt::format("   ({})\n", resources.device);
}

}  // namespace

std::vector<std::string> timing_warnings(const TimingReport& timing) {
  std::vector<std::string> warnings;
  // By clock and limit.
  std::map<std::pair<std::string, double>, std::vector<std::string>> unknown;
  for (const auto& module : timing.modules) {
    if (module.met) continue;
    if (module.unknown()) {
      unknown[{module.clock + " runs at " + mhz(module.frequency_mhz), module.fmax_mhz}].push_back(
          module.name);
      continue;
    }
    warnings.push_back(
        fmt::format("{} misses timing: {} runs at {}, and it reaches {} at most ({:.1f} % less): "
                    "such a chip cannot be built",
                    module.name, module.clock, mhz(module.frequency_mhz), mhz(module.fmax_mhz),
                    100 * (1 - module.fmax_mhz / module.frequency_mhz)));
  }
  for (const auto& [limit, modules] : unknown) {
    const std::string others =
        modules.size() > 1 ? fmt::format(" and {} more", modules.size() - 1) : "";
    warnings.push_back(fmt::format(
        "nobody knows whether timing is met: {}, and {}{} is known to work up to {} only",
        limit.first, modules.front(), others, mhz(limit.second)));
  }
  return warnings;
}

std::vector<std::string> resource_warnings(const ResourceReport& resources) {
  std::vector<std::string> warnings;
  for (const Primitive& p : primitives) {
    if (resources.total.*p.amount <= resources.available.*p.amount) continue;
    warnings.push_back(fmt::format(
        "the design does not fit into the {}: it takes about {:.0f} {} "
        "of {:.0f}",
        resources.device, resources.total.*p.amount, p.text, resources.available.*p.amount));
  }
  return warnings;
}

std::vector<std::string> power_warnings(const PowerReport& power) {
  if (power.junction_c <= commercial_limit_c) return {};
  return {
      fmt::format("the junction settles at {:.0f} C, above the {:.0f} C of a commercial device: "
                  "lower power.ambient, power.theta_ja (a heat sink) or the clocks",
                  power.junction_c, commercial_limit_c)};
}

std::vector<std::string> clock_warnings(const ClockReport& report) {
  std::vector<std::string> warnings;
  for (const ClockReport::Clock& clock : report.clocks) {
    if (clock.within) continue;
    warnings.push_back(fmt::format(
        "{} runs at {}, and an {} allows {} at most ({}, {:.1f} % less): such a chip is not sold",
        clock.name, mhz(clock.frequency_mhz), report.device, mhz(clock.limit_mhz),
        clock.limit_confidence, 100 * (1 - clock.limit_mhz / clock.frequency_mhz)));
  }
  return warnings;
}

std::string clock_text(const ClockReport& report) {
  std::string text;
  for (const ClockReport::Clock& clock : report.clocks) {
    if (clock.is_made) continue;
    const bool made = report.mode == "made";
    std::string others;
    for (const double near : {clock.below_mhz, clock.above_mhz}) {
      if (near == 0 || (made && mhz(near) == mhz(clock.made_mhz))) continue;
      others += (others.empty() ? "" : " or ") + mhz(near);
    }
    text += made ? fmt::format("clock    {} is {}: no PLL gives {}{}\n", clock.name,
                               mhz(clock.made_mhz), mhz(clock.wish_mhz),
                               others.empty() ? "" : "; else " + others)
                 : fmt::format("clock    {} is {}, exactly; a chip makes {}\n", clock.name,
                               mhz(clock.wish_mhz), others);
  }
  return text;
}

std::string design_text(const PowerReport& power, const ResourceReport& resources,
                        const TimingReport& timing) {
  return power_line(power) + timing_line(timing) + resource_line(resources);
}

}  // namespace platform::report
