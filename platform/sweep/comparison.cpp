#include <sweep/comparison.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <unordered_map>

namespace platform::sweep {

namespace {

/// All swept values of a row but these, as one number. Of ten million rows, two different ones get
/// the same by a chance of one in 400 000.
std::uint64_t rest_of(const ResultRow& row, const std::vector<std::string>& paths) {
  constexpr std::uint64_t prime = 0x9e3779b97f4a7c15;
  std::uint64_t number = 0;
  for (const auto& [path, value] : row.swept) {
    if (std::find(paths.begin(), paths.end(), path.text()) != paths.end()) continue;
    number = (number ^ std::hash<std::string>()(value.text())) * prime;
    number ^= number >> 32;
  }
  return number;
}

bool differ(const Comparison& rows, const std::vector<std::string>& paths) {
  return std::any_of(paths.begin(), paths.end(), [&](const std::string& path) {
    const std::string* first = find(rows.front()->swept, path);
    return std::any_of(rows.begin(), rows.end(), [&](const ResultRow* row) {
      const std::string* value = find(row->swept, path);
      return (value == nullptr) != (first == nullptr) || (first != nullptr && *value != *first);
    });
  });
}

}  // namespace

std::vector<Comparison> comparisons(const std::vector<const ResultRow*>& rows,
                                    const std::vector<std::string>& paths) {
  std::vector<Comparison> found;
  std::unordered_map<std::uint64_t, std::size_t> places;
  for (const ResultRow* row : rows) {
    const auto [place, is_new] = places.emplace(rest_of(*row, paths), found.size());
    if (is_new) found.emplace_back();
    found[place->second].push_back(row);
  }
  found.erase(
      std::remove_if(found.begin(), found.end(),
                     [&](const Comparison& comparison) { return !differ(comparison, paths); }),
      found.end());
  return found;
}

}  // namespace platform::sweep
