#include <fpga/synthesis/netlist.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <unordered_map>
#include <utility>

#include <fpga/synthesis/cell_kinds.h>
#include <fpga/synthesis/clocks.h>
#include <fpga/synthesis/lut_pairs.h>
#include <fpga/synthesis/timing_graph.h>
#include <host/document.h>
#include <vp/error.h>

namespace platform::synthesis {

namespace {

using Json = nlohmann::json;

constexpr unsigned none = TimingGraph::none;

void count(const std::string& type, Cells& cells) {
  switch (kind_of(type)) {
    case Kind::lut:
      ++cells.lut;
      break;
    case Kind::ff:
    case Kind::latch:
      ++cells.ff;
      break;
    case Kind::carry:
      ++cells.carry4;
      break;
    case Kind::dsp:
      ++cells.dsp;
      break;
    case Kind::bram:
      ++(starts_with(type, "RAMB36") ? cells.ramb36 : cells.ramb18);
      break;
    case Kind::lutram:
    case Kind::shift:
      cells.lut_memory += luts_of(type);
      break;
    default:
      break;
  }
}

/// Makes the graph of a module from its cells.
class GraphBuilder {
 public:
  GraphBuilder(const Json& module, const PathTiming& timing) : timing_(timing) {
    for (const auto& [name, cell] : module.at("cells").items()) add_nets(cell);
    for (const auto& [name, cell] : module.at("cells").items()) add_cell(cell);
    name_bits(module.at("netnames"));
  }

  TimingGraph take() { return std::move(graph_); }

  std::uint32_t luts_to_let_through() const {
    return static_cast<std::uint32_t>(
        std::count_if(entrances_.begin(), entrances_.end(),
                      [this](unsigned i) { return drivers_[i] != Kind::lut; }));
  }

 private:
  static bool is_input(const Json& cell, const std::string& port) {
    return cell.at("port_directions").at(port) == "input";
  }

  /// Yosys' number of a bit, or a constant, as our own; none for a constant.
  unsigned bit(const Json& value) {
    if (!value.is_number()) return none;
    const auto [found, is_new] = index_.try_emplace(value.get<unsigned>(), drivers_.size());
    if (is_new) {
      drivers_.push_back(Kind::unknown);
      graph_.bits.emplace_back();
    }
    return found->second;
  }

  void add_nets(const Json& cell) {
    const Kind kind = kind_of(cell.at("type"));
    if (kind == Kind::outside) return;
    for (const auto& [port, values] : cell.at("connections").items()) {
      const bool input = is_input(cell, port);
      for (const Json& value : values) {
        const unsigned i = bit(value);
        if (i == none || (input && is_clock(kind, port))) continue;
        if (input) {
          ++graph_.bits[i].fan_out;
          if (kind == Kind::carry && port == "S") entrances_.push_back(i);
        } else {
          drivers_[i] = kind;
        }
      }
    }
  }

  /// Whether the net to that input can stay in a slice: no time then.
  bool leaves_slice(unsigned from, Kind to, const std::string& port) const {
    const Kind driver = drivers_[from];
    const bool logic = driver == Kind::lut || driver == Kind::mux || driver == Kind::lutram;
    switch (to) {
      case Kind::inverter:
        return false;  // goes into the LUT that follows
      case Kind::mux:
        return port == "S" || !logic;
      case Kind::carry:
        return port == "CI" ? driver != Kind::carry : driver != Kind::lut;
      case Kind::ff:
      case Kind::latch:
        return port != "D" || !(logic || driver == Kind::carry);
      default:
        return true;
    }
  }

  void add_arc(const Json& from, const Json& to, double ns, const Json& cell,
               const std::string& port) {
    const unsigned a = bit(from), b = bit(to);
    if (a == none || b == none) return;
    const std::string& type = cell.at("type").get_ref<const std::string&>();
    graph_.add_arc({a, b, ns, leaves_slice(a, kind_of(type), port), type});
  }

  /// From each bit of an input to each of an output.
  void add_arcs(const Json& cell, const std::string& input, const std::string& output, double ns) {
    const Json& ports = cell.at("connections");
    if (!ports.contains(input) || !ports.contains(output)) return;
    for (const Json& from : ports[input]) {
      for (const Json& to : ports[output]) add_arc(from, to, ns, cell, input);
    }
  }

  void add_start(const Json& cell, const std::string& port, double ns) {
    const Json& ports = cell.at("connections");
    if (!ports.contains(port)) return;
    for (const Json& value : ports[port]) {
      if (const unsigned i = bit(value); i != none) graph_.bits[i].start_ns = ns;
    }
  }

  void add_end(const Json& cell, const std::string& port, double setup_ns) {
    const Json& ports = cell.at("connections");
    if (!ports.contains(port)) return;
    const Kind kind = kind_of(cell.at("type"));
    const bool has_name = kind == Kind::ff || kind == Kind::latch;
    const unsigned output = has_name ? bit(ports.at("Q")[0]) : none;
    for (const Json& value : ports[port]) {
      const unsigned i = bit(value);
      if (i != none) graph_.ends.push_back({i, setup_ns, leaves_slice(i, kind, port), output});
    }
  }

  /// A clocked cell: from its clock to all outputs, and from all inputs to its clock.
  void add_clocked(const Json& cell, double out_ns, double setup_ns) {
    const Kind kind = kind_of(cell.at("type"));
    for (const auto& [port, values] : cell.at("connections").items()) {
      if (is_clock(kind, port)) continue;
      if (is_input(cell, port)) {
        add_end(cell, port, setup_ns);
      } else {
        add_start(cell, port, out_ns);
      }
    }
  }

  void add_cell(const Json& cell) {
    const std::string type = cell.at("type");
    switch (kind_of(type)) {
      case Kind::lut:
      case Kind::inverter:
      case Kind::mux:
        add_logic(cell, type);
        break;
      case Kind::carry:
        add_carry(cell);
        break;
      case Kind::ff:
      case Kind::latch:
        add_flip_flop(cell);
        break;
      case Kind::bram:
        add_clocked(cell, timing_["bram_out"], timing_["bram_setup"]);
        break;
      case Kind::lutram:
        add_distributed_memory(cell);
        break;
      case Kind::shift:
        add_clocked(cell, timing_["shift_out"], timing_["shift_setup"]);
        for (const char* input : {"A", "A0", "A1", "A2", "A3"}) {
          add_arcs(cell, input, "Q", timing_["lutram_read"]);
        }
        break;
      case Kind::dsp:
        add_multiplier(cell);
        break;
      case Kind::outside:
        break;
      case Kind::unknown:
        refuse(type, place_of(cell));
    }
  }

  /// "file:line: " from "file:line.column-line.column|…"; "" if that is not known.
  static std::string place_of(const Json& cell) {
    const auto attributes = cell.find("attributes");
    if (attributes == cell.end() || !attributes->contains("src")) return {};
    const std::string src = attributes->at("src");
    return src.substr(0, src.find('.', src.rfind(':', src.find('|')))) + ": ";
  }

  /// A cell of Yosys, or a primitive; one with parameters is called $paramod\NAME\... or
  /// $paramod$...\NAME.
  [[noreturn]] static void refuse(std::string type, const std::string& place) {
    if (starts_with(type, "$paramod")) {
      type.erase(0, type.find('\\') + 1);
      type.erase(std::min(type.find('\\'), type.size()));
    }
    throw vp::InputError(place + "'" + type +
                         "' is left after synthesis, and how long it takes is not known: " +
                         (type[0] == '$' ? "write it so that it can be synthesised"
                                         : "leave it outside of the module"));
  }

  void add_logic(const Json& cell, const std::string& type) {
    const double ns = type == "INV"     ? 0
                      : type == "MUXF7" ? timing_["muxf7"]
                      : type == "MUXF8" ? timing_["muxf8"]
                                        : timing_["lut"];
    for (const auto& [port, values] : cell.at("connections").items()) {
      if (is_input(cell, port)) add_arcs(cell, port, "O", ns);
    }
  }

  /// Bit i of S and DI reaches the sum and the carry of its own bit and of those above.
  void add_carry(const Json& cell) {
    const Json& ports = cell.at("connections");
    for (const char* output : {"O", "CO"}) {
      if (!ports.contains(output)) continue;
      const bool sum = std::string(output) == "O";
      const double enter = timing_[sum ? "carry_cross" : "carry_enter"];
      for (std::size_t to = 0; to < ports[output].size(); ++to) {
        for (std::size_t from = 0; from <= to; ++from) {
          add_arc(ports.at("S")[from], ports[output][to], enter, cell, "S");
          if (!sum || from < to)
            add_arc(ports.at("DI")[from], ports[output][to], enter, cell, "DI");
        }
      }
      add_arcs(cell, "CI", output, timing_[sum ? "carry_leave" : "carry_ripple"]);
      add_arcs(cell, "CYINIT", output, timing_["carry_start"]);
    }
  }

  void add_flip_flop(const Json& cell) {
    add_start(cell, "Q", timing_["ff_out"]);
    add_end(cell, "D", timing_["ff_data"]);
    for (const char* enable : {"CE", "GE"}) add_end(cell, enable, timing_["ff_enable"]);
    for (const char* reset : {"R", "S", "CLR", "PRE"}) add_end(cell, reset, timing_["ff_reset"]);
  }

  /// Written at the clock, read at any time.
  void add_distributed_memory(const Json& cell) {
    for (const auto& [port, values] : cell.at("connections").items()) {
      const bool only_read =
          starts_with(port, "DPRA") || port == "ADDRA" || port == "ADDRB" || port == "ADDRC";
      if (is_clock(Kind::lutram, port) || only_read) continue;
      if (is_input(cell, port)) {
        add_end(cell, port, timing_["lutram_setup"]);
      } else {
        add_start(cell, port, timing_["lutram_out"]);
      }
    }
    const double ns = timing_["lutram_read"];
    for (const auto& [port, values] : cell.at("connections").items()) {
      if (starts_with(port, "DPRA")) {
        add_arcs(cell, port, "DPO", ns);
      } else if (starts_with(port, "ADDR")) {
        add_arcs(cell, port, "DO" + port.substr(4), ns);
      } else if (starts_with(port, "A")) {
        add_arcs(cell, port, "SPO", ns);
        add_arcs(cell, port, "O", ns);
      }
    }
  }

  /// With a register at its output it ends a path; without one the product goes through.
  void add_multiplier(const Json& cell) {
    add_clocked(cell, timing_["dsp_out"], timing_["dsp_setup"]);
    const Json& parameters = cell.at("parameters");
    const auto registers = [&](const char* name) {
      const auto found = parameters.find(name);
      return found != parameters.end() && found->dump().find('1') != std::string::npos;
    };
    if (registers("PREG") || registers("MREG")) return;
    for (const char* output : {"P", "PCOUT"}) {
      if (!registers("AREG")) add_arcs(cell, "A", output, timing_["dsp_through"]);
      if (!registers("BREG")) add_arcs(cell, "B", output, timing_["dsp_through"]);
      if (!registers("CREG")) add_arcs(cell, "C", output, timing_["dsp_through"]);
    }
  }

  void name_bits(const Json& nets) {
    for (const auto& [name, net] : nets.items()) {
      if (net.value("hide_name", 0) != 0) continue;
      const Json& values = net.at("bits");
      for (std::size_t k = 0; k < values.size(); ++k) {
        const auto found =
            values[k].is_number() ? index_.find(values[k].get<unsigned>()) : index_.end();
        if (found == index_.end()) continue;
        std::string full = name;
        if (values.size() > 1) full += "[" + std::to_string(k) + "]";
        std::string& known = graph_.bits[found->second].name;
        if (known.empty() || full.size() < known.size()) known = full;
      }
    }
  }

  const PathTiming& timing_;
  std::unordered_map<unsigned, unsigned> index_;
  std::vector<Kind> drivers_;        ///< of each bit: what drives it is one cell
  std::vector<unsigned> entrances_;  ///< what enters carry chains
  TimingGraph graph_;
};

/// Yosys writes bits.
std::map<std::string, std::uint64_t> parameters_of(const Json& module) {
  std::map<std::string, std::uint64_t> parameters;
  const auto values = module.find("parameter_default_values");
  if (values == module.end()) return parameters;
  for (const auto& [name, value] : values->items()) {
    const std::string bits = value.is_string() ? value.get<std::string>() : "";
    if (bits.empty() || bits.size() > 64 || bits.find_first_not_of("01") != std::string::npos)
      continue;
    parameters[name] = std::stoull(bits, nullptr, 2);
  }
  return parameters;
}

/// An output is constant if what its buffer gets has no net.
void count_outputs(const Json& module, Netlist& netlist) {
  std::set<std::int64_t> constants;
  for (const auto& [name, cell] : module.at("cells").items()) {
    const Json& pins = cell.at("connections");
    if (cell.at("type") == "OBUF" && pins.at("I").at(0).is_string())
      constants.insert(pins.at("O").at(0).get<std::int64_t>());
  }
  const Json ports = module.value("ports", Json::object());
  for (const auto& [name, port] : ports.items()) {
    if (port.at("direction") != "output") continue;
    for (const Json& bit : port.at("bits")) {
      ++netlist.output_bits;
      if (bit.is_string() || constants.count(bit.get<std::int64_t>()) != 0) ++netlist.constant_bits;
    }
  }
}

}  // namespace

std::optional<Fmax> Netlist::fmax(const PathTiming& timing) const {
  if (!longest) return std::nullopt;
  const FmaxRange range = timing.fmax(*longest);
  const auto capped = [this](double mhz) { return std::min(mhz, limit.mhz); };
  return Fmax{{capped(range.low), capped(range.nominal), capped(range.high)},
              range.high > limit.mhz ? limit.of : ""};
}

Netlist read_netlist(const std::filesystem::path& file, const std::string& top,
                     const PathTiming& timing) {
  const Json json = host::read_json<Json>(file, "netlist", host::largest_result);
  const auto modules = json.find("modules");
  if (modules == json.end() || !modules->contains(top)) {
    throw vp::InputError("netlist '" + file.string() + "' has no module '" + top + "'");
  }
  const Json& module = (*modules)[top];
  Netlist netlist;
  netlist.parameters = parameters_of(module);
  for (const auto& [name, cell] : module.at("cells").items()) count(cell.at("type"), netlist.cells);
  GraphBuilder builder(module, timing);
  netlist.cells.lut_pairs = LutPairs(module.at("cells")).count();
  netlist.cells.lut_through = builder.luts_to_let_through();
  const TimingGraph graph = builder.take();
  const std::vector<unsigned> order = graph.in_order();
  // A path's nets are judged by their number and by the largest fan-out. So the longest path is
  // that of one of the graphs that are left below a fan-out.
  for (const unsigned fan_out : graph.fan_outs()) {
    const std::optional<Path> path = graph.longest(order, fan_out, timing.net_ns());
    if (!path) continue;
    if (!netlist.longest || timing.period_ns(*path) > timing.period_ns(*netlist.longest)) {
      netlist.longest = path;
    }
  }
  netlist.limit = clock_limit(module, timing);
  netlist.not_covered = clocks_not_covered(module);
  if (netlist.longest && netlist.longest->nets <= 1) {
    netlist.not_covered.push_back(
        "the longest path is a single net: how far a placer puts its ends apart is not known");
  }
  count_outputs(module, netlist);
  return netlist;
}

}  // namespace platform::synthesis
