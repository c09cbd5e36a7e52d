#include <zynq/timing_closure.h>

namespace platform {

namespace {

constexpr double hz_per_mhz = 1e6;
constexpr std::uint64_t slowest_hz = 1'000'000, fastest_hz = 1'000'000'000;

std::string documentation(const vp::IpEstimate& e) {
  return std::string(e.lower_bound ? "clock up to which it is known to work: "
                                   : "highest clock at which it works: ") +
         e.fmax_documentation;
}

}  // namespace

TimingClosure::Limit::Limit(sc_core::sc_module_name name, const Part& described)
    : sc_module(name),
      ip(described),
      fmax("fmax", ip.estimate.fmax_hz, vp::Unit::frequency, {slowest_hz, fastest_hz},
           ip.estimate.fmax_source, documentation(ip.estimate)) {}

TimingClosure::TimingClosure(sc_core::sc_module_name name, const std::vector<Part>& parts)
    : sc_module(name) {
  for (const Part& ip : parts) limits_.emplace_back(ip.name.c_str(), ip);
}

report::TimingReport TimingClosure::report(
    const std::function<std::uint64_t(const vp::Clock&)>& fastest) const {
  report::TimingReport report;
  for (const Limit& limit : limits_) {
    report::TimingReport::Module module;
    module.name = limit.ip.module;
    module.clock = limit.ip.clock_name;
    const std::uint64_t hz = fastest(*limit.ip.clock);
    module.frequency_mhz = static_cast<double>(hz) / hz_per_mhz;
    module.fmax_mhz = static_cast<double>(limit.fmax) / hz_per_mhz;
    // Another limit than ours is the user's, and is one.
    module.lower_bound = limit.ip.estimate.lower_bound && !limit.fmax.is_changed();
    module.met = hz <= limit.fmax;
    module.margin_percent = hz == 0 ? 0 : 100 * (module.fmax_mhz / module.frequency_mhz - 1);
    module.source = limit.fmax.is_changed() ? "configuration"
                                            : std::string(vp::to_string(limit.fmax.source())) +
                                                  ": " + limit.ip.estimate.fmax_documentation;
    report.met = report.met && module.met;
    report.modules.push_back(module);
  }
  return report;
}

}  // namespace platform
