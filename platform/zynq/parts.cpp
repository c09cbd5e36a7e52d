#include <zynq/parts.h>

namespace platform {

namespace {

/// What holds it is its name: it is `clk` there.
std::string name_of(const vp::Clock& clock) {
  const sc_core::sc_object* source = clock.get_parent_object();
  return source && std::string(clock.basename()) == "clk" ? source->name() : clock.name();
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

report::ResourceReport resource_report(const std::vector<Part>& parts) {
  report::ResourceReport report;
  report.device = "xc7z020";
  report.available = {53'200, 106'400, 140, 220};
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
  const auto& available = report.available;
  if (total.lut > available.lut) report.over.emplace_back("lut");
  if (total.ff > available.ff) report.over.emplace_back("ff");
  if (total.bram36 > available.bram36) report.over.emplace_back("bram36");
  if (total.dsp > available.dsp) report.over.emplace_back("dsp");
  return report;
}

}  // namespace platform
