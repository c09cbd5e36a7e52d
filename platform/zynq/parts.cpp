#include <zynq/parts.h>

#include <cmath>

#include <vp/text.h>

namespace platform {

namespace {

constexpr std::uint64_t slowest_hz = 1'000'000, fastest_hz = 1'000'000'000;

/// What holds it is its name: it is `clk` there.
std::string name_of(const vp::Clock& clock) {
  const sc_core::sc_object* source = clock.get_parent_object();
  return source && std::string(clock.basename()) == "clk" ? source->name() : clock.name();
}

/// Where Fmax comes from.
std::string origin(const vp::IpEstimate& e, const device::Device& device) {
  const double factor = device.fmax_factor.value;
  if (factor == 1) return e.fmax_documentation;
  return e.fmax_documentation + "; x" + vp::format_fixed(factor, 2) + " for " + device.name();
}

std::string documentation(const vp::IpEstimate& e, const device::Device& device) {
  return std::string(e.lower_bound ? "clock up to which it is known to work: "
                                   : "highest clock at which it works: ") +
         origin(e, device);
}

std::uint64_t scaled_fmax(const vp::IpEstimate& e, const device::Device& device) {
  return static_cast<std::uint64_t>(
      std::llround(static_cast<double>(e.fmax_hz) * device.fmax_factor.value));
}

/// A scaled figure is derived at best.
vp::Source source_of(const vp::IpEstimate& e, const device::Device& device) {
  const bool scaled = device.fmax_factor.value != 1;
  return scaled && e.fmax_source == vp::Source::published ? vp::Source::derived : e.fmax_source;
}

}  // namespace

std::vector<Part> parts_of(const sc_core::sc_object& pl) {
  std::vector<Part> parts;
  for (const vp::Ip* ip : vp::ips_below(pl)) {
    const sc_core::sc_object& object = ip->object();
    const vp::Clock& clock = ip->logic_clock();
    parts.push_back(
        {object.name(), object.basename(), ip->group(), &clock, name_of(clock), ip->estimate()});
  }
  return parts;
}

report::ResourceReport resource_report(const std::vector<Part>& parts,
                                       const device::Device& device) {
  report::ResourceReport report;
  report.device = device.part;
  report.available = {device.lut.value, device.ff.value, device.bram36.value, device.dsp.value};
  report::ResourceReport::Amount& total = report.total;
  for (const Part& ip : parts) {
    const vp::IpEstimate& e = ip.estimate;
    const report::ResourceReport::Amount amount{static_cast<double>(e.lut),
                                                static_cast<double>(e.ff), e.bram36,
                                                static_cast<double>(e.dsp)};
    report.modules.push_back({ip.module, amount, e.uncertainty_percent, e.source});
    total.lut += amount.lut;
    total.ff += amount.ff;
    total.bram36 += amount.bram36;
    total.dsp += amount.dsp;
  }
  for (const report::Primitive& p : report::primitives) {
    if (total.*p.amount > report.available.*p.amount) report.over.emplace_back(p.key);
  }
  return report;
}

TimingClosure::Limit::Limit(sc_core::sc_module_name name, const Part& described,
                            const device::Device& device)
    : sc_module(name),
      ip(described),
      fmax("fmax", scaled_fmax(ip.estimate, device), vp::Unit::frequency, {slowest_hz, fastest_hz},
           source_of(ip.estimate, device), documentation(ip.estimate, device)) {}

TimingClosure::TimingClosure(sc_core::sc_module_name name, const std::vector<Part>& parts,
                             const device::Device& device)
    : sc_module(name), device_(device) {
  for (const Part& ip : parts) limits_.emplace_back(ip.name.c_str(), ip, device);
}

report::TimingReport TimingClosure::report(
    const std::function<std::uint64_t(const vp::Clock&)>& fastest,
    const std::function<double(double)>& made_below_hz) const {
  report::TimingReport report;
  for (const Limit& limit : limits_) {
    report::TimingReport::Module module;
    module.name = limit.ip.module;
    module.clock = limit.ip.clock_name;
    const std::uint64_t hz = fastest(*limit.ip.clock);
    module.frequency_mhz = static_cast<double>(hz) / device::hz_per_mhz;
    module.fmax_mhz = static_cast<double>(limit.fmax) / device::hz_per_mhz;
    module.reachable_mhz = made_below_hz(static_cast<double>(limit.fmax)) / device::hz_per_mhz;
    // Another limit than ours is the user's, and is one.
    module.lower_bound = limit.ip.estimate.lower_bound && !limit.fmax.is_changed();
    module.met = hz <= limit.fmax;
    module.margin_percent = hz == 0 ? 0 : 100 * (module.fmax_mhz / module.frequency_mhz - 1);
    module.source = limit.fmax.is_changed() ? "configuration"
                                            : std::string(vp::to_string(limit.fmax.source())) +
                                                  ": " + origin(limit.ip.estimate, device_);
    report.met = report.met && module.met;
    report.modules.push_back(module);
  }
  return report;
}

}  // namespace platform
