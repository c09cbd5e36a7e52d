#include <chip/handoff/own_driver.h>

#include <vp/text.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <utility>

namespace platform::handoff {

namespace {

/// Of a file or a folder, so that it stays where it is put.
bool is_name(const std::string& text) {
  return !text.empty() && text.front() != '.' && text.find('/') == std::string::npos;
}

/// Where in a path its driver is: drivers/NAME/src/x.c, or drivers/src/x.c of an IP with one.
struct Place {
  std::string driver, kind;
};

Place place_of(const std::string& path) {
  const std::vector<std::string> parts = vp::split(path, '/');
  if (std::any_of(parts.begin(), parts.end(), [](const auto& part) { return !is_name(part); }))
    return {};
  if (parts.size() < 3 || parts[0] != "drivers") return {};
  const std::string& kind = parts[parts.size() - 2];
  if (kind != "src" && kind != "data") return {};
  if (parts.size() == 3) return {"driver", kind};
  return parts.size() == 4 ? Place{parts[1], kind} : Place{};
}

/// The name of an IP without the version that HLS puts behind it: filter_v1_0.
std::string without_version(const std::string& name) {
  const std::size_t at = name.rfind("_v");
  if (at == std::string::npos || at + 2 == name.size()) return name;
  const bool is_version =
      std::all_of(name.begin() + static_cast<std::ptrdiff_t>(at) + 2, name.end(),
                  [](unsigned char c) { return std::isdigit(c) || c == '_'; });
  return is_version ? name.substr(0, at) : name;
}

/// OPTION supported_peripherals = (filter_v1_0 other);
std::vector<std::string> peripherals_of(const std::string& description) {
  const std::size_t option = description.find("supported_peripherals");
  const std::size_t open = description.find('(', std::min(option, description.size()));
  const std::size_t close = description.find(')', std::min(open, description.size()));
  std::vector<std::string> names;
  if (close == std::string::npos) return names;
  std::string word;
  for (const char c : description.substr(open + 1, close - open - 1) + " ") {
    if (!std::isspace(static_cast<unsigned char>(c))) {
      word += c;
    } else if (!word.empty()) {
      names.push_back(without_version(std::exchange(word, "")));
    }
  }
  return names;
}

/// The words in quotation marks behind `command`, up to the end of its line; a '\' continues one.
std::vector<std::string> words_behind(const std::string& script, const std::string& command) {
  std::vector<std::string> words;
  std::size_t at = script.find(command);
  if (at == std::string::npos) return words;
  for (at += command.size(); at < script.size(); ++at) {
    if (script[at] == '\n') break;
    if (script[at] == '\\') {
      at = std::min(script.find('\n', at), script.size());
    } else if (script[at] == '"') {
      const std::size_t end = script.find_first_of("\"\n", at + 1);
      if (end == std::string::npos || script[end] == '\n') break;
      words.push_back(script.substr(at + 1, end - at - 1));
      at = end;
    }
  }
  return words;
}

void add_file(OwnDriver& driver, const std::string& kind, const std::filesystem::path& name,
              const std::string& text) {
  const std::string ending = name.extension().string(), stem = name.stem().string();
  if (kind == "src") {
    const bool is_for_linux = stem.size() > 6 && stem.substr(stem.size() - 6) == "_linux";
    if (ending == ".h" || (ending == ".c" && !is_for_linux))
      driver.sources.emplace_back(name.string(), text);
  } else if (ending == ".mdd") {
    driver.peripherals = peripherals_of(text);
  } else if (ending == ".tcl") {
    // The vendor's tools have them without the x, too: ::hsi::utils::define_include_file.
    for (const std::string command :
         {"xdefine_include_file", "xdefine_config_file", "xdefine_canonical_xpars"}) {
      auto words = words_behind(text, command.substr(1));
      if (!words.empty()) driver.scripts[command] = std::move(words);
    }
  }
}

}  // namespace

bool OwnDriver::drives(const std::string& ip) const {
  return std::find(peripherals.begin(), peripherals.end(), ip) != peripherals.end();
}

bool OwnDriver::has(const std::string& source) const {
  return std::any_of(sources.begin(), sources.end(),
                     [&](const auto& one) { return one.first == source; });
}

bool is_of_driver(const std::string& path) {
  return !place_of(path).driver.empty();
}

std::vector<OwnDriver> own_drivers(const std::vector<PathAndText>& files) {
  std::map<std::string, OwnDriver> drivers;
  for (const auto& [path, text] : files) {
    const Place place = place_of(path);
    if (place.driver.empty()) continue;
    OwnDriver& driver = drivers[place.driver];
    driver.name = place.driver;
    add_file(driver, place.kind, std::filesystem::path(path).filename(), text);
  }
  std::vector<OwnDriver> result;
  for (auto& [name, driver] : drivers) {
    if (driver.sources.empty() || driver.peripherals.empty()) continue;
    if (name == "driver" && is_name(driver.peripherals.front()))
      driver.name = driver.peripherals.front();
    result.push_back(std::move(driver));
  }
  return result;
}

}  // namespace platform::handoff
