#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <systemc>
#include <vector>

#include <facts/result.h>
#include <fpga/device/device.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/parameter.h>

/// What the parts of a design ask of the chip.
namespace platform {

/// An IP of the programmable logic, as hardware.
struct Part {
  std::string module;  ///< hierarchical name
  std::string name;    ///< the last part of that
  std::string group;   ///< "filter", "data_bridge", "memory"
  const vp::Clock* clock;
  std::string clock_name;  ///< "ps.fclk_clk0"
  vp::IpEstimate estimate;
};

/// "ps.fclk_clk0": what holds a clock is its name, where that is `clk`.
std::string name_of(const vp::Clock& clock);

/// Everything below `pl` that is an IP (vp::Ip), in the order of reports, with the figures of
/// synthesis where it has RTL.
std::vector<Part> parts_of(const sc_core::sc_object& pl);

/// What that takes of a device.
facts::ResourceReport resource_report(const std::vector<Part>& parts, const device::Device& device);

/// Whether each IP can be built for its clock: parameters `fmax` and `fmax_high` for each, by
/// default what the IP says for the slowest speed grade, scaled to that of the device. A design
/// that cannot be built runs all the same.
class TimingClosure : public sc_core::sc_module {
 public:
  /// `parts` and `device` must outlive it. Throws vp::InputError for limits in the wrong order.
  TimingClosure(sc_core::sc_module_name name, const std::vector<Part>& parts,
                const device::Device& device);

  /// `fastest_hz` tells the highest frequency that a clock had, `made_below_hz` the highest that
  /// it can have up to another; 0: none.
  facts::TimingReport report(
      const std::function<std::uint64_t(const vp::Clock&)>& fastest_hz,
      const std::function<double(const vp::Clock&, double)>& made_below_hz) const;

 private:
  struct Limit : sc_core::sc_module {
    Limit(sc_core::sc_module_name name, const Part& ip, const device::Device& device);
    std::uint64_t usual_high(const device::Device& device) const;

    const Part& ip;
    vp::Parameter<std::uint64_t> fmax, fmax_high;
  };

  const device::Device& device_;
  std::deque<Limit> limits_;
};

}  // namespace platform
