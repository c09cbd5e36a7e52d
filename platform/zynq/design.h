#pragma once

#include <string>
#include <vector>

#include <report/design_report.h>
#include <vp/clock.h>
#include <vp/ip_estimate.h>
#include <zynq/zynq.h>

namespace platform {

/// An IP of the programmable logic, as hardware.
struct DesignIp {
  std::string module;  ///< hierarchical name
  std::string name;    ///< without the "pl."
  std::string group;   ///< "feature_extraction", "data_bridge" or "image_memory"
  std::string kind;    ///< IP of one kind share coefficients: "axi_dma"
  const vp::Clock* clock;
  std::string clock_name;
  vp::IpEstimate estimate;
};

/// Everything that is built into the PL, in the order of the thesis' tables 4.1 and 4.2.
std::vector<DesignIp> design_of(Zynq& zynq);

/// What that takes of an XC7Z020 (DS190: 53 200 LUT, 106 400 FF, 140 blocks of 36 kbit, 220 DSP).
report::ResourceReport resource_report(const std::vector<DesignIp>& design);

}  // namespace platform
