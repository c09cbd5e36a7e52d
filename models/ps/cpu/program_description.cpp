#include <ps/cpu/program_description.h>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <string_view>

namespace ps {

namespace {

/// More than any program has (decision): a larger count is a mistake.
constexpr std::uint32_t most_entries = 4096;
constexpr std::size_t longest_name = 128;
constexpr std::size_t longest_text = 4096;

bool is_text(const char* text, std::size_t longest) {
  return text && strnlen(text, longest + 1) <= longest;
}

bool is_name(const char* text) {
  return is_text(text, longest_name) && *text != '\0';
}

/// A key of the configuration.
bool is_key(std::string_view name) {
  constexpr std::string_view allowed =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
  return name.find_first_not_of(allowed) == std::string_view::npos;
}

std::string problem_of_table(const char* kind, const void* table, std::uint32_t count) {
  if (count > most_entries) {
    return std::string("claims ") + std::to_string(count) + " " + kind + "s: at most " +
           std::to_string(most_entries) + " are taken";
  }
  if (count != 0 && !table)
    return std::string("has an incomplete hal_program_info: it counts ") + kind +
           "s, but has no table of them";
  return {};
}

/// `name(i)` is that of entry number i.
template <class Name>
std::string problem_of_names(const char* kind, std::uint32_t count, Name name) {
  std::set<std::string_view> seen;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::string which = std::string(kind) + " number " + std::to_string(i);
    if (!is_name(name(i))) {
      return "has no name for " + which + ": it needs 1 to " + std::to_string(longest_name) +
             " characters";
    }
    if (!seen.insert(name(i)).second) {
      return "has two " + std::string(kind) + "s named '" + name(i) + "': rename one";
    }
  }
  return {};
}

std::string problem_of_option(const hal_option_info& option) {
  const std::string which = std::string("option '") + option.name + "'";
  if (!is_key(option.name)) return "has the " + which + ": use letters, digits and _ only";
  if (option.name == std::string_view("opt")) {
    return "has the " + which + ", a name that the platform uses itself (sw.opt): rename it";
  }
  if (!is_text(option.unit, longest_name) || !is_text(option.documentation, longest_text)) {
    return "has the " + which + " without unit or documentation: either may be \"\"";
  }
  const bool finite = std::isfinite(option.default_value) && std::isfinite(option.minimum) &&
                      std::isfinite(option.maximum);
  if (!finite || option.minimum > option.default_value || option.default_value > option.maximum) {
    return "has the " + which + " with the default " + std::to_string(option.default_value) +
           " and the range " + std::to_string(option.minimum) + " to " +
           std::to_string(option.maximum) + ": give finite numbers, the default in the range";
  }
  return {};
}

}  // namespace

std::string problem_of(const hal_program& program) {
  if (program.abi != HAL_ABI) {
    return "was built for version " + std::to_string(program.abi) +
           " of the HAL, this is version " + std::to_string(HAL_ABI) + ": rebuild it";
  }
  if (!is_name(program.name) || !program.entry) {
    return "has an incomplete hal_program_info: it needs a name and an entry";
  }
  std::string problem = problem_of_table("unit", program.work, program.work_count);
  if (problem.empty())
    problem = problem_of_table("function", program.functions, program.function_count);
  if (problem.empty()) problem = problem_of_table("option", program.options, program.option_count);
  if (problem.empty()) {
    problem = problem_of_names("unit", program.work_count,
                               [&](std::uint32_t i) { return program.work[i]; });
  }
  if (problem.empty()) {
    problem = problem_of_names("function", program.function_count,
                               [&](std::uint32_t i) { return program.functions[i]; });
  }
  if (problem.empty()) {
    problem = problem_of_names("option", program.option_count,
                               [&](std::uint32_t i) { return program.options[i].name; });
  }
  for (std::uint32_t i = 0; problem.empty() && i < program.option_count; ++i)
    problem = problem_of_option(program.options[i]);
  return problem;
}

}  // namespace ps
