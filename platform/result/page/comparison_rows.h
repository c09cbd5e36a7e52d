#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace platform::page {

/// What the page shows of two runs beside each other: every figure that has a title in the table of
/// figures, [{title, unit, better, a, b}]; null is what a run lacks.
nlohmann::ordered_json comparison_rows(const nlohmann::ordered_json& a,
                                       const nlohmann::ordered_json& b);

}  // namespace platform::page
