#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>

#include <trace/replay.h>
#include <trace/tools.h>
#include <vp/file.h>

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
  const std::int64_t number = file.find("ps.cpu.function"),
                     name = file.find("ps.cpu.function_name");
  has_functions_ = number >= 0 && name >= 0;
  if (has_functions_) {
    function_width_ = file.variable(static_cast<std::uint32_t>(number)).width;
    function_ = replay.watch(static_cast<std::uint32_t>(number));
    function_name_ = replay.watch(static_cast<std::uint32_t>(name));
  }
  for (const std::string& field : words.fields) {
    const std::int64_t signal = file.find(field);
    field_widths_.push_back(signal < 0 ? 0u
                                       : file.variable(static_cast<std::uint32_t>(signal)).width);
  }
  for (const auto& [path, name_of_file] : translated_) {
    if (name_of_file != Vocabulary::words) continue;
    if (const auto packet = replay.follow(path)) packets_.push_back(*packet);
  }
  const auto irq_f2p = replay.follow(words.irq_f2p);
  for (const Vocabulary::Interrupt& known : words.interrupts) {
    const auto line = replay.follow(known.line);
    if (line) interrupts_.try_emplace(known.line, replay, *line, irq_f2p, known.id);
  }
}

bool Translation::instant(std::uint64_t) {
  for (auto& [path, line] : interrupts_) line.rises();
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
    const auto line = interrupts_.find(interrupt.line);
    const std::uint64_t id = line == interrupts_.end() ? interrupt.id : line->second.id();
    text += hex_of(id, width) + " ?" + interrupt.colour + "?" + interrupt.text + "\n";
  }
  return text;
}

std::string Translation::word_file() const {
  constexpr unsigned width = 32;
  std::string text = hex_of(0, width) + " -\n";
  for (const std::uint64_t word : words_)
    text += hex_of(word, width) + " " + vocabulary_.meaning(word, field_widths_) + "\n";
  return text;
}

namespace {

namespace fs = std::filesystem;
using Kind = vp::WaveVariable::Kind;

/// Formats of GTKWave's save files: right-justified, and how the value is shown.
constexpr const char *as_title = "@200", *as_bit = "@28", *as_hex = "@22", *as_decimal = "@24",
                     *as_translated = "@2022", *as_curve = "@8420";

/// The signals of the system's page, by group. Those that a trace lacks are left out.
std::vector<Vocabulary::Group> system_groups(const Vocabulary& words) {
  std::vector<Vocabulary::Group> groups = {
      {"Software",
       {"ps.cpu.frame", "ps.cpu.results", "ps.cpu.function", "ps.cpu.function_name",
        "ps.cpu.handler_name", "ps.cpu.in_handler", "ps.cpu.asleep", "ps.cpu.m_axi.access"}},
      {"Interrupts", {}}};
  for (const auto& interrupt : words.interrupts) groups.back().paths.push_back(interrupt.line);
  groups.back().paths.insert(groups.back().paths.end(), {"ps.gic.n_irq", "ps.gic.active"});
  groups.insert(groups.end(), words.groups.begin(), words.groups.end());
  groups.push_back({"Power", {"power.total", "power.ps", "power.pl"}});
  return groups;
}

bool is_count(const std::string& path) {
  static const char* const endings[] = {"_count",    "_x",     "_y",    "threshold",
                                        "_overflow", "depth",  "frame", "results",
                                        "pixel",     "bursts", "_bytes"};
  return std::any_of(std::begin(endings), std::end(endings), [&](const std::string& ending) {
    return path.size() > ending.size() &&
           path.compare(path.size() - ending.size(), ending.size(), ending) == 0;
  });
}

/// "pl.filter" of "pl.filter.sum_out"; "" for what is in no IP.
std::string ip_of(const std::string& path) {
  const auto first = path.find('.');
  const auto second = first == std::string::npos ? first : path.find('.', first + 1);
  return second == std::string::npos ? "" : path.substr(0, second);
}

/// The unit of GTKWave's times: s, ms, us, ns, ps or fs; a timescale of 10 ns counts ns, too.
std::uint64_t unit_fs(std::uint64_t timescale_fs) {
  std::uint64_t unit = 1;
  while (unit * 1000 <= timescale_fs) unit *= 1000;
  return unit;
}

}  // namespace

// GTKWave's zoom is the negative binary logarithm of the time that 200 pixels show.
std::string save_file_text(const SaveFile& save) {
  constexpr double waves = 1400 - 200 - 320 - 40;  // pixels of the window beside both lists
  constexpr double zoomed = 200;
  const std::uint64_t unit = unit_fs(save.timescale_fs);
  const auto steps = [unit](std::uint64_t ps) {
    return std::to_string(
        static_cast<std::uint64_t>(static_cast<unsigned __int128>(ps) * 1000 / unit));
  };
  const double span =
      static_cast<double>(save.end_ps - save.start_ps) * 1000 / static_cast<double>(unit);
  std::string text = "[*] " + save.comment + "\n[timestart] " + steps(save.start_ps) +
                     "\n[size] 1400 900\n[pos] -1 -1\n";
  text += "*" + std::to_string(-std::log2(std::max(span, 1.0) / waves * zoomed)) + " " +
          (save.marker_ps ? steps(*save.marker_ps) : "-1");
  for (int i = 0; i < 26; ++i) text += " -1";  // the named markers
  text += "\n[sst_width] 200\n[signals_width] 320\n[sst_expanded] 0\n";
  for (const SaveFile::Line& line : save.lines) {
    if (line.title) {
      text += std::string(as_title) + "\n-" + line.path + "\n";
      continue;
    }
    const bool vector = line.kind == Kind::bits && line.width > 1;
    const char* format = line.kind == Kind::real   ? as_curve
                         : !line.translate.empty() ? as_translated
                         : !vector                 ? as_bit
                         : line.decimal            ? as_decimal
                                                   : as_hex;
    text += std::string(format) + "\n";
    if (!line.translate.empty()) text += "^1 " + line.translate + "\n";
    text += line.path + (vector ? "[" + std::to_string(line.width - 1) + ":0]" : "") + "\n";
  }
  return text;
}

std::uint64_t steps_of(std::uint64_t ps, std::uint64_t timescale_fs) {
  constexpr unsigned fs_per_ps = 1000;
  return static_cast<std::uint64_t>(static_cast<unsigned __int128>(ps) * fs_per_ps / timescale_fs);
}

std::string surfer_commands(const SaveFile& save) {
  std::string text;
  for (const SaveFile::Line& line : save.lines)
    text += (line.title ? "divider_add " : "variable_add ") + line.path + "\n";
  if (!save.marker_ps) return text + "zoom_fit\n";
  return text + "cursor_set " + std::to_string(steps_of(*save.marker_ps, save.timescale_fs)) +
         "\ngoto_cursor\n";
}

std::string vaporview_settings(const SaveFile& save) {
  using Json = nlohmann::ordered_json;
  Json groups = Json::array();
  // Signals before the first title are in no group.
  Json* signals = &groups;
  for (const SaveFile::Line& line : save.lines) {
    if (line.title) {
      groups.push_back(
          {{"dataType", "signal-group"}, {"groupName", line.path}, {"children", Json::array()}});
      signals = &groups.back()["children"];
      continue;
    }
    const bool vector = line.kind == Kind::bits && line.width > 1;
    Json signal{{"dataType", "netlist-variable"}, {"name", line.path}};
    if (vector) signal["numberFormat"] = line.decimal ? "decimal" : "hexadecimal";
    signals->push_back(std::move(signal));
  }
  Json settings;
  if (save.marker_ps) settings["markerTime"] = steps_of(*save.marker_ps, save.timescale_fs);
  settings["displayedSignals"] = std::move(groups);
  return settings.dump(2) + "\n";
}

std::vector<SaveFile::Line> save_lines(const TraceFile& file,
                                       const std::vector<std::string>& paths) {
  std::vector<SaveFile::Line> lines;
  for (const std::string& path : paths) {
    const std::int64_t found = file.find(path);
    if (found < 0) continue;
    const auto place = static_cast<std::uint32_t>(found);
    const vp::WaveVariable& variable = file.variable(place);
    SaveFile::Line line;
    line.path = file.reader().paths()[place];  // as the file has it
    line.width = variable.width;
    line.kind = variable.kind;
    line.decimal = is_count(path);
    lines.push_back(std::move(line));
  }
  return lines;
}

std::vector<std::string> write_save_files(TraceFile& file, const Vocabulary& words,
                                          const std::string& folder) {
  Replay replay(file);
  Translation translation(file, replay, words);
  replay.watch(0u);
  replay.run(translation);
  const fs::path root(folder);
  std::vector<std::string> written;
  const auto put = [&](const std::string& name, const std::string& text) {
    vp::write_file((root / name).string(), text);
    written.push_back((root / name).string());
  };

  const auto with_names = [&](std::vector<SaveFile::Line> lines) {
    for (SaveFile::Line& line : lines) {
      const std::string name = translation.file_for(line.path);
      // GTKWave looks from where it is started.
      if (!name.empty()) line.translate = (root / name).lexically_normal().string();
    }
    return lines;
  };
  SaveFile page;
  page.start_ps = replay.first_ps();
  page.end_ps = replay.last_ps();
  page.timescale_fs = file.reader().timescale_fs();

  page.comment = "The whole system: software, interrupts, control, pixels, features, streams.";
  for (const Vocabulary::Group& group : system_groups(words)) {
    const auto lines = with_names(save_lines(file, group.paths));
    if (lines.empty()) continue;
    SaveFile::Line title;
    title.path = group.title;
    title.title = true;
    page.lines.push_back(title);
    page.lines.insert(page.lines.end(), lines.begin(), lines.end());
  }
  if (!page.lines.empty()) {
    put("system.gtkw", save_file_text(page));
    put("system.sucl", surfer_commands(page));
    put("system.vaporview.json", vaporview_settings(page));
  }

  std::map<std::string, std::vector<std::string>> ips;
  for (const std::string& path : file.paths()) {
    if (!ip_of(path).empty()) ips[ip_of(path)].push_back(path);
  }
  for (const auto& [ip, paths] : ips) {
    page.comment = "All traced signals of " + ip + ".";
    page.lines = with_names(save_lines(file, paths));
    put(ip.substr(ip.find('.') + 1) + ".gtkw", save_file_text(page));
  }
  for (const auto& [name, text] : translation.files()) put(name, text);
  return written;
}

}  // namespace platform::trace
