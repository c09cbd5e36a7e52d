#pragma once

#include <string>
#include <vector>

#include <report/design_report.h>
#include <vp/clock.h>
#include <vp/ip.h>

namespace platform {

/// An IP of the programmable logic, as hardware.
struct Part {
  std::string module;  ///< hierarchical name
  std::string name;    ///< the last part of that
  std::string group;   ///< "feature_extraction", "data_bridge", "image_memory"
  const vp::Clock* clock;
  std::string clock_name;  ///< "ps.fclk_clk0"
  vp::IpEstimate estimate;
};

/// Everything below `pl` that is an IP (vp::Ip), in the order of reports.
std::vector<Part> parts_of(const sc_core::sc_object& pl);

/// What that takes of an XC7Z020 (DS190: 53 200 LUT, 106 400 FF, 140 blocks of 36 kbit, 220 DSP).
report::ResourceReport resource_report(const std::vector<Part>& parts);

}  // namespace platform
