#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace integration {

/// What is wrong with a result.json of schema 1, one line each: keys that are missing or of another
/// type, values that cannot be. Keys of features that are not built yet (energy, power) may be
/// absent.
std::vector<std::string> schema_problems(const nlohmann::ordered_json& result);

}  // namespace integration
