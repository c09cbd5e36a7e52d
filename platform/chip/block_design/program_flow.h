#pragma once

#include <string>
#include <vector>

namespace platform::block_design {

/// Whether programs of these texts are written for the flow with a system device tree, Vitis from
/// 2023.2 on, where `SDT` is defined: they use names that `xparameters` has behind `SDT` alone, and
/// none that the other flow has alone.
bool is_for_device_tree(const std::vector<std::string>& programs, const std::string& xparameters);

}  // namespace platform::block_design
