#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <unordered_map>
#include <vector>

namespace platform::synthesis {

/// Joins LUT that share most inputs, larger ones first: not the most pairs that there are, but
/// about those that a placer finds near each other.
class LutPairs {
 public:
  explicit LutPairs(const nlohmann::json& cells);

  std::uint32_t count() const;

 private:
  static constexpr std::size_t most_inputs = 5;

  std::optional<std::size_t> best_partner(std::size_t i, const std::vector<bool>& taken) const;

  std::vector<std::set<unsigned>> luts_;  ///< the inputs of each, largest first
  std::unordered_map<unsigned, std::vector<std::size_t>> readers_;
};

}  // namespace platform::synthesis
