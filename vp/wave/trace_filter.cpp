#include <vp/error.h>
#include <vp/text.h>
#include <vp/trace_filter.h>

#include <algorithm>
#include <set>

namespace vp {

namespace {

using Levels = std::vector<std::string>;

constexpr std::size_t names_suggested = 6;

/// `*` and `?` inside one level.
bool level_matches(std::string_view pattern, std::string_view level) {
  if (pattern.empty()) return level.empty();
  if (pattern.front() == '*') {
    return level_matches(pattern.substr(1), level) ||
           (!level.empty() && level_matches(pattern, level.substr(1)));
  }
  return !level.empty() && (pattern.front() == '?' || pattern.front() == level.front()) &&
         level_matches(pattern.substr(1), level.substr(1));
}

bool levels_match(const Levels& pattern, std::size_t p, const Levels& path, std::size_t n) {
  if (p == pattern.size()) return n == path.size();
  if (pattern[p] == "**") {
    return levels_match(pattern, p + 1, path, n) ||
           (n < path.size() && levels_match(pattern, p, path, n + 1));
  }
  return n < path.size() && level_matches(pattern[p], path[n]) &&
         levels_match(pattern, p + 1, path, n + 1);
}

/// How many levels of `pattern`, from the left and up to the first `**`, fit the path.
std::size_t levels_in_common(const Levels& pattern, const Levels& path) {
  std::size_t common = 0;
  while (common < pattern.size() && common < path.size() && pattern[common] != "**" &&
         level_matches(pattern[common], path[common])) {
    ++common;
  }
  return common;
}

std::vector<std::string> nearest_first(const std::set<std::string>& names, const std::string& to) {
  std::vector<std::string> sorted(names.begin(), names.end());
  std::stable_sort(sorted.begin(), sorted.end(), [&](const auto& a, const auto& b) {
    return edit_distance(to, a) < edit_distance(to, b);
  });
  return sorted;
}

}  // namespace

TraceFilter::TraceFilter(const std::vector<std::string>& patterns) {
  for (std::string list : patterns) {
    std::replace(list.begin(), list.end(), ',', ' ');
    for (const std::string& text : split(list, ' ')) {
      if (!text.empty()) patterns_.push_back(parse(text));
    }
  }
}

TraceFilter::Pattern TraceFilter::parse(std::string_view text) {
  Pattern pattern{std::string(text), text.front() != '-', true, {}};
  if (text.front() == '+' || text.front() == '-') text.remove_prefix(1);
  pattern.subtree = text.find_first_of("*?") == std::string_view::npos;
  pattern.levels = split(text, '.');
  for (const std::string& level : pattern.levels) {
    if (level.empty()) {
      throw InputError("trace filter '" + pattern.text +
                       "' has an empty level; write levels of the hierarchy with one '.' between");
    }
    if (level != "**" && level.find("**") != std::string::npos) {
      throw InputError("trace filter '" + pattern.text +
                       "': '**' stands for whole levels; write '*' inside a level");
    }
  }
  return pattern;
}

bool TraceFilter::matches(const Pattern& pattern, std::string_view path) {
  const Levels levels = split(path, '.');
  if (!pattern.subtree) return levels_match(pattern.levels, 0, levels, 0);
  return pattern.levels.size() <= levels.size() &&
         std::equal(pattern.levels.begin(), pattern.levels.end(), levels.begin());
}

bool TraceFilter::selects(std::string_view path) const {
  bool selected = patterns_.empty() || !patterns_.front().take;
  for (const Pattern& pattern : patterns_) {
    if (pattern.take != selected && matches(pattern, path)) selected = pattern.take;
  }
  return selected;
}

void TraceFilter::check(const std::vector<std::string>& paths,
                        const std::vector<std::string>& hidden) const {
  if (paths.empty()) {
    throw InputError(hidden.empty()
                         ? "nothing to trace: this platform has no signals; trace a clocked model"
                         : "nothing to trace: there are registers only; choose the trace level "
                           "that shows registers");
  }
  for (const Pattern& pattern : patterns_) {
    const auto fits = [&](const std::string& path) { return matches(pattern, path); };
    if (!pattern.take || std::any_of(paths.begin(), paths.end(), fits)) continue;
    if (std::any_of(hidden.begin(), hidden.end(), fits)) {
      throw InputError("trace filter '" + pattern.text +
                       "' matches registers only; choose the trace level that shows registers");
    }
    throw InputError("trace filter '" + pattern.text + "' matches no signal; " +
                     suggestion(pattern, paths));
  }
  const auto selected = [&](const std::string& path) { return selects(path); };
  if (std::none_of(paths.begin(), paths.end(), selected)) {
    throw InputError("the trace filter leaves out all " + std::to_string(paths.size()) +
                     " signals; remove a '-' pattern, for example '" + patterns_.back().text + "'");
  }
}

std::string TraceFilter::suggestion(const Pattern& pattern, const std::vector<std::string>& paths) {
  std::size_t deepest = 0;
  for (const std::string& path : paths) {
    deepest = std::max(deepest, levels_in_common(pattern.levels, split(path, '.')));
  }
  const Levels parent(pattern.levels.begin(), pattern.levels.begin() + deepest);
  const bool any_depth = deepest < pattern.levels.size() && pattern.levels[deepest] == "**";
  std::set<std::string> names;
  for (const std::string& path : paths) {
    const Levels levels = split(path, '.');
    if (levels_in_common(pattern.levels, levels) != deepest || deepest == levels.size()) continue;
    names.insert(any_depth ? levels.back() : levels[deepest]);
  }
  if (names.empty()) return "'" + join(parent, ".") + "' is a signal, there is nothing below it";
  const std::string where = parent.empty() ? "" : "below '" + join(parent, ".") + "' ";
  const bool to_the_end = any_depth || deepest == pattern.levels.size();
  const std::string& wanted = to_the_end ? pattern.levels.back() : pattern.levels[deepest];
  std::vector<std::string> sorted = nearest_first(names, wanted);
  const bool more = sorted.size() > names_suggested;
  if (more) sorted.resize(names_suggested);
  return where + "there " + (sorted.size() == 1 ? "is " : "are ") + join(sorted, ", ") +
         (more ? " and others" : "");
}

std::uint32_t find_path(const std::string& name, const std::vector<std::string>& paths,
                        const std::string& where) {
  std::vector<std::string> fitting;
  std::uint32_t place = 0;
  const std::string ending = "." + name;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (paths[i] == name) return static_cast<std::uint32_t>(i);
    if (paths[i].size() <= ending.size() ||
        paths[i].compare(paths[i].size() - ending.size(), ending.size(), ending) != 0) {
      continue;
    }
    place = static_cast<std::uint32_t>(i);
    fitting.push_back(paths[i]);
  }
  if (fitting.size() == 1) return place;
  constexpr std::size_t most = 4;
  if (fitting.size() > most) fitting.resize(most);
  if (!fitting.empty()) {
    throw InputError(where + "'" + name + "' may be " + one_of(fitting) + ": write more of it");
  }
  const std::string nearest = nearest_match(name, paths);
  throw InputError(where + "there is no signal '" + name + "'" +
                   (nearest.empty() ? "" : "; did you mean '" + nearest + "'?"));
}

}  // namespace vp
