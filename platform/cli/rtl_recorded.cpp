#include <cli/rtl_recorded.h>

#include <set>
#include <sstream>

#include <vp/error.h>
#include <vp/file.h>

namespace platform::cli {

RecordedPins read_recorded(const std::string& file) {
  std::istringstream lines(vp::read_text(file, "stimulus"));
  RecordedPins pins;
  std::string line;
  std::getline(lines, line);
  std::istringstream names(line);
  for (std::string name; names >> name;) pins.names.push_back(name);
  std::size_t number = 1;
  const auto refuse = [&](const std::string& why) {
    throw vp::InputError("stimulus '" + file + "', line " + std::to_string(number) + ": " + why);
  };
  if (pins.names.empty()) refuse("give the names of the inputs");
  if (std::set<std::string>(pins.names.begin(), pins.names.end()).size() != pins.names.size())
    refuse("each input has a name of its own");
  while (std::getline(lines, line)) {
    ++number;
    if (line.find_first_of("+-") != std::string::npos) refuse("numbers have no sign");
    std::istringstream words(line);
    std::vector<std::uint64_t>& row = pins.rows.emplace_back();
    for (std::uint64_t value = 0; words >> std::hex >> value;) row.push_back(value);
    if (!words.eof() || row.size() != pins.names.size())
      refuse("give " + std::to_string(pins.names.size()) + " hexadecimal numbers");
  }
  if (pins.rows.empty()) refuse("no clock follows the names");
  return pins;
}

}  // namespace platform::cli
