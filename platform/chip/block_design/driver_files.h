#pragma once

#include <string>
#include <utility>
#include <vector>

#include <chip/handoff/handoff.h>
#include <chip/handoff/own_driver.h>

namespace platform::block_design {

/// What the vendor's tools make of the drivers of a design's own IP.
struct DriverFiles {
  std::vector<std::pair<std::string, std::string>> files;  ///< "filter_v1_0/filter.h", text
  std::string names;  ///< lines for xparameters.h: numbers and addresses of the instances
};

/// The drivers whose IP the design has, one of each name, with the tables of their instances.
/// Names that `xparameters` has already are not written again.
DriverFiles driver_files(const handoff::Handoff& handoff,
                         const std::vector<handoff::OwnDriver>& drivers,
                         const std::string& xparameters);

}  // namespace platform::block_design
