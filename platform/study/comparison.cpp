#include <study/comparison.h>

#include <result/console.h>
#include <vp/text.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <unordered_map>

namespace platform::study {

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

std::vector<IdleParameter> idle_parameters(const Results& results) {
  std::vector<const ResultRow*> ran;
  for (const ResultRow& row : results.rows) {
    if (!row.failed) ran.push_back(&row);
  }
  const auto first_like = [&](const ResultRow* row) {
    return row->same_as.value_or(static_cast<std::size_t>(row - results.rows.data()));
  };
  const auto is_equal = [&](const Comparison& comparison) {
    return std::all_of(comparison.begin(), comparison.end(), [&](const ResultRow* row) {
      return first_like(row) == first_like(comparison.front());
    });
  };
  std::vector<IdleParameter> idle;
  for (const std::vector<std::string>& paths : results.manifest.dimensions()) {
    const std::vector<Comparison> all = comparisons(ran, paths);
    if (!all.empty() && std::all_of(all.begin(), all.end(), is_equal))
      idle.push_back({vp::join(paths, "+"), all.size()});
  }
  return idle;
}

std::string idle_text(const std::vector<IdleParameter>& idle) {
  std::string text;
  for (const IdleParameter& parameter : idle)
    text += "'" + parameter.path +
            "' changes no result: " + result::counted(parameter.comparisons, "comparison") +
            " of points that differ in it alone" +
            (parameter.comparisons == 1 ? " shows" : " show") + " equal results.\n";
  return text;
}

}  // namespace platform::study
