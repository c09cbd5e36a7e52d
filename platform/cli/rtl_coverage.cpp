#include <cli/rtl_coverage.h>

#include <vp/error.h>
#include <vp/file.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <set>
#include <sstream>

namespace platform::cli {

namespace {

/// A point is a list of \1 key \2 value.
std::string value_of(const std::string& point, const std::string& key) {
  const std::string begin = "\1" + key + "\2";
  const std::size_t at = point.find(begin);
  if (at == std::string::npos) return "";
  const std::size_t from = at + begin.size();
  return point.substr(from, point.find('\1', from) - from);
}

bool is_kind(const std::string& point, const std::string& kind) {
  return value_of(point, "page").rfind(kind + "/", 0) == 0;
}

}  // namespace

// C 'point' count
void RtlCoverage::add(const std::string& file) {
  if (!std::filesystem::exists(file)) return;
  std::istringstream lines(vp::read_text(file, "coverage", std::numeric_limits<int>::max()));
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] != 'C') continue;
    const std::size_t end = line.rfind("' ");
    if (line.rfind("C '", 0) != 0 || end == std::string::npos || end < 3)
      throw vp::InputError("'" + file + "' is no coverage of Verilator: " + line);
    counts_[line.substr(3, end - 3)] += std::stoull(line.substr(end + 2));
  }
}

std::pair<std::uint64_t, std::uint64_t> RtlCoverage::reached(const std::string& kind) const {
  std::pair<std::uint64_t, std::uint64_t> result;
  for (const auto& [point, count] : counts_) {
    if (!is_kind(point, kind)) continue;
    result.first += count != 0;
    ++result.second;
  }
  return result;
}

std::vector<std::string> RtlCoverage::missed_lines() const {
  std::set<std::pair<std::string, int>> missed;
  for (const auto& [point, count] : counts_) {
    if (count == 0 && is_kind(point, "v_line"))
      missed.emplace(std::filesystem::path(value_of(point, "f")).filename().string(),
                     std::atoi(value_of(point, "l").c_str()));
  }
  std::vector<std::string> lines;
  lines.reserve(missed.size());
  for (const auto& [file, line] : missed) lines.push_back(file + ":" + std::to_string(line));
  return lines;
}

}  // namespace platform::cli
