#include <trace/trace_file.h>

#include <algorithm>
#include <map>
#include <sstream>

#include <vp/error.h>
#include <vp/input_file.h>
#include <vp/text.h>
#include <vp/trace_filter.h>

namespace platform::trace {

NameMap read_name_map(const std::string& file) {
  std::istringstream stream(vp::read_text(file, "map"));
  NameMap map;
  map.file = file;
  std::map<std::string, std::uint64_t> line_of;
  std::string line;
  for (std::uint64_t number = 1; std::getline(stream, line); ++number) {
    const std::string text(vp::trim(line.substr(0, line.find('#'))));
    if (text.empty()) continue;
    const auto sign = text.find('=');
    const auto fail = [&](const std::string& problem) {
      throw vp::InputError("map '" + file + "', line " + std::to_string(number) + ": " + problem);
    };
    if (sign == std::string::npos) fail("'" + text + "' should be 'ours = theirs'");
    NameMap::Entry entry{std::string(vp::trim(text.substr(0, sign))),
                         std::string(vp::trim(text.substr(sign + 1))), number};
    if (entry.ours.empty() || entry.theirs.empty()) fail("a name is missing beside '='");
    const auto [other, is_new] = line_of.emplace(entry.ours, number);
    if (!is_new)
      fail("'" + entry.ours + "' was named in line " + std::to_string(other->second) + " already");
    map.entries.push_back(std::move(entry));
  }
  return map;
}

TraceFile::TraceFile(const std::string& file, const NameMap& map) : name_(file), reader_(file) {
  std::vector<std::string> theirs;
  for (const vp::WaveVariable& variable : reader_.variables()) theirs.push_back(variable.path);
  paths_ = theirs;
  for (const NameMap::Entry& entry : map.entries) {
    const std::string where =
        "map '" + map.file + "', line " + std::to_string(entry.line) + ": in '" + file + "' ";
    paths_[vp::find_path(entry.theirs, theirs, where)] = entry.ours;
  }
}

int TraceFile::find(const std::string& path) const {
  const auto found = std::find(paths_.begin(), paths_.end(), path);
  return found == paths_.end() ? -1 : static_cast<int>(found - paths_.begin());
}

}  // namespace platform::trace
