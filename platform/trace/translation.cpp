#include <trace/translation.h>

#include <algorithm>
#include <iterator>

namespace platform::trace {

namespace {

constexpr const char *function_file_name = "function.flt", *interrupt_file_name = "interrupt.flt";

/// Words that a translate file names; a trace of many frames has more.
constexpr std::size_t most_words = 20'000;

std::string hex_of(std::uint64_t value, unsigned width) {
  std::string text((width + 3) / 4, '0');
  for (auto digit = text.rbegin(); digit != text.rend(); ++digit, value >>= 4) {
    *digit = "0123456789ABCDEF"[value & 0xF];
  }
  return text;
}

}  // namespace

Translation::Translation(TraceFile& file, Replay& replay, const Vocabulary& words)
    : file_(file), replay_(replay), vocabulary_(words), translated_(words.translated) {
  translated_["ps.cpu.function"] = function_file_name;
  translated_["ps.gic.active"] = interrupt_file_name;
  const int number = file.find("ps.cpu.function"), name = file.find("ps.cpu.function_name");
  has_functions_ = number >= 0 && name >= 0;
  if (has_functions_) {
    function_width_ = file.variable(static_cast<std::uint32_t>(number)).width;
    function_ = replay.watch(static_cast<std::uint32_t>(number));
    function_name_ = replay.watch(static_cast<std::uint32_t>(name));
  }
  for (const auto& [path, name_of_file] : translated_) {
    const int variable = file.find(path);
    if (variable < 0 || name_of_file != Vocabulary::words) continue;
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
  const auto found = translated_.find(path);
  if (found == translated_.end()) return "";
  return found->second == function_file_name && !has_functions_ ? "" : found->second;
}

std::vector<std::pair<std::string, std::string>> Translation::files() const {
  std::set<std::string> names;
  for (const auto& [path, name] : translated_) {
    if (file_.find(path) >= 0 && !file_for(path).empty()) names.insert(name);
  }
  std::vector<std::pair<std::string, std::string>> result;
  for (const std::string& name : names) {
    const auto fixed = vocabulary_.files.find(name);
    result.emplace_back(name, fixed != vocabulary_.files.end() ? fixed->second
                              : name == function_file_name     ? function_file()
                              : name == interrupt_file_name    ? interrupt_file()
                                                               : word_file());
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

// UG585 table 7-4.
std::string Translation::interrupt_file() const {
  constexpr unsigned width = 10;
  std::string text = "3FF -\n01B ?dark green?global timer\n01D ?dark green?private timer\n";
  for (const Vocabulary::Interrupt& interrupt : vocabulary_.interrupts) {
    text += hex_of(interrupt.id, width) + " ?" + interrupt.colour + "?" + interrupt.text + "\n";
  }
  return text;
}

std::string Translation::word_file() const {
  constexpr unsigned width = 32;
  std::string text = hex_of(0, width) + " -\n";
  for (const std::uint64_t word : words_)
    text += hex_of(word, width) + " " + vocabulary_.meaning(word) + "\n";
  return text;
}

}  // namespace platform::trace
