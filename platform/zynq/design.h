#pragma once

#include <string>
#include <vector>

#include <report/design_report.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <zynq/zynq.h>

namespace platform {

/// An IP of the programmable logic, as hardware.
struct DesignIp {
  std::string module;  ///< hierarchical name
  std::string name;    ///< the last part of that
  std::string group;   ///< "feature_extraction", "data_bridge", "image_memory"
  const vp::Clock* clock;
  std::string clock_name;  ///< "ps.fclk_clk0"
  vp::IpEstimate estimate;
};

/// Everything that is built into the PL, as the hierarchy has it, in the order of reports.
std::vector<DesignIp> design_of(const Zynq& zynq);

/// What that takes of an XC7Z020 (DS190: 53 200 LUT, 106 400 FF, 140 blocks of 36 kbit, 220 DSP).
report::ResourceReport resource_report(const std::vector<DesignIp>& design);

}  // namespace platform
