#include <fpga/power/power_table.h>

#include <host/document.h>
#include <host/process.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <string_view>

namespace platform::power {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int version = 1;

std::vector<fs::path> table_folders() {
  std::vector<fs::path> folders;
  for (const std::string& folder : host::library_folders())
    folders.push_back(fs::path(folder) / "power");
  return folders;
}

fs::path table_path(const std::string& name) {
  if (fs::path(name).extension() == ".json") return name;
  std::vector<std::string> installed;
  std::error_code ignored;
  for (const fs::path& folder : table_folders()) {
    fs::path file = folder / (name + ".json");
    if (fs::exists(file, ignored)) return file;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
      if (entry.path().extension() == ".json") installed.push_back(entry.path().stem().string());
    }
  }
  if (installed.empty()) {
    throw vp::InputError("no power table '" + name + "': none are installed in " +
                         table_folders().front().string() + "; install markervp completely");
  }
  std::sort(installed.begin(), installed.end());
  throw vp::InputError("no power table '" + name + "': give " + vp::one_of(installed) +
                       ", or a file that ends in .json");
}

/// The file, with the errors that its reader finds.
class Reader {
 public:
  Reader(fs::path path, std::string_view contents) : path_(std::move(path)) {
    root_ = host::parse_json<Json>(contents, "power table '" + path_.string() + "'");
    if (!root_.is_object()) refuse("it is not a JSON object");
    only(root_, {"version", "device", "name", "entries"}, "the table");
    if (member(root_, "version", "the table") != version) {
      refuse("its version is " + root_["version"].dump() + ", this program reads version " +
             std::to_string(version));
    }
    if (text(root_, "device", "the table") != PowerTable::part) {
      refuse("it is for device " + root_["device"].dump() + ", the coefficients are those of an " +
             PowerTable::part);
    }
    if (!member(root_, "entries", "the table").is_array()) refuse("'entries' is not a list");
  }

  std::string name() const { return text(root_, "name", "the table"); }

  std::map<std::string, Coefficient> entries() const {
    std::map<std::string, Coefficient> found;
    for (const Json& json : root_["entries"]) {
      Coefficient entry = read(json, "entry " + std::to_string(found.size() + 1));
      const std::string key = entry.name;
      if (!found.emplace(key, std::move(entry)).second) refuse("'" + key + "' is there twice");
    }
    return found;
  }

  [[noreturn]] void refuse(const std::string& problem) const {
    throw vp::InputError("power table '" + path_.string() + "': " + problem);
  }

 private:
  const KnownCoefficient& known(const std::string& name) const {
    std::vector<std::string> names;
    for (const KnownCoefficient& candidate : known_coefficients()) {
      if (candidate.name == name) return candidate;
      names.emplace_back(candidate.name);
    }
    const std::string nearest = vp::nearest_match(name, names);
    refuse("'" + name + "' is unknown" +
           (nearest.empty() ? "" : " (did you mean '" + nearest + "'?)"));
  }

  Coefficient read(const Json& json, const std::string& where) const {
    if (!json.is_object()) refuse(where + " is not an object");
    Coefficient entry;
    entry.name = text(json, "name", where);
    const std::string here = "'" + entry.name + "'";
    const KnownCoefficient& expected = known(entry.name);
    only(json, {"name", "unit", "low", "nominal", "high", "status", "source"}, here);
    entry.unit = text(json, "unit", here);
    if (entry.unit != expected.unit) {
      refuse(here + " is in '" + entry.unit + "': write it in " + expected.unit);
    }
    entry.value = {number(json, "low", expected), number(json, "nominal", expected),
                   number(json, "high", expected)};
    if (entry.value.low > entry.value.nominal || entry.value.nominal > entry.value.high) {
      refuse(here + " is not in order: low <= nominal <= high");
    }
    entry.status = text(json, "status", here);
    const std::vector<std::string> allowed = {"measured", "published", "derived", "assumed"};
    if (std::find(allowed.begin(), allowed.end(), entry.status) == allowed.end()) {
      refuse("'status' of " + here + " is '" + entry.status + "': give " + vp::one_of(allowed));
    }
    entry.source = text(json, "source", here);
    return entry;
  }

  double number(const Json& json, const char* key, const KnownCoefficient& expected) const {
    const std::string here = std::string("'") + expected.name + "'";
    const Json& found = member(json, key, here);
    const std::string what = "'" + std::string(key) + "' of " + here;
    if (!found.is_number()) refuse(what + " is not a number");
    const double value = found.get<double>();
    if (!std::isfinite(value) || value < 0 || value > expected.most) {
      refuse(what + " is " + found.dump() + ": give a number from 0 to " +
             Json(expected.most).dump() + " " + expected.unit);
    }
    return value;
  }

  const Json& member(const Json& json, const std::string& key, const std::string& where) const {
    const auto found = json.find(key);
    if (found == json.end()) refuse("'" + key + "' of " + where + " is missing");
    return *found;
  }

  std::string text(const Json& json, const std::string& key, const std::string& where) const {
    const Json& found = member(json, key, where);
    if (!found.is_string() || found.get<std::string>().empty()) {
      refuse("'" + key + "' of " + where + " is not a text");
    }
    return found.get<std::string>();
  }

  void only(const Json& json, const std::set<std::string>& known, const std::string& where) const {
    for (const auto& [key, value] : json.items()) {
      if (known.count(key) == 0) refuse("'" + key + "' of " + where + " is unknown");
    }
  }

  fs::path path_;
  Json root_;
};

std::string shortest(double value) {
  return Json(value).dump();
}

}  // namespace

PowerTable PowerTable::load(const std::string& name) {
  static host::KeptDocuments<PowerTable> read;
  const fs::path path = table_path(name);
  return *read.get(path, vp::read_text(path, "power table"), [&](const std::string& text) {
    const Reader reader(path, text);
    std::map<std::string, Coefficient> found = reader.entries();
    PowerTable table;
    table.name_ = reader.name();
    for (const KnownCoefficient& known : known_coefficients()) {
      const auto entry = found.find(known.name);
      if (entry == found.end()) reader.refuse(std::string("'") + known.name + "' is missing");
      table.entries_.push_back(std::move(entry->second));
    }
    return table;
  });
}

const Coefficient& PowerTable::at(const std::string& name) const {
  for (const Coefficient& entry : entries_) {
    if (entry.name == name) return entry;
  }
  throw std::logic_error("the power model knows no coefficient '" + name + "'");
}

std::string PowerTable::hash() const {
  std::uint64_t hash = 0xcbf29ce484222325;
  const auto mix = [&hash](const std::string& text) {
    for (const unsigned char byte : text) hash = (hash ^ byte) * 0x100000001b3;
    hash = hash * 0x100000001b3;
  };
  mix(name_);
  for (const Coefficient& entry : entries_) {
    for (const double value : {entry.value.low, entry.value.nominal, entry.value.high}) {
      mix(shortest(value));
    }
  }
  std::string digits;
  for (int shift = 60; shift >= 0; shift -= 4) digits += "0123456789abcdef"[(hash >> shift) & 15];
  return digits;
}

std::string as_markdown(const PowerTable& table) {
  std::string text =
      "| Coefficient | Low | Nominal | High | Unit | Status | Source |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const Coefficient& entry : table.entries()) {
    text += "| `" + entry.name + "` | " + shortest(entry.value.low) + " | " +
            shortest(entry.value.nominal) + " | " + shortest(entry.value.high) + " | " +
            entry.unit + " | " + entry.status + " | " + entry.source + " |\n";
  }
  return text;
}

const std::vector<KnownCoefficient>& known_coefficients() {
  static const std::vector<KnownCoefficient> all = {
      {"ps.core_cycle", "nJ/cycle", 10},
      {"ps.default_load", "1", 1},
      {"ps.default_cores", "1", 2},
      {"ps.uncore_32", "W", 5},
      {"ps.uncore_16", "W", 5},
      {"ps.pll", "W", 1},
      {"ps.aux_32", "W", 1},
      {"ps.aux_16", "W", 1},
      {"ps.mio", "W", 1},
      {"ps.ddr_current_32", "A", 5},
      {"ps.ddr_slope_32", "A/MHz", 0.01},
      {"ps.ddr_current_16", "A", 5},
      {"ps.ddr_slope_16", "A/MHz", 0.01},
      {"ps.ddr_low_voltage", "1", 1},
      {"ps.ddr_idle_share", "1", 1},
      {"ps.ddr_line_stall", "ns", 10'000},
      {"ps.hp_port", "mW/MHz", 10},
      {"static.base", "W", 5},
      {"static.leakage", "W", 5},
      {"static.slope", "1/C", 0.2},
      {"static.bram", "mW", 10},
      {"static.older_tool_7020", "W", 1},
      {"static.older_tool_7010", "W", 1},
      {"static.share_vccpint", "1", 0.5},
      {"static.share_vccint", "1", 0.5},
      {"pl.logic", "mW/(kLUT MHz)", 10},
      {"pl.logic_depth", "1", 2},
      {"pl.logic_rest", "mW/(kLUT MHz)", 10},
      {"pl.logic_control", "mW/(kLUT MHz)", 10},
      {"pl.logic_arithmetic", "mW/(kLUT MHz)", 10},
      {"pl.logic_cipher", "mW/(kLUT MHz)", 10},
      {"pl.logic_simulated", "mW/(kLUT MHz)", 10},
      {"pl.clock", "mW/(kFF MHz)", 10},
      {"pl.clock_root", "mW/MHz", 1},
      {"pl.clock_branch", "mW/(MHz sqrt(kFF))", 1},
      {"pl.bram", "uW/MHz", 1000},
      {"pl.bram_always", "uW/MHz", 1000},
      {"pl.bram_traffic", "uW/MHz", 1000},
      {"pl.bram_buffer", "uW/MHz", 1000},
      {"pl.bram_rest", "uW/MHz", 1000},
      {"pl.bram_read", "pJ", 1000},
      {"pl.dsp", "uW/MHz", 1000},
      {"pl.dsp_busy", "uW/MHz", 1000},
      {"pl.dsp_shared", "uW/MHz", 1000},
      {"pl.dsp_rest", "uW/MHz", 1000},
      {"pl.mmcm", "W", 1},
      {"pl.mmcm_oscillator", "W/GHz", 1},
      {"pl.mmcm_fractional", "W/GHz", 1},
      {"pl.pll", "W/GHz", 1},
      {"pl.io", "uW/(pin MHz)", 10'000},
      {"pl.tmds_pair", "W", 1},
      {"ip.blob_detection", "mW/MHz", 100},
      {"ip.blob_detection_net", "mW/MHz", 100},
      {"ip.axi_dma", "mW/MHz", 10},
      {"ip.axi_gpio", "mW/MHz", 10},
      {"ip.proc_sys_reset", "mW/MHz", 10},
      {"ip.axi_interconnect", "mW/MHz", 10},
  };
  return all;
}

}  // namespace platform::power
