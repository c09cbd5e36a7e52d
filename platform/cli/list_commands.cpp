#include <fmt/format.h>

#include <chip/run/simulation.h>
#include <cli/commands.h>
#include <cli/program.h>
#include <fpga/device/clock_plan.h>
#include <fpga/device/device.h>
#include <fpga/power/design_estimate.h>
#include <fpga/power/power_table.h>
#include <result/console.h>
#include <result/figures.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>
#include <vp/unit.h>
#include <xilinx/fabric_clock/clock_settings.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <ostream>

namespace platform::cli {

namespace {

using device::Device;
using device::FigureInfo;

void print_table(std::ostream& out) {
  out << fmt::format("{:<10} {:>7} {:>7} {:>7} {:>4} {:>5} {:>11} {:>8} {:>8} {:>8} {:>5} {:>7}\n",
                     "device", "LUT", "FF", "BRAM36", "DSP", "cores", "CPU, MHz", "DDR, MHz",
                     "FCLK,MHz", "VCO, MHz", "Fmax", "static");
  for (const Device& d : device::devices()) {
    out << fmt::format(
        "{:<10} {:>7} {:>7} {:>7} {:>4} {:>5} {:>11} {:>8.0f} {:>8.0f} {:>8.0f} {:>5} {:>5.0f}mW\n",
        d.name(), d.lut.value, d.ff.value, d.bram36.value, d.dsp.value, d.cores.value,
        fmt::format("{:.0f} / {:.0f}", d.cpu_621_mhz.value, d.cpu_421_mhz.value), d.ddr_mhz.value,
        d.fclk_mhz.value, d.vco_max_mhz.value, fmt::format("x{:.2f}", d.fmax_factor.value),
        1000 * d.static_w.value);
  }
  out << "\nClocks are the highest of the speed grade; CPU by ratio, 6:2:1 / 4:2:1; static power "
         "at "
         "25 C.\n'markervp devices DEVICE' has every figure with its source, '--set "
         "device=DEVICE' uses one.\n";
}

void print_device(const Device& device, std::ostream& out) {
  out << fmt::format("{}, IDCODE 0x{:08X}\n\n", device.name(), device.idcode());
  for (const FigureInfo& info : device::figures()) {
    const device::Figure& figure = device.*info.figure;
    out << fmt::format("{:<16} {:>11}  {:<9}  {}\n{:31}{}\n", info.name,
                       fmt::format("{:.10g} {}", figure.value, info.unit),
                       to_string(figure.confidence), info.documentation, "", figure.source);
  }
}

nlohmann::ordered_json as_json(const Device& device) {
  nlohmann::ordered_json json;
  json["name"] = device.name();
  json["part"] = device.part;
  json["grade"] = device.grade;
  for (const FigureInfo& info : device::figures()) {
    const device::Figure& figure = device.*info.figure;
    json[info.name] = {{"value", figure.value},
                       {"unit", info.unit},
                       {"confidence", to_string(figure.confidence)},
                       {"source", figure.source}};
  }
  return json;
}

}  // namespace

int list_devices(const DevicesOptions& options, std::ostream& out) {
  if (options.json) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    if (options.device.empty()) {
      for (const Device& device : device::devices()) list.push_back(as_json(device));
    } else {
      list.push_back(as_json(device::find_device(options.device)));
    }
    out << list.dump(2) << "\n";
  } else if (options.device.empty()) {
    print_table(out);
  } else {
    print_device(device::find_device(options.device), out);
  }
  return done;
}

namespace {

using device::ClockKind;
using device::ClockPlan;
using device::ClockPlanner;
using device::hz_per_mhz;
using device::MadeClock;
using Json = nlohmann::ordered_json;

constexpr std::size_t most_fclk = 4;

ClockKind kind_of(const std::string& name) {
  if (name == "cpu") return ClockKind::cpu_621;
  if (name == "cpu-421") return ClockKind::cpu_421;
  return name == "ddr" ? ClockKind::ddr : ClockKind::fclk;
}

double frequency(const std::string& text, const std::string& what) {
  double hz = 0;
  try {
    hz = vp::parse_quantity(text, vp::Unit::frequency).to_double();
  } catch (const vp::InputError& error) {
    throw vp::InputError(what + " '" + text + "' " + error.what());
  }
  if (hz < 1) throw vp::InputError(what + " '" + text + "': give at least 1 Hz");
  return hz;
}

std::string mhz(double hz) {
  return fmt::format("{:.6f} MHz", hz / hz_per_mhz);
}

double percent(double hz, double wish_hz) {
  return 100 * (hz / wish_hz - 1);
}

std::string pll_text(const MadeClock& clock) {
  return fmt::format("{} PLL {:.3f} MHz x{}", to_string(clock.pll), clock.vco_hz / hz_per_mhz,
                     clock.feedback);
}

std::string divisor_text(const MadeClock& clock) {
  return clock.divisor1 == 1 ? fmt::format("/ {}", clock.divisor0)
                             : fmt::format("/ {} / {}", clock.divisor0, clock.divisor1);
}

/// A wish and what can be had of it.
struct Answer {
  double wish_hz;
  MadeClock made;
  ClockPlanner::Neighbours neighbours;
  std::vector<device::NearClock> near;
};

/// FCLK wishes are those of one chip; of the others each is asked for alone.
class Question {
 public:
  explicit Question(const ClocksOptions& options)
      : options_(options),
        kind_(kind_of(options.kind)),
        crystal_hz_(options.crystal ? frequency(*options.crystal, "the crystal")
                                    : device::zedboard_crystal_hz),
        planner_(device::find_device(options.device), crystal_hz_) {
    wishes_.ethernet = !options.no_ethernet;
    std::vector<double> wishes;
    for (const std::string& text : options.wishes) wishes.push_back(frequency(text, "the wish"));
    if (kind_ == ClockKind::fclk) {
      if (wishes.size() > most_fclk) {
        throw vp::InputError(
            fmt::format("{} wishes: a chip has {} clocks to the PL", wishes.size(), most_fclk));
      }
      wishes_.fclk_hz = wishes;
    }
    plan_ = planner_.plan(wishes_);
    for (std::size_t i = 0; i < wishes.size(); ++i) {
      const double wish_hz = wishes[i];
      answers_.push_back(
          {wish_hz, kind_ == ClockKind::fclk ? plan_.fclk[i] : planner_.own_pll(wish_hz, kind_),
           planner_.neighbours(wish_hz, kind_, plan_),
           planner_.near(wish_hz, kind_, plan_, wishes_.ethernet, options.count)});
    }
  }

  void print(std::ostream& out) const {
    out << fmt::format("{}, crystal {}", planner_.device().name(), mhz(crystal_hz_));
    if (kind_ == ClockKind::fclk) {
      out << fmt::format(", {}: I/O PLL {} (x{})", wishes_.ethernet ? "Ethernet" : "no Ethernet",
                         mhz(crystal_hz_ * plan_.io_feedback), plan_.io_feedback);
    }
    out << "\n";
    for (const Answer& answer : answers_) print(answer, out);
  }

  Json json() const {
    Json json;
    json["device"] = planner_.device().name();
    json["crystal_mhz"] = crystal_hz_ / hz_per_mhz;
    json["kind"] = options_.kind;
    json["limit_mhz"] = limit().value;
    if (kind_ == ClockKind::fclk) {
      json["ethernet"] = wishes_.ethernet;
      json["io_feedback"] = plan_.io_feedback;
    }
    json["clocks"] = Json::array();
    for (const Answer& answer : answers_) {
      Json entry;
      entry["wish_mhz"] = answer.wish_hz / hz_per_mhz;
      entry["made"] = as_json(answer.made, answer.wish_hz);
      const auto& [below, above] = answer.neighbours;
      entry["below"] = below ? as_json(*below, answer.wish_hz) : Json();
      entry["above"] = above ? as_json(*above, answer.wish_hz) : Json();
      for (const device::NearClock& near : answer.near) {
        Json made = as_json(near.clock, answer.wish_hz);
        made["how"] = to_string(near.effort);
        entry["near"].push_back(made);
      }
      json["clocks"].push_back(entry);
    }
    return json;
  }

 private:
  const device::Figure& limit() const { return limit_of(planner_.device(), kind_); }

  static Json as_json(const MadeClock& clock, double wish_hz) {
    Json json;
    json["mhz"] = clock.hz / hz_per_mhz;
    json["offset_percent"] = percent(clock.hz, wish_hz);
    json["pll"] = to_string(clock.pll);
    json["vco_mhz"] = clock.vco_hz / hz_per_mhz;
    json["feedback"] = clock.feedback;
    json["divisors"] = {clock.divisor0, clock.divisor1};
    return json;
  }

  static std::string neighbour(const std::optional<MadeClock>& clock, double wish_hz) {
    if (!clock) return "none";
    return fmt::format("{} ({:+.3f} %)", mhz(clock->hz), percent(clock->hz, wish_hz));
  }

  void print(const Answer& answer, std::ostream& out) const {
    const double wish_hz = answer.wish_hz;
    out << fmt::format("\n{} {}: the vendor's tool makes {} ({:+.3f} %), {} {}\n",
                       kind_ == ClockKind::fclk  ? "FCLK"
                       : kind_ == ClockKind::ddr ? "DDR"
                                                 : "CPU",
                       mhz(wish_hz), mhz(answer.made.hz), percent(answer.made.hz, wish_hz),
                       pll_text(answer.made), divisor_text(answer.made));
    if (answer.made.hz > limit().value * hz_per_mhz * (1 + device::crystal_tolerance)) {
      out << fmt::format("  ABOVE the {:.10g} MHz of the speed grade ({})\n", limit().value,
                         to_string(limit().confidence));
    }
    out << fmt::format("  below {}, above {}\n\n", neighbour(answer.neighbours.below, wish_hz),
                       neighbour(answer.neighbours.above, wish_hz));
    out << fmt::format("{:>14} {:>11}  {:<25} {:<10}  {}\n", "MHz", "offset, %", "PLL", "dividers",
                       "how");
    for (const device::NearClock& near : answer.near) {
      out << fmt::format("{:>14.6f} {:>+11.4f}  {:<25} {:<10}  {}\n", near.clock.hz / hz_per_mhz,
                         percent(near.clock.hz, wish_hz), pll_text(near.clock),
                         divisor_text(near.clock), to_string(near.effort));
    }
  }

  const ClocksOptions& options_;
  ClockKind kind_;
  double crystal_hz_;
  ClockPlanner planner_;
  device::ClockWishes wishes_;
  ClockPlan plan_;
  std::vector<Answer> answers_;
};

}  // namespace

namespace {

/// What a clock manager of the fabric makes of an input.
void list_fabric_clocks(const ClocksOptions& options, std::ostream& out) {
  const Device& device = device::find_device(options.device);
  const bool pll = options.kind == "pll";
  const double input_hz = frequency(options.input, "the input");
  const xilinx::ManagerLimits limits = xilinx::manager_limits(
      pll, device.grade.empty() ? 1 : static_cast<unsigned>(device.grade.front() - '0'));
  const auto steps = [](std::uint64_t in_eighths) {
    return fmt::format("{:.3f}", static_cast<double>(in_eighths) / xilinx::eighths);
  };
  out << fmt::format("{}, {} from {}: oscillator {} to {}\n", device.name(), pll ? "PLL" : "MMCM",
                     mhz(input_hz), mhz(limits.vco_min), mhz(limits.vco_max));
  for (const std::string& wish : options.wishes) {
    const double wish_hz = frequency(wish, "the wish");
    const auto settings = xilinx::settings_near(input_hz, wish_hz, limits, options.count);
    if (settings.empty())
      throw vp::InputError("no setting makes a clock of " + mhz(input_hz) +
                           ": give another --input");
    out << fmt::format("\n{:>14} {:>11} {:>8} {:>12} {:>9}  {}\n", "MHz", "offset, %", "DIVCLK",
                       "CLKFBOUT", "CLKOUT0", "oscillator");
    for (const xilinx::ManagerSetting& s : settings) {
      out << fmt::format("{:>14.6f} {:>+11.4f} {:>8} {:>12} {:>9}  {}\n", s.hz / hz_per_mhz,
                         percent(s.hz, wish_hz), s.divclk, steps(s.multiplier), steps(s.divider),
                         mhz(s.vco_hz));
    }
  }
}

}  // namespace

int list_clocks(const ClocksOptions& options, std::ostream& out) {
  if (options.kind == "mmcm" || options.kind == "pll") {
    if (options.json)
      throw vp::InputError("--json lists the clocks of the PS: leave it out for " + options.kind);
    list_fabric_clocks(options, out);
    return done;
  }
  const Question question(options);
  if (options.json) {
    out << question.json().dump(2) << "\n";
  } else {
    question.print(out);
  }
  return done;
}

namespace {

void print_watts(std::ostream& out, const std::string& name, const vp::Band& watts) {
  out << fmt::format("  {:<26}{:>8.3f}   {:.3f} to {:.3f}\n", name, watts.nominal, watts.low,
                     watts.high);
}

/// What a simulation says of a clock's logic, and which nets make most of it.
void print_toggles(std::ostream& out, const power::ClockDomain& clock) {
  constexpr std::size_t most_nets = 8;
  const power::ToggleCount& count = *clock.toggles;
  out << fmt::format("\n{}: {:.3g} toggles a bit and clock, of {} bits in {} clocks\n", clock.name,
                     count.rate(), count.bits, count.clocks);
  for (std::size_t i = 0; i < std::min(most_nets, count.nets.size()); ++i) {
    const power::ToggleCount::Net& net = count.nets[i];
    if (net.toggles == 0) break;
    out << fmt::format("  {:>5.1f} %  {} ({} bit)\n",
                       100 * static_cast<double>(net.toggles) / static_cast<double>(count.toggles),
                       net.path, net.width);
  }
}

/// What the estimate had to assume, because the design does not say it.
void print_assumptions(std::ostream& out, const power::DesignFigures& design) {
  std::vector<std::string> clocks;
  for (const power::ClockDomain& clock : design.clocks) {
    std::vector<std::string> parts;
    if (clock.lut > 0 && clock.logic == "pl.logic") parts.emplace_back("logic");
    if (clock.bram36 > 0 && clock.memory == "pl.bram") parts.emplace_back("memories");
    if (clock.dsp > 0 && clock.multiplier == "pl.dsp") parts.emplace_back("multipliers");
    if (!parts.empty()) clocks.push_back(vp::join(parts, ", ") + " of " + clock.name);
  }
  if (!clocks.empty()) {
    out << "\nNot declared, so billed as usual designs are: " << vp::join(clocks, "; ")
        << ".\n'activity' or 'trace', 'bram_activity' and 'dsp_activity' of a clock narrow the "
           "band.\n";
  }
  const double has = design.device.cores.value;
  if (design.ps && !design.ps->known_w && !design.ps->cores && has < 2) {
    out << "\nThe PS is billed with two cores, as the vendor's tool does, although "
        << design.device.name() << " has one: 'ps: {cores: 1}' bills what it has.\n";
  }
}

}  // namespace

int print_power_estimate(const PowerTableOptions& options, std::ostream& out) {
  const power::DesignFigures design = power::read_design_figures(options.design);
  const power::PowerEstimate estimate =
      power::estimate_power(design, power::PowerTable::load(options.table));
  out << fmt::format("{}, table '{}'           W   band\n", design.device.name(), options.table);
  for (const auto& [kind, watts] : estimate.ledger.by_group()) print_watts(out, kind, watts);
  out << "\nby module, and by which coefficient\n";
  for (const vp::EnergyEntry& entry : estimate.ledger.entries()) {
    const bool is_static = entry.kind == vp::PowerKind::leakage;  // one module, several rails
    out << fmt::format("  {:<26}{:>8.3f}   {:.3f} to {:<8.3f}{}\n",
                       is_static ? "static, " + entry.rail : entry.module, entry.joules.nominal,
                       entry.joules.low, entry.joules.high, entry.source);
  }
  out << "\nby rail\n";
  for (const auto& [rail, watts] : estimate.ledger.by_rail()) print_watts(out, rail, watts);
  out << '\n';
  print_watts(out, "total", estimate.ledger.total());
  out << fmt::format("  {:<26}{:>6.1f} C\n", "junction", estimate.junction_c);
  for (const power::ClockDomain& clock : design.clocks) {
    if (clock.toggles) print_toggles(out, clock);
  }
  print_assumptions(out, design);
  return done;
}

int print_power_table(const PowerTableOptions& options, std::ostream& out) {
  const power::PowerTable table = power::PowerTable::load(options.table);
  if (options.markdown) {
    out << power::as_markdown(table);
    return done;
  }
  out << fmt::format("{:<22} {:>9} {:>9} {:>9}  {:<14} {}\n", "coefficient", "low", "nominal",
                     "high", "unit", "status");
  for (const power::Coefficient& entry : table.entries()) {
    out << fmt::format("{:<22} {:>9.6g} {:>9.6g} {:>9.6g}  {:<14} {}\n", entry.name,
                       entry.value.low, entry.value.nominal, entry.value.high, entry.unit,
                       entry.status);
  }
  out << fmt::format(
      "\nTable '{}'. 'markervp power --markdown' prints the sources. An own table, or a changed "
      "copy of\nthis one: 'markervp power FILE.json' checks it, '--set power.table=FILE.json' uses "
      "it.\n",
      table.name());
  return done;
}

namespace {

/// A plain number is frames a second.
std::string with_unit(const std::string& rate) {
  return vp::Decimal::parse(rate) ? rate + " fps" : rate;
}

}  // namespace

void load_configuration(const ConfigurationOptions& options, vp::Configuration& configuration) {
  for (const std::string& file : options.files) configuration.load_file(file);
  for (const auto& [path, value] : options.settings) configuration.set(path, value);
  for (const std::string& assignment : options.assignments) configuration.set(assignment);
  if (options.design) configuration.set("design", *options.design, "--design");
}

void choose_platform(const PlatformOptions& options, vp::Configuration& configuration) {
  if (options.fidelity) configuration.set("fidelity", *options.fidelity, "--fidelity");
  if (options.rate) configuration.set("camera.rate", with_unit(*options.rate), "--rate");
}

std::unique_ptr<Simulation> build(vp::Configuration& configuration,
                                  const SimulationOptions& options) {
  const vp::Configuration::Scope scope(configuration);
  auto simulation = std::make_unique<Simulation>(options);
  result::declare(simulation->work());
  configuration.check_unused();
  return simulation;
}

namespace {

/// Those at `path` or below it.
vp::Configuration part_of(const vp::Configuration& all, const std::string& path) {
  vp::Configuration part;
  std::vector<std::string> known;
  for (const vp::ParameterDescription& parameter : all.parameters()) {
    if (parameter.path == path || parameter.path.rfind(path + ".", 0) == 0) part.add(parameter);
    known.push_back(parameter.path);
    const std::string group = parameter.path.substr(0, parameter.path.rfind('.'));
    if (group != known.back()) known.push_back(group);
  }
  if (!part.parameters().empty()) return part;
  const std::string nearest = vp::nearest_match(path, known);
  throw vp::InputError(
      "no parameter or group '" + vp::excerpt(path) + "': " +
      (nearest.empty() ? "'markervp config' prints all" : "did you mean '" + nearest + "'?"));
}

}  // namespace

int print_configuration(const ConfigOptions& options, std::ostream& out) {
  vp::Configuration configuration;
  load_configuration(options.configuration, configuration);
  choose_platform(options, configuration);
  SimulationOptions asked;
  asked.program = options.program;
  asked.is_only_shown = true;
  build(configuration, asked);
  out << (options.path.empty() ? configuration : part_of(configuration, options.path)).to_yaml();
  return done;
}

}  // namespace platform::cli
