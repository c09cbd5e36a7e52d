#include <vp/power_meter.h>

#include <stdexcept>
#include <utility>

namespace vp {

void PowerMeter::add(PowerSource source) {
  if ((source.state != nullptr) == static_cast<bool>(source.count)) {
    throw std::logic_error("power source of " + source.module + ": a state or events, not both");
  }
  marks_.push_back(source.count ? source.count() : 0);
  sources_.push_back(std::move(source));
}

void PowerMeter::mark() {
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    if (sources_[i].count) marks_[i] = sources_[i].count();
  }
}

EnergyLedger PowerMeter::measure(const std::vector<Interval>& intervals) const {
  EnergyLedger ledger;
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    const PowerSource& source = sources_[i];
    double amount = 0;
    if (source.count) {
      amount = source.count() - marks_[i];
    } else {
      for (const Interval& interval : intervals) {
        amount += source.state->integral(interval.from_ps, interval.to_ps);
      }
    }
    ledger.add({source.module, source.group, source.rail, source.kind, source.source,
                source.joules * amount});
  }
  return ledger;
}

Band PowerMeter::power(std::uint64_t ps) const {
  Band sum;
  for (const PowerSource& source : sources_) {
    if (source.state) sum += source.joules * source.state->at(ps);
  }
  return sum;
}

double PowerMeter::watts(std::uint64_t ps, const std::string& group) const {
  double sum = 0;
  for (const PowerSource& source : sources_) {
    if (source.state && (group.empty() || group == source.group)) {
      sum += source.joules.nominal * source.state->at(ps);
    }
  }
  return sum;
}

}  // namespace vp
