#include <fpga/power/design_estimate.h>

#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>
#include <vp/unit.h>
#include <vp/yaml.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace platform::power {

namespace {

constexpr double per_thousand = 1e-3;
constexpr double full_voltage = 1.5, low_voltage = 1.35;
/// LUT over flip-flops in the reports that calibration/power/refit.py fits.
constexpr double least_depth = 0.5, most_depth = 4.5;

}  // namespace

vp::Band logic_energy(const PowerTable& table, double lut, double ff) {
  const double depth = ff > 0 ? std::clamp(lut / ff, least_depth, most_depth) : most_depth;
  const double toggles = std::pow(depth, table.value("pl.logic_depth").nominal);
  return table.value("pl.logic") * (toggles * lut * per_thousand * nano);
}

vp::Band clock_energy(const PowerTable& table, double ff) {
  return table.value("pl.clock") * (ff * per_thousand * nano);
}

vp::Band clock_root_energy(const PowerTable& table) {
  return table.value("pl.clock_root") * nano;
}

vp::Band block_memory_energy(const PowerTable& table, double bram36) {
  return table.value("pl.bram") * (bram36 * pico);
}

vp::Band dsp_energy(const PowerTable& table, double dsp) {
  return table.value("pl.dsp") * (dsp * pico);
}

std::string of_width(const std::string& name, unsigned width) {
  return name + (width == 32 ? "32" : "16");
}

vp::Band ddr_io_power(const PowerTable& table, const DdrInterface& ddr) {
  vp::Band amperes = table.value(of_width("ps.ddr_current_", ddr.width));
  amperes += table.value(of_width("ps.ddr_slope_", ddr.width)) * ddr.mhz;
  const double lower = (full_voltage - ddr.volts) / (full_voltage - low_voltage);
  const vp::Band& factor = table.value("ps.ddr_low_voltage");
  const auto watts = [&](double vp::Band::*estimate) {
    return amperes.*estimate * (1 - (1 - factor.*estimate) * lower) * ddr.volts;
  };
  return {watts(&vp::Band::low), watts(&vp::Band::nominal), watts(&vp::Band::high)};
}

double static_scale(const device::Device& chip) {
  return chip.static_w.value / device::find_device(PowerTable::part).static_w.value;
}

vp::EnergyLedger static_energy(const PowerTable& table, double scale, const vp::ThermalPath& path,
                               const vp::Band& dynamic_w, double seconds, double& junction_c) {
  const vp::Band base = table.value("static.base") * scale;
  const auto point = [&](double vp::Band::*estimate) {
    try {
      return vp::find_static_point(leakage(table, scale, estimate), path, dynamic_w.*estimate);
    } catch (const vp::InputError& error) {
      if (estimate != &vp::Band::high) throw;
      throw vp::InputError(std::string(error.what()) + " (by the high estimate of the table)");
    }
  };
  const vp::StaticPoint low = point(&vp::Band::low), nominal = point(&vp::Band::nominal),
                        high = point(&vp::Band::high);
  junction_c = nominal.junction_c;
  const vp::Band whole{low.static_w * seconds, nominal.static_w * seconds, high.static_w * seconds};
  const vp::Band leaking = whole - base * seconds;
  const std::string source = "static.leakage (" + table.at("static.leakage").status + ")";

  vp::EnergyLedger ledger;
  vp::Band rest = whole;
  for (const auto& [rail, share] :
       {std::pair{"Vccpint", "static.share_vccpint"}, std::pair{"Vccint", "static.share_vccint"}}) {
    const vp::Band part = leaking * table.value(share);
    ledger.add({"static", "static", rail, vp::PowerKind::leakage, source, part});
    rest = rest - part;
  }
  ledger.add({"static", "static", "Vccaux and others", vp::PowerKind::leakage, source, rest});
  return ledger;
}

vp::LeakageCurve leakage(const PowerTable& table, double scale, double vp::Band::*estimate) {
  return {scale * table.value("static.base").*estimate,
          scale * table.value("static.leakage").*estimate, table.value("static.slope").*estimate};
}

namespace {

using device::Figure;
using device::hz_per_mhz;
using vp::PowerKind;

constexpr double per_cent = 1e-2;
constexpr double default_cpu_mhz = 666.666687,
                 default_ddr_mhz = 533.333374;  // of ZedBoard's preset
constexpr double most_mhz = 1000, most_pins = 400, most_mmcm = 8;
constexpr double hottest_ambient_c = 125, coldest_ambient_c = -55, most_theta_ja = 100;

class FiguresReader {
 public:
  explicit FiguresReader(std::string file) : file_(std::move(file)) {}

  DesignFigures read() {
    const YAML::Node root = vp::load_yaml(vp::read_text(file_, "design figures"), file_);
    if (!root.IsMap()) fail(root, "expected 'key: value' lines: 'clocks:' at least");
    only(root, "a design", {"device", "clocks", "mmcm", "io", "ps", "ambient", "theta_ja"});
    design_.device = device_of(root["device"]);
    read_clocks(root);
    design_.mmcm = count(root, "mmcm", 0, most_mmcm);
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

  void only(const YAML::Node& map, const std::string& what, const std::vector<std::string>& keys) {
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

  const device::Device& device_of(const YAML::Node& node) const {
    const std::string name = node ? scalar(node, "device") : std::string(PowerTable::part) + "-1";
    try {
      return device::find_device(name);
    } catch (const vp::InputError& error) {
      fail(node, error.what());
    }
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
    only(node, "a clock", {"frequency", "lut", "ff", "bram36", "dsp", "toggle_rate"});
    const device::Device& d = design_.device;
    ClockDomain clock;
    clock.name = name;
    clock.mhz = quantity(node, "frequency", vp::Unit::frequency, std::nullopt, 0, most_mhz);
    clock.lut = count(node, "lut", std::nullopt, d.lut.value);
    clock.ff = count(node, "ff", std::nullopt, d.ff.value);
    clock.bram36 = count(node, "bram36", 0, d.bram36.value);
    clock.dsp = count(node, "dsp", 0, d.dsp.value);
    clock.toggle_rate = quantity(node, "toggle_rate", vp::Unit::percent, default_toggle_rate, 0, 1);
    return clock;
  }

  void read_pins(const YAML::Node& node) {
    if (!node.IsMap()) fail(node, "'io' is '{pins: …, frequency: …}'");
    only(node, "'io'", {"pins", "frequency", "toggle_rate"});
    design_.io.count = count(node, "pins", std::nullopt, most_pins);
    design_.io.mhz = quantity(node, "frequency", vp::Unit::frequency, std::nullopt, 0, most_mhz);
    design_.io.toggle_rate =
        quantity(node, "toggle_rate", vp::Unit::percent, default_toggle_rate, 0, 1);
  }

  void read_ps(const YAML::Node& node) {
    if (node && node.IsScalar() && node.Scalar() == "none") return;
    const YAML::Node map = node && !node.IsNull() ? node : YAML::Node(YAML::NodeType::Map);
    if (!map.IsMap()) fail(map, "'ps' is 'none', or '{cpu_clock: …, load: …, ddr: {…}}'");
    only(map, "'ps'", {"cpu_clock", "load", "hp_clock", "ddr"});
    PsSettings ps;
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

class Estimator {
 public:
  explicit Estimator(const PowerTable& table) : table_(table) {}

  void add_ps(const PsSettings& ps, double cores) {
    const double cycles = ps.cpu_mhz * hz_per_mhz * ps.load * cores;
    add("ps.cores", "Vccpint", PowerKind::state, "ps.core_cycle",
        table_.value("ps.core_cycle") * (nano * cycles));
    add_state("ps.uncore", "Vccpint", of_width("ps.uncore_", ps.ddr.width));
    add_state("ps.pll", "Vccpll", "ps.pll");
    add_state("ps.aux", "Vccpaux", of_width("ps.aux_", ps.ddr.width));
    add_state("ps.mio", "Vcco_mio", "ps.mio");
    add("ps.ddr_io", "Vcco_ddr", PowerKind::state, of_width("ps.ddr_current_", ps.ddr.width),
        ddr_io_power(table_, ps.ddr));
    if (ps.hp_mhz > 0)
      add("ps.s_axi_hp", "Vccpint", PowerKind::state, "ps.hp_port",
          table_.value("ps.hp_port") * (nano * ps.hp_mhz * hz_per_mhz));
  }

  void add_clock(const ClockDomain& c) {
    const double hz = c.mhz * hz_per_mhz;
    const double toggles = c.toggle_rate / default_toggle_rate;
    vp::Band tree = clock_root_energy(table_);
    tree += clock_energy(table_, c.ff);
    add("pl." + c.name, "Vccint", PowerKind::clock, "pl.clock", tree * hz);
    add("pl." + c.name + ".logic", "Vccint", PowerKind::state, "pl.logic",
        logic_energy(table_, c.lut, c.ff) * (hz * toggles));
    if (c.bram36 > 0)
      add("pl." + c.name + ".bram36", "Vccbram", PowerKind::state, "pl.bram",
          block_memory_energy(table_, c.bram36) * hz);
    if (c.dsp > 0)
      add("pl." + c.name + ".dsp", "Vccint", PowerKind::state, "pl.dsp",
          dsp_energy(table_, c.dsp) * (hz * toggles));
  }

  void add_mmcm(double count) {
    if (count > 0)
      add("pl.mmcm", "Vccaux", PowerKind::clock, "pl.mmcm", table_.value("pl.mmcm") * count);
  }

  void add_pins(const Pins& io) {
    const double toggles = io.toggle_rate / default_toggle_rate;
    if (io.count > 0)
      add("pl.io", "Vcco", PowerKind::state, "pl.io",
          table_.value("pl.io") * (pico * io.count * io.mhz * hz_per_mhz * toggles));
  }

  PowerEstimate take(const DesignFigures& design) {
    PowerEstimate estimate{ledger_, 0};
    estimate.ledger.add(static_energy(table_, static_scale(design.device), design.thermal,
                                      ledger_.total(), 1, estimate.junction_c));
    return estimate;
  }

 private:
  /// As a vendor's report has them.
  static std::string kind_of(const std::string& coefficient) {
    static const std::map<std::string, std::string> kinds{
        {"pl.clock", "clocks"},   {"pl.logic", "logic and signals"},
        {"pl.bram", "block RAM"}, {"pl.dsp", "DSP"},
        {"pl.mmcm", "MMCM"},      {"pl.io", "I/O"}};
    const auto found = kinds.find(coefficient);
    return found == kinds.end() ? "PS" : found->second;
  }
  void add(const std::string& module, const char* rail, PowerKind kind,
           const std::string& coefficient, const vp::Band& watts) {
    ledger_.add({module, kind_of(coefficient), rail, kind,
                 coefficient + " (" + table_.at(coefficient).status + ")", watts});
  }
  void add_state(const std::string& module, const char* rail, const std::string& coefficient) {
    add(module, rail, PowerKind::state, coefficient, table_.value(coefficient));
  }

  const PowerTable& table_;
  vp::EnergyLedger ledger_;
};

}  // namespace

DesignFigures read_design_figures(const std::string& file) {
  return FiguresReader(file).read();
}

PowerEstimate estimate_power(const DesignFigures& design, const PowerTable& table) {
  Estimator estimator(table);
  if (design.ps) estimator.add_ps(*design.ps, design.device.cores.value);
  for (const ClockDomain& clock : design.clocks) estimator.add_clock(clock);
  estimator.add_mmcm(design.mmcm);
  estimator.add_pins(design.io);
  return estimator.take(design);
}

}  // namespace platform::power
