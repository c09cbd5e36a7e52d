#include <fpga/power/design_figures.h>

#include <fpga/power/power_table.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>
#include <vp/unit.h>
#include <vp/yaml.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <utility>

namespace platform::power {

namespace {

using device::Figure;
using device::hz_per_mhz;

constexpr double per_cent = 1e-2, ghz_per_mhz = 1e-3;
constexpr double default_cpu_mhz = 666.666687,
                 default_ddr_mhz = 533.333374;  // of ZedBoard's preset
constexpr double most_mhz = 1000, most_pins = 400, most_managers = 8, most_known_w = 20;
/// Of the slowest and the fastest speed grade of 7 series.
constexpr double least_vco_mhz = 600, most_mmcm_vco_mhz = 1600, most_pll_vco_mhz = 2133;
constexpr double hottest_ambient_c = 125, coldest_ambient_c = -55, most_theta_ja = 100;
/// Of Vivado: from 2017.3 on Vccaux leaks 15 mA on an XC7Z020, before 21
/// (calibration/power/refit.py).
constexpr std::pair<int, int> last_older_tool{2017, 2};
constexpr std::size_t longest_version = 12;  ///< "v.2024.1.2"
constexpr int last_minor = 4;                ///< of a year of which only that is said

class FiguresReader {
 public:
  explicit FiguresReader(std::string file) : file_(std::move(file)) {}

  DesignFigures read() {
    const YAML::Node root = vp::load_yaml(vp::read_text(file_, "design figures"), file_);
    if (!root.IsMap()) fail(root, "expected 'key: value' lines: 'clocks:' at least");
    only(root, "a design",
         {"device", "tool", "clocks", "mmcm", "pll", "io", "ps", "ambient", "theta_ja"});
    design_.device = device_of(root["device"]);
    read_clocks(root);
    design_.older_tool = is_older(root["tool"]);
    design_.mmcm = clock_managers(root, "mmcm", most_mmcm_vco_mhz);
    design_.pll = clock_managers(root, "pll", most_pll_vco_mhz);
    if (root["io"]) read_pins(root["io"]);
    read_ps(root["ps"]);
    design_.thermal.ambient_c =
        quantity(root, "ambient", vp::Unit::temperature, 25, coldest_ambient_c, hottest_ambient_c);
    design_.thermal.theta_ja = quantity(root, "theta_ja", vp::Unit::none, 11.5, 0, most_theta_ja);
    return design_;
  }

 private:
  [[noreturn]] void fail(const YAML::Node& node, const std::string& problem) const {
    vp::fail_in_yaml(file_, node.Mark(), problem);
  }

  std::string scalar(const YAML::Node& node, const std::string& key) const {
    if (!node.IsScalar()) fail(node, "'" + key + "' is not one value");
    return node.Scalar();
  }

  void only(const YAML::Node& map, const std::string& what,
            const std::vector<std::string>& keys) const {
    std::set<std::string> seen;
    for (const auto& entry : map) {
      const std::string key = scalar(entry.first, what);
      if (!seen.insert(key).second) fail(entry.first, "'" + key + "' is there twice");
      if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
      const std::string nearest = vp::nearest_match(key, keys);
      fail(entry.first, what + " has no '" + vp::excerpt(key) + "'" +
                            (nearest.empty() ? ": give " + vp::one_of(keys)
                                             : " (did you mean '" + nearest + "'?)"));
    }
  }

  /// In the unit that people write: MHz, percent as a share, else the base unit.
  double quantity(const YAML::Node& map, const std::string& key, vp::Unit unit,
                  std::optional<double> otherwise, double least, double most) const {
    const YAML::Node node = map[key];
    if (!node) {
      if (otherwise) return *otherwise;
      fail(map, "'" + key + "' is missing: write 0 if the design has none");
    }
    return quantity_of(node, key, unit, least, most);
  }

  double quantity_of(const YAML::Node& node, const std::string& key, vp::Unit unit, double least,
                     double most) const {
    const std::string text = scalar(node, key);
    const double scale = unit == vp::Unit::frequency ? 1 / hz_per_mhz
                         : unit == vp::Unit::percent ? per_cent
                                                     : 1;
    double value = 0;
    try {
      value = vp::parse_quantity(text, unit).to_double() * scale;
    } catch (const vp::InputError& error) {
      fail(node, "'" + key + "' = '" + vp::excerpt(text) + "' " + error.what());
    }
    if (value >= least && value <= most) return value;
    const double nearest = value < least ? least : most;
    fail(node, "'" + key + "' = " + vp::excerpt(text) +
                   " is not possible: the nearest that is, is " +
                   vp::format_quantity(vp::Decimal(nearest / scale), unit));
  }

  /// A number of primitives, of which the device has `most`.
  double count(const YAML::Node& map, const std::string& key, std::optional<double> otherwise,
               double most) const {
    return quantity(map, key, vp::Unit::none, otherwise, 0, most);
  }

  double whole(const YAML::Node& map, const std::string& key, double most) const {
    const double number = count(map, key, 0, most);
    if (number != std::floor(number)) fail(map[key], "'" + key + "' is a whole number");
    return number;
  }

  const device::Device& device_of(const YAML::Node& node) const {
    const std::string name = node ? scalar(node, "device") : std::string(PowerTable::part) + "-1";
    try {
      return device::find_device(name);
    } catch (const vp::InputError& error) {
      fail(node, error.what());
    }
  }

  /// Of "2018.3", or "2018".
  bool is_older(const YAML::Node& node) const {
    if (!node) return false;
    const std::string text = scalar(node, "tool");
    const std::regex version(R"((?:v\.?)?(20[0-9]{2})(?:\.([0-9]))?(?:\.[0-9]+)?)");
    std::smatch parts;
    if (text.size() > longest_version || !std::regex_match(text, parts, version)) {
      fail(node,
           "'tool' = '" + vp::excerpt(text) + "' is no version of Vivado: write 'tool: 2018.3'");
    }
    const int minor = parts[2].matched ? std::stoi(parts[2]) : last_minor;
    return std::pair(std::stoi(parts[1]), minor) <= last_older_tool;
  }

  /// The number of managers, or what is said of each one.
  std::vector<ClockManager> clock_managers(const YAML::Node& root, const char* key,
                                           double most_mhz_here) const {
    const YAML::Node node = root[key];
    if (!node || !node.IsSequence()) {
      return std::vector<ClockManager>(static_cast<std::size_t>(whole(root, key, most_managers)));
    }
    if (node.size() > most_managers) {
      fail(node, "a device has at most " + vp::Decimal(most_managers).text() + " " + key);
    }
    std::vector<ClockManager> managers;
    for (const YAML::Node& entry : node)
      managers.push_back(clock_manager(entry, key, most_mhz_here));
    return managers;
  }

  /// Its oscillator's frequency, or a map of that and `fractional`, which only an MMCM can be.
  ClockManager clock_manager(const YAML::Node& node, const std::string& key,
                             double most_mhz_here) const {
    ClockManager manager;
    manager.declared = true;
    if (node.IsMap()) {
      only(node, "one of '" + key + "'",
           key == "mmcm" ? std::vector<std::string>{"oscillator", "fractional"}
                         : std::vector<std::string>{"oscillator"});
      if (!node["oscillator"]) fail(node, "'oscillator' of one of '" + key + "' is missing");
      if (node["fractional"]) manager.fractional = yes_or_no(node["fractional"], "fractional");
    }
    const YAML::Node oscillator = node.IsMap() ? node["oscillator"] : node;
    manager.ghz = ghz_per_mhz * quantity_of(oscillator, "oscillator of a " + key,
                                            vp::Unit::frequency, least_vco_mhz, most_mhz_here);
    return manager;
  }

  bool yes_or_no(const YAML::Node& node, const std::string& key) const {
    const std::string text = scalar(node, key);
    if (text == "yes" || text == "true") return true;
    if (text == "no" || text == "false") return false;
    fail(node, "'" + key + "' = '" + vp::excerpt(text) + "' is neither yes nor no");
  }

  /// The coefficient of what is declared: that of `family`, such as "pl.bram", with one of `uses`.
  std::string declared(const YAML::Node& map, const char* key, const std::string& family,
                       const std::vector<std::string>& uses, const std::string& otherwise) const {
    const YAML::Node node = map[key];
    if (!node) return otherwise;
    const std::string use = scalar(node, key);
    if (std::find(uses.begin(), uses.end(), use) != uses.end()) return family + "_" + use;
    fail(node, "'" + std::string(key) + "' = '" + vp::excerpt(use) + "' is unknown: give " +
                   vp::one_of(uses));
  }

  void read_clocks(const YAML::Node& root) {
    const YAML::Node clocks = root["clocks"];
    if (!clocks || clocks.IsNull()) return;
    if (!clocks.IsMap()) fail(clocks, "'clocks' is 'name: {frequency: …, lut: …, ff: …}' lines");
    const std::vector<std::pair<const char*, const Figure*>> capacities{
        {"lut", &design_.device.lut},
        {"ff", &design_.device.ff},
        {"bram36", &design_.device.bram36},
        {"dsp", &design_.device.dsp}};
    std::map<std::string, double> used;
    for (const auto& entry : clocks) {
      design_.clocks.push_back(clock_domain(scalar(entry.first, "clocks"), entry.second));
      const ClockDomain& c = design_.clocks.back();
      used["lut"] += c.lut;
      used["ff"] += c.ff;
      used["bram36"] += c.bram36;
      used["dsp"] += c.dsp;
    }
    for (const auto& [name, capacity] : capacities) {
      if (used[name] <= capacity->value) continue;
      fail(clocks, "the clocks have " + vp::Decimal(used[name]).text() + " " + name +
                       " together, " + design_.device.name() + " has " +
                       vp::Decimal(capacity->value).text());
    }
  }

  ClockDomain clock_domain(const std::string& name, const YAML::Node& node) {
    if (!node.IsMap()) fail(node, "'" + name + "' is '{frequency: …, lut: …, ff: …}'");
    only(node, "a clock",
         {"frequency", "lut", "ff", "bram36", "dsp", "toggle_rate", "activity", "bram_activity",
          "dsp_activity", "trace"});
    const device::Device& d = design_.device;
    ClockDomain clock;
    clock.name = name;
    clock.mhz = quantity(node, "frequency", vp::Unit::frequency, std::nullopt, 0, most_mhz);
    clock.lut = count(node, "lut", std::nullopt, d.lut.value);
    clock.ff = count(node, "ff", std::nullopt, d.ff.value);
    clock.bram36 = count(node, "bram36", 0, d.bram36.value);
    clock.dsp = count(node, "dsp", 0, d.dsp.value);
    clock.toggle_rate = quantity(node, "toggle_rate", vp::Unit::percent, default_toggle_rate, 0, 1);
    read_activity(node, clock);
    if (node["trace"]) read_trace(node, clock);
    return clock;
  }

  /// The trace says how often signals change: neither the user nor a class of activity does then.
  void read_trace(const YAML::Node& clock_node, ClockDomain& clock) const {
    const YAML::Node node = clock_node["trace"];
    for (const char* other : {"activity", "toggle_rate"}) {
      if (clock_node[other])
        fail(clock_node[other],
             std::string("'trace' takes the place of '") + other + "': remove one");
    }
    if (!node.IsMap()) fail(node, "'trace' is '{file: …, below: …, clock: …}'");
    only(node, "'trace'", {"file", "below", "clock"});
    const auto text = [&](const char* key) {
      if (!node[key]) fail(node, std::string("'") + key + "' of 'trace' is missing");
      return scalar(node[key], key);
    };
    const std::filesystem::path file = text("file");
    const std::filesystem::path folder = std::filesystem::path(file_).parent_path();
    ToggleSource source{(folder / file).string(), text("below"), text("clock")};
    if (!source.clock.empty() && source.clock[0] >= '0' && source.clock[0] <= '9')  // 50 MHz
      source.clock_mhz = quantity(node, "clock", vp::Unit::frequency, std::nullopt, 0, most_mhz);
    try {
      clock.toggles = count_toggles(source);
    } catch (const vp::InputError& error) {
      fail(node, error.what());
    }
    if (static_cast<double>(clock.toggles->bits) < clock.ff / 2) {
      fail(node, "the trace shows " + std::to_string(clock.toggles->bits) + " bits below '" +
                     source.below + "', too few for " + vp::Decimal(clock.ff).text() +
                     " flip-flops: record the signals inside, of the RTL");
    }
    clock.toggle_rate = clock.toggles->rate();
    clock.logic = "pl.logic_simulated";
    if (!clock_node["dsp_activity"]) clock.multiplier = "pl.dsp_busy";
  }

  /// Multipliers do what the logic around them does, unless they are declared themselves.
  void read_activity(const YAML::Node& node, ClockDomain& clock) const {
    clock.logic = declared(node, "activity", "pl.logic",
                           {"rest", "control", "arithmetic", "cipher"}, clock.logic);
    static const std::map<std::string, std::string> multipliers{
        {"pl.logic", "pl.dsp"},
        {"pl.logic_rest", "pl.dsp_rest"},
        {"pl.logic_control", "pl.dsp_shared"},
        {"pl.logic_arithmetic", "pl.dsp_busy"},
        {"pl.logic_cipher", "pl.dsp_busy"}};
    clock.multiplier = declared(node, "dsp_activity", "pl.dsp", {"busy", "shared", "rest"},
                                multipliers.at(clock.logic));
    clock.memory = declared(node, "bram_activity", "pl.bram",
                            {"always", "traffic", "buffer", "rest"}, clock.memory);
  }

  void read_pins(const YAML::Node& node) {
    if (!node.IsMap()) fail(node, "'io' is '{pins: …, frequency: …}'");
    only(node, "'io'", {"pins", "frequency", "toggle_rate", "tmds_pairs", "power"});
    design_.io.known_w = known_power(node, {"pins", "frequency", "toggle_rate", "tmds_pairs"});
    if (design_.io.known_w) return;
    design_.io.tmds_pairs = count(node, "tmds_pairs", 0, most_pins / 2);
    if (design_.io.tmds_pairs > 0 && !node["pins"]) return;
    design_.io.count = count(node, "pins", std::nullopt, most_pins);
    design_.io.mhz = quantity(node, "frequency", vp::Unit::frequency, std::nullopt, 0, most_mhz);
    design_.io.toggle_rate =
        quantity(node, "toggle_rate", vp::Unit::percent, default_toggle_rate, 0, 1);
  }

  /// W of `power`, beside which none of `others` can be.
  std::optional<double> known_power(const YAML::Node& map,
                                    const std::vector<std::string>& others) const {
    if (!map["power"]) return std::nullopt;
    for (const std::string& other : others) {
      if (map[other]) fail(map[other], "'power' takes the place of '" + other + "': remove one");
    }
    return quantity(map, "power", vp::Unit::power, std::nullopt, 0, most_known_w);
  }

  void read_ps(const YAML::Node& node) {
    if (node && node.IsScalar() && node.Scalar() == "none") return;
    const YAML::Node map = node && !node.IsNull() ? node : YAML::Node(YAML::NodeType::Map);
    if (!map.IsMap()) fail(map, "'ps' is 'none', or '{cpu_clock: …, load: …, ddr: {…}}'");
    only(map, "'ps'", {"cpu_clock", "load", "cores", "hp_clock", "ddr", "power"});
    PsSettings ps;
    ps.known_w = known_power(map, {"cpu_clock", "load", "cores", "hp_clock", "ddr"});
    if (map["cores"]) ps.cores = whole(map, "cores", 2);
    ps.cpu_mhz = quantity(map, "cpu_clock", vp::Unit::frequency, default_cpu_mhz, 0,
                          design_.device.cpu_621_mhz.value);
    ps.load = quantity(map, "load", vp::Unit::percent, 0.5, 0, 1);
    ps.hp_mhz = quantity(map, "hp_clock", vp::Unit::frequency, 0, 0, most_mhz);
    const YAML::Node ddr = map["ddr"] ? map["ddr"] : YAML::Node(YAML::NodeType::Map);
    if (!ddr.IsMap()) fail(ddr, "'ddr' is '{width: …, frequency: …, voltage: …}'");
    only(ddr, "'ddr'", {"width", "frequency", "voltage"});
    ps.ddr.width = static_cast<unsigned>(count(ddr, "width", 32, 32));
    if (ps.ddr.width != 16 && ps.ddr.width != 32) fail(ddr, "'width' is 16 or 32");
    ps.ddr.mhz = quantity(ddr, "frequency", vp::Unit::frequency, default_ddr_mhz, 0,
                          design_.device.ddr_mhz.value);
    ps.ddr.volts = quantity(ddr, "voltage", vp::Unit::voltage, 1.5, 1.2, 1.8);
    design_.ps = ps;
  }

  const std::string file_;
  DesignFigures design_;
};

}  // namespace

DesignFigures read_design_figures(const std::string& file) {
  return FiguresReader(file).read();
}

}  // namespace platform::power
