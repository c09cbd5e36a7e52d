#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <systemc>
#include <vector>

#include <report/design_report.h>
#include <vp/parameter.h>
#include <zynq/parts.h>

namespace platform {

/// Whether each IP can be built for its clock: a parameter `fmax` for each. A design that cannot
/// runs all the same.
class TimingClosure : public sc_core::sc_module {
 public:
  /// `parts` must outlive it.
  TimingClosure(sc_core::sc_module_name name, const std::vector<Part>& parts);

  /// `fastest_hz` tells the highest frequency that a clock had.
  report::TimingReport report(
      const std::function<std::uint64_t(const vp::Clock&)>& fastest_hz) const;

 private:
  struct Limit : sc_core::sc_module {
    Limit(sc_core::sc_module_name name, const Part& ip);
    const Part& ip;
    vp::Parameter<std::uint64_t> fmax;
  };

  std::deque<Limit> limits_;
};

}  // namespace platform
