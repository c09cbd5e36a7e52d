#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace integration {

/// What is wrong with the members that say what a design costs: `power`, `resources`, `timing`, and
/// the energies of frames and summary. A line each.
std::vector<std::string> design_problems(const nlohmann::ordered_json& result);

}  // namespace integration
