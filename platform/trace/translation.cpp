#include <trace/translation.h>

#include <algorithm>
#include <iterator>

namespace platform::trace {

namespace {

constexpr const char *function_file_name = "function.flt", *feature_file_name = "feature.flt";

/// Signals whose values have names, and the file that says them.
const std::map<std::string, std::string>& translated() {
  static const std::map<std::string, std::string> files = {
      {"ps.cpu.function", function_file_name},
      {"ps.gic.active", "interrupt.flt"},
      {"pl.concat.dout", "interrupt_lines.flt"},
      {"pl.corner_detection.new_direction", "direction.flt"},
      {"pl.corner_detection.centre_direction", "direction.flt"},
      {"pl.corner_detection.corner_data", feature_file_name},
      {"pl.blob_detection.blob_start", feature_file_name},
      {"pl.blob_detection.blob_end", feature_file_name},
      {"pl.clock_crossing.corner.word", feature_file_name},
      {"pl.clock_crossing.blob.word", feature_file_name},
      {"pl.clock_crossing.blob.second_word", feature_file_name},
      {"pl.feature_packaging.feature", feature_file_name}};
  return files;
}

/// Those that are the same in every trace.
const std::map<std::string, std::string>& fixed_files() {
  static const std::map<std::string, std::string> files = {
      // UG585 table 7-4.
      {"interrupt.flt",
       "3FF -\n01B ?dark green?global timer\n01D ?dark green?private timer\n"
       "03D ?dark blue?DMA 0: image\n03E ?dark red?DMA 1: binary image\n"},
      {"interrupt_lines.flt",
       "0 -\n1 ?dark blue?image\n2 ?dark red?binary image\n3 ?purple4?both\n"},
      // Thesis table 4.4.
      {"direction.flt", "0 North\n1 South\n2 East\n3 West\n"}};
  return files;
}

/// Words that a translate file names; a trace of many frames has more.
constexpr std::size_t most_words = 20'000;

std::string hex_of(std::uint64_t value, unsigned width) {
  std::string text((width + 3) / 4, '0');
  for (auto digit = text.rbegin(); digit != text.rend(); ++digit, value >>= 4) {
    *digit = "0123456789ABCDEF"[value & 0xF];
  }
  return text;
}

/// Thesis table 4.4: what a feature word says.
std::string meaning(std::uint64_t word) {
  constexpr std::uint64_t end = 0xFFFF'FFFF, corner = 1u << 31, start = 1u << 30;
  if (word == end) return "?dark red?end of frame";
  const std::string place = std::to_string(word & 0x3FF) + "," + std::to_string(word >> 10 & 0x1FF);
  if ((word & corner) != 0) {
    return "?dark blue?corner " + place + " " + "NSEW"[word >> 19 & 3] + " " +
           std::to_string(word >> 21 & 0x3FF);
  }
  const std::string number = std::to_string(word >> 19 & 0x7FF);
  return "?dark green?blob " + number + ((word & start) != 0 ? " from " : " to ") + place;
}

}  // namespace

Translation::Translation(TraceFile& file, Replay& replay) : file_(file), replay_(replay) {
  const int number = file.find("ps.cpu.function"), name = file.find("ps.cpu.function_name");
  has_functions_ = number >= 0 && name >= 0;
  if (has_functions_) {
    function_width_ = file.variable(static_cast<std::uint32_t>(number)).width;
    function_ = replay.watch(static_cast<std::uint32_t>(number));
    function_name_ = replay.watch(static_cast<std::uint32_t>(name));
  }
  for (const auto& [path, name_of_file] : translated()) {
    const int variable = file.find(path);
    if (variable < 0 || name_of_file != feature_file_name) continue;
    packets_.push_back(replay.watch(static_cast<std::uint32_t>(variable)));
  }
}

bool Translation::instant(std::uint64_t) {
  if (has_functions_ && replay_.known(function_) && replay_.bits(function_) != 0) {
    functions_[replay_.bits(function_)] = replay_.text(function_name_);
  }
  if (words_.size() >= most_words) return true;
  for (const Replay::Slot slot : packets_) {
    if (replay_.known(slot) && replay_.bits(slot) != 0) words_.insert(replay_.bits(slot));
  }
  return true;
}

std::string Translation::file_for(const std::string& path) const {
  const auto found = translated().find(path);
  if (found == translated().end()) return "";
  return found->second == function_file_name && !has_functions_ ? "" : found->second;
}

std::vector<std::pair<std::string, std::string>> Translation::files() const {
  std::set<std::string> names;
  for (const auto& [path, name] : translated()) {
    if (file_.find(path) >= 0 && !file_for(path).empty()) names.insert(name);
  }
  std::vector<std::pair<std::string, std::string>> result;
  for (const std::string& name : names) {
    const auto fixed = fixed_files().find(name);
    result.emplace_back(name, fixed != fixed_files().end() ? fixed->second
                              : name == function_file_name ? function_file()
                                                           : feature_file());
  }
  return result;
}

std::string Translation::function_file() const {
  static const char* const colours[] = {"dark blue", "dark green", "dark red", "brown",
                                        "purple4",   "dark cyan",  "gray30",   "sienna"};
  std::string text = hex_of(0, function_width_) + " -\n";
  std::size_t i = 0;
  for (const auto& [value, name] : functions_) {
    const char* colour = colours[i++ % std::size(colours)];
    text += hex_of(value, function_width_) + " ?" + colour + "?" + name + "\n";
  }
  return text;
}

std::string Translation::feature_file() const {
  constexpr unsigned width = 32;
  std::string text = hex_of(0, width) + " -\n";
  for (const std::uint64_t word : words_) text += hex_of(word, width) + " " + meaning(word) + "\n";
  return text;
}

}  // namespace platform::trace
