#include <chip/cost/parts.h>

#include <algorithm>
#include <cmath>

#include <fpga/synthesis/known_figures.h>
#include <vp/error.h>
#include <vp/text.h>

namespace platform {

namespace {

constexpr std::uint64_t slowest_hz = 1'000'000, fastest_hz = 1'000'000'000;
/// No logic is faster than the clock buffer: 2.155 ns in public timing reports of -1.
constexpr std::uint64_t clock_buffer_hz = 464'000'000;

/// Of a part whose Fmax is not known it is 0.
vp::Range<std::uint64_t> limits(const vp::IpEstimate& e) {
  return {e.known ? slowest_hz : 0, fastest_hz};
}

/// Where Fmax comes from.
std::string explanation(const vp::IpEstimate& e, const device::Device& device) {
  if (!e.known) return e.source;
  const double factor = device.fmax_factor.value;
  if (factor == 1) return e.fmax_documentation;
  return e.fmax_documentation + "; x" + vp::format_fixed(factor, 2) + " for " + device.name();
}

/// A published figure of another speed grade is a derived one.
vp::FmaxOrigin origin_of(const vp::IpEstimate& e, const device::Device& device) {
  const bool scaled = device.fmax_factor.value != 1;
  return scaled && e.fmax_origin == vp::FmaxOrigin::published ? vp::FmaxOrigin::derived
                                                              : e.fmax_origin;
}

vp::Source source_of(vp::FmaxOrigin origin) {
  switch (origin) {
    case vp::FmaxOrigin::published:
      return vp::Source::published;
    case vp::FmaxOrigin::derived:
    case vp::FmaxOrigin::synthesised:
      return vp::Source::derived;
    case vp::FmaxOrigin::estimated:
      break;
  }
  return vp::Source::assumed;
}

std::uint64_t scaled(std::uint64_t hz, const device::Device& device) {
  const double fast = static_cast<double>(hz) * device.fmax_factor.value;
  return std::min(static_cast<std::uint64_t>(std::llround(fast)), fastest_hz);
}

double mhz(std::uint64_t hz) {
  return static_cast<double>(hz) / device::hz_per_mhz;
}

}  // namespace

std::string name_of(const vp::Clock& clock) {
  const sc_core::sc_object* source = clock.get_parent_object();
  return source && std::string(clock.basename()) == "clk" ? source->name() : clock.name();
}

std::vector<Part> parts_of(const sc_core::sc_object& pl) {
  std::vector<Part> parts;
  for (const vp::Ip* ip : vp::ips_below(pl)) {
    const sc_core::sc_object& object = ip->object();
    const vp::Clock& clock = ip->logic_clock();
    parts.push_back(
        {object.name(), object.basename(), ip->group(), &clock, name_of(clock), ip->estimate()});
    synthesis::KnownFigures::installed().apply(parts.back().estimate, object.name());
  }
  return parts;
}

facts::ResourceReport resource_report(const std::vector<Part>& parts,
                                      const device::Device& device) {
  facts::ResourceReport report;
  report.device = device.part;
  report.available = {device.lut.value, device.ff.value, device.bram36.value, device.dsp.value};
  facts::ResourceReport::Amount& total = report.total;
  for (const Part& ip : parts) {
    const vp::IpEstimate& e = ip.estimate;
    const facts::ResourceReport::Amount amount{static_cast<double>(e.lut),
                                               static_cast<double>(e.ff), e.bram36,
                                               static_cast<double>(e.dsp)};
    report.modules.push_back({ip.module, amount, e.uncertainty_percent, e.source, e.known});
    if (!e.known) report.unknown.push_back(ip.module);
    total.lut += amount.lut;
    total.ff += amount.ff;
    total.bram36 += amount.bram36;
    total.dsp += amount.dsp;
  }
  for (const facts::Primitive& p : facts::primitives) {
    if (total.*p.amount > report.available.*p.amount) report.over.emplace_back(p.key);
  }
  return report;
}

TimingClosure::Limit::Limit(sc_core::sc_module_name name, const Part& described,
                            const device::Device& device)
    : sc_module(name),
      ip(described),
      fmax("fmax", scaled(ip.estimate.fmax_hz, device), vp::Unit::frequency, limits(ip.estimate),
           source_of(origin_of(ip.estimate, device)),
           "clock up to which it works: " + explanation(ip.estimate, device)),
      fmax_high("fmax_high", usual_high(device), vp::Unit::frequency, limits(ip.estimate),
                source_of(origin_of(ip.estimate, device)),
                "clock above which it does not; between the two it is unknown") {
  fmax.follows("device");
  fmax_high.follows(fmax.name());
  if (fmax_high >= fmax) return;
  throw vp::InputError(std::string(fmax_high.name()) + " is " + fmax_high.text() + ", below " +
                       fmax.name() + ", which is " + fmax.text() + ": give at least that");
}

/// A limit of the user's own is one.
std::uint64_t TimingClosure::Limit::usual_high(const device::Device& device) const {
  if (fmax.is_changed()) return fmax;
  if (!ip.estimate.known) return 0;
  const std::uint64_t high = ip.estimate.fmax_high_hz;
  return std::max(scaled(high != 0 ? high : clock_buffer_hz, device), fmax.get());
}

TimingClosure::TimingClosure(sc_core::sc_module_name name, const std::vector<Part>& parts,
                             const device::Device& device)
    : sc_module(name), device_(device) {
  for (const Part& ip : parts) limits_.emplace_back(ip.name.c_str(), ip, device);
}

facts::TimingReport TimingClosure::report(
    const std::function<std::uint64_t(const vp::Clock&)>& fastest,
    const std::function<double(const vp::Clock&, double)>& made_below_hz) const {
  facts::TimingReport report;
  for (const Limit& limit : limits_) {
    facts::TimingReport::Module module;
    module.name = limit.ip.module;
    module.clock = limit.ip.clock_name;
    const std::uint64_t hz = fastest(*limit.ip.clock);
    module.frequency_mhz = mhz(hz);
    module.fmax_mhz = mhz(limit.fmax);
    module.fmax_high_mhz = mhz(limit.fmax_high);
    module.known = limit.fmax > 0;
    if (module.known)
      module.reachable_mhz =
          made_below_hz(*limit.ip.clock, static_cast<double>(limit.fmax)) / device::hz_per_mhz;
    module.met = module.known && hz <= limit.fmax;
    module.margin_percent = hz == 0 ? 0 : 100 * (module.fmax_mhz / module.frequency_mhz - 1);
    const bool own = limit.fmax.is_changed() || limit.fmax_high.is_changed();
    module.origin = own            ? "configuration"
                    : module.known ? vp::to_string(origin_of(limit.ip.estimate, device_))
                                   : "unknown";
    module.source =
        own ? module.origin : module.origin + ": " + explanation(limit.ip.estimate, device_);
    report.met = report.met && module.met;
    report.modules.push_back(module);
  }
  return report;
}

}  // namespace platform
