#include <fpga/synthesis/lut_pairs.h>

#include <algorithm>
#include <map>

#include <fpga/synthesis/cell_kinds.h>

namespace platform::synthesis {

using Json = nlohmann::json;

LutPairs::LutPairs(const Json& cells) {
  std::map<unsigned, unsigned> before_inverter;
  for (const auto& [name, cell] : cells.items()) {
    const Json& ports = cell.at("connections");
    if (kind_of(cell.at("type")) == Kind::inverter && ports.at("I")[0].is_number())
      before_inverter[ports.at("O")[0]] = ports.at("I")[0];
  }
  for (const auto& [name, cell] : cells.items()) {
    if (kind_of(cell.at("type")) != Kind::lut) continue;
    std::set<unsigned> inputs;
    for (const auto& [port, value] : cell.at("connections").items()) {
      if (port == "O" || !value[0].is_number()) continue;
      const auto found = before_inverter.find(value[0]);
      inputs.insert(found == before_inverter.end() ? value[0].get<unsigned>() : found->second);
    }
    if (inputs.size() <= most_inputs) luts_.push_back(std::move(inputs));
  }
  std::stable_sort(luts_.begin(), luts_.end(),
                   [](const auto& a, const auto& b) { return a.size() > b.size(); });
  for (std::size_t i = 0; i < luts_.size(); ++i) {
    for (const unsigned input : luts_[i]) readers_[input].push_back(i);
  }
}

std::uint32_t LutPairs::count() const {
  std::vector<bool> taken(luts_.size());
  std::uint32_t pairs = 0;
  for (std::size_t i = 0; i < luts_.size(); ++i) {
    if (taken[i]) continue;
    const std::optional<std::size_t> partner = best_partner(i, taken);
    if (!partner) continue;
    taken[i] = taken[*partner] = true;
    ++pairs;
  }
  return pairs;
}

std::optional<std::size_t> LutPairs::best_partner(std::size_t i,
                                                  const std::vector<bool>& taken) const {
  std::optional<std::size_t> best;
  std::size_t most_shared = 0;
  for (const unsigned input : luts_[i]) {
    for (const std::size_t j : readers_.at(input)) {
      if (j == i || taken[j]) continue;
      const auto shared = static_cast<std::size_t>(
          std::count_if(luts_[j].begin(), luts_[j].end(),
                        [&](unsigned bit) { return luts_[i].count(bit) != 0; }));
      if (luts_[i].size() + luts_[j].size() - shared > most_inputs) continue;
      if (shared < most_shared || (shared == most_shared && best && *best <= j)) continue;
      best = j;
      most_shared = shared;
    }
  }
  return best;
}

}  // namespace platform::synthesis
