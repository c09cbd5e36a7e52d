#include <vp/ip.h>

#include <algorithm>
#include <stdexcept>

namespace vp {

const char* to_string(FmaxOrigin origin) {
  switch (origin) {
    case FmaxOrigin::published:
      return "published";
    case FmaxOrigin::derived:
      return "derived";
    case FmaxOrigin::synthesised:
      return "synthesised";
    case FmaxOrigin::estimated:
      break;
  }
  return "estimated";
}

const sc_core::sc_object& Ip::object() const {
  return dynamic_cast<const sc_core::sc_object&>(*this);
}

const Clock& Ip::logic_clock() const {
  if (clock_) return clock_->source();
  throw std::logic_error(std::string(object().name()) +
                         ": an IP without a clock of its own: call its set_logic_clock()");
}

IpEstimate Ip::estimate() const {
  IpEstimate estimate = own_estimate();
  if (clocks_) estimate.active_clocks = clocks_;
  estimate.foreign = foreign_;
  return estimate;
}

std::vector<const Ip*> ips_below(const sc_core::sc_object& top) {
  std::vector<const Ip*> ips;
  for (const Ip* ip : all_below<Ip>(top)) ips.push_back(ip);
  std::stable_sort(ips.begin(), ips.end(),
                   [](const Ip* a, const Ip* b) { return a->place() < b->place(); });
  return ips;
}

}  // namespace vp
