#include <fpga/proof/miter.h>

#include <fmt/format.h>

#include <algorithm>

#include <host/document.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>

namespace platform::proof {

namespace {

namespace fs = std::filesystem;

constexpr const char* clock_name = "clk";

const Port* find(const std::vector<Port>& ports, const std::string& name) {
  const auto found =
      std::find_if(ports.begin(), ports.end(), [&](const Port& port) { return port.name == name; });
  return found == ports.end() ? nullptr : &*found;
}

[[noreturn]] void refuse(const Port& port, const std::string& why) {
  throw vp::InputError((port.place.empty() ? "" : port.place + ": ") + why);
}

/// "dir/a.sv:12.5-12.8|…" as "dir/a.sv:12".
std::string place_of(const std::string& src) {
  const std::size_t colon = src.find(':');
  return colon == std::string::npos ? src : src.substr(0, src.find_first_of(".|-", colon));
}

using Json = nlohmann::json;

std::string place_of(const Json& attributes) {
  return attributes.contains("src") ? place_of(attributes.at("src").get<std::string>()) : "";
}

bool has_a_one(const Json& cell, const std::string& parameter) {
  const auto& parameters = cell.at("parameters");
  if (!parameters.contains(parameter)) return true;
  return parameters.at(parameter).get<std::string>().find('1') != std::string::npos;
}

/// AIGER knows one clock, and Yosys takes each register as if it had that one.
void check_clock(const Json& cell, const Json& clock, const std::string& name) {
  constexpr const char* input = "CLK";
  const auto& connections = cell.at("connections");
  if (!connections.contains(input) || !has_a_one(cell, "CLK_ENABLE")) return;
  if (connections.at(input) == clock && has_a_one(cell, "CLK_POLARITY")) return;
  throw vp::InputError(
      place_of(cell.at("attributes")) +
      ": a register or memory is clocked by something else than the rising edge of '" + name +
      "': a proof has one clock; 'rtl check' plays it");
}

Json netlist_in(const fs::path& file) {
  return host::parse_json(vp::read_text(file, "netlist", host::largest_result),
                          "netlist '" + file.string() + "'");
}

}  // namespace

std::string declaration_of(const Port& port) {
  const std::string range = port.bits == 1 ? "" : fmt::format("[{}:0] ", port.bits - 1);
  return fmt::format("{} logic {}{}", port.output ? "output" : "input", range, port.name);
}

std::vector<Port> read_ports(const fs::path& file) {
  const Json json = netlist_in(file);
  const auto& module = json.at("modules").begin().value();
  std::vector<Port> ports;
  for (const auto& [name, port] : module.at("ports").items()) {
    const std::string direction = port.at("direction");
    const auto& attributes = module.at("netnames").at(name).at("attributes");
    const std::string place = place_of(attributes);
    if (direction == "inout")
      throw vp::InputError(place + ": port '" + name + "' is inout: give it one direction");
    ports.push_back(
        {name, static_cast<unsigned>(port.at("bits").size()), direction == "output", place});
  }
  return ports;
}

void check_clock(const fs::path& file, const std::string& name) {
  const Json json = netlist_in(file);
  const auto& module = json.at("modules").begin().value();
  const auto& all = module.at("ports");
  const Json clock = all.contains(name) ? all.at(name).at("bits") : Json();
  for (const auto& cell : module.at("cells")) check_clock(cell, clock, name);
}

const Contract& Miter::nothing() {
  static const Contract contract;
  return contract;
}

Miter::Miter(const Contract& contract, const synthesis::Parameters& parameters,
             const std::vector<Port>& ours, const std::vector<Port>& theirs)
    : contract_(contract), parameters_(parameters) {
  for (const Port& port : theirs) {
    const Port* const mine = find(ours, port.name);
    if (mine == nullptr) refuse(port, fmt::format("the IP has no port '{}': remove it", port.name));
    const bool narrower = port.bits < mine->bits && contract.reports.count(port.name) != 0;
    if (port.output != mine->output || (port.bits != mine->bits && !narrower))
      refuse(port, fmt::format("port '{}': declare '{}'", port.name, declaration_of(*mine)));
  }
  for (const Port& port : ours) {
    const bool needed = contract.reports.count(port.name) == 0 && !is_idle_lane(port.name);
    if (needed && find(theirs, port.name) == nullptr)
      throw vp::InputError(
          fmt::format("the RTL has no port '{}': declare '{}'", port.name, declaration_of(port)));
  }
  declare(ours);
  instance(Miter::ours, ours);
  instance(Miter::theirs, theirs);
  assume(ours);
  for (const Port& port : ours) {
    if (!port.output) continue;
    const Port* const other = find(theirs, port.name);
    if (other == nullptr || is_idle_lane(port.name))
      not_compared_.push_back(port.name);
    else
      compare(port, other->bits);
  }
  end();
}

Miter::Miter(const Contract& contract, const synthesis::Parameters& parameters,
             const std::vector<Port>& ours)
    : contract_(contract), parameters_(parameters) {
  declare(ours);
  instance(Miter::ours, ours);
  assume(ours);
  look_at_rules(ours);
  end();
}

/// Of a pixel that does not come with so many a clock: its input stays 0, its output has no
/// meaning.
bool Miter::is_idle_lane(const std::string& port) const {
  const auto lanes = parameters_.find("PIXELS_PER_CLOCK");
  const std::size_t end = port.size() - std::min<std::size_t>(port.size(), 2);
  const bool is_lane =
      port.substr(0, end).find("pixel") != port.npos || port.substr(0, end) == "binary_out";
  if (lanes == parameters_.end() || !is_lane || port[end] != '_') return false;
  return port[end + 1] >= '1' && port[end + 1] <= '3' && port[end + 1] - '0' >= lanes->second;
}

void Miter::declare(const std::vector<Port>& ours) {
  verilog_ = "module miter(\n  input clk";
  for (const Port& port : ours) {
    if (port.output || port.name == clock_name || is_idle_lane(port.name)) continue;
    inputs_.push_back(port);
    verilog_ += ",\n  " + declaration_of(port);
  }
  verilog_ += ",\n  output bad);\n";
  for (const auto& [name, value] : parameters_)
    verilog_ += fmt::format("localparam {} = {};\n", name, value);
  if (contract_.frames) verilog_ += "wire [15:0] now_x, now_y;\n";
  for (const Port& port : ours) {
    if (!port.output && is_idle_lane(port.name))
      verilog_ += fmt::format("wire [{}:0] {} = 0;\n", port.bits - 1, port.name);
  }
}

void Miter::instance(const char* side, const std::vector<Port>& ports) {
  std::string connections;
  for (const Port& port : ports) {
    const std::string net = port.output ? fmt::format("{}_{}", side, port.name) : placed(port.name);
    if (port.output) verilog_ += fmt::format("wire [{}:0] {};\n", port.bits - 1, net);
    connections += fmt::format("{}.{}({})", connections.empty() ? "" : ", ", port.name, net);
  }
  verilog_ += fmt::format("{0} {0}({1});\n", side, connections);
}

/// Where pixels come in raster order, the modules see the counters that say so, which the input has
/// to equal: an engine then need not find out that it does.
std::string Miter::placed(const std::string& input) const {
  if (!contract_.frames || input.empty()) return input;
  return input == contract_.frames->x ? "now_x" : input == contract_.frames->y ? "now_y" : input;
}

/// "por || rst"; "1'b0" without any.
std::string Miter::resets() const {
  return contract_.resets.empty() ? "1'b0" : vp::join(contract_.resets, " || ");
}

void Miter::assume(const std::vector<Port>& ours) {
  verilog_ += fmt::format(
      "wire reset = {};\n"
      "reg begun = 0, reset_before = 0, dropped = 0;\n"
      "wire [63:0] kept;\n"
      "wire allowed = &kept && !dropped;\n"
      "always @(posedge clk) begin\n"
      "  begun <= 1; reset_before <= reset; dropped <= !allowed;\n"
      "end\n",
      resets());
  unsigned rules = 0;
  const auto rule = [&](const std::string& holds) {
    verilog_ += fmt::format("assign kept[{}] = {};\n", rules++, holds);
  };
  rule("begun" + (contract_.resets.empty() ? " || 1'b1"
                                           : " || (" + vp::join(contract_.resets, " && ") + ")"));
  if (contract_.frames) {
    assume_frames(ours);
    rule("frames_kept");
  }
  for (const Contract::Toggle& t : contract_.toggles) {
    verilog_ += fmt::format(
        "reg {0}_before = 0, {1}_before = 0;\n"
        "always @(posedge clk) begin {0}_before <= {0}; {1}_before <= ours_{1}; end\n",
        t.toggle, t.seen);
    rule(fmt::format("reset_before ? !{0} : {0} == {0}_before || {1}_before == {0}_before",
                     t.toggle, t.seen));
  }
  for (const std::string& s : contract_.streams_in) {
    verilog_ += fmt::format(
        "reg {0}_waited = 0; reg [31:0] {0}_offered = 0;\n"
        "always @(posedge clk) begin {0}_waited <= {0}_tvalid && !ours_{0}_tready; "
        "{0}_offered <= {0}_tdata; end\n",
        s);
    rule(fmt::format("reset_before || !{0}_waited || ({0}_tvalid && {0}_tdata == {0}_offered)", s));
  }
  verilog_ += fmt::format("assign kept[63:{}] = ~0;\n", rules);
}

/// A frame's next pixel, and how long the last frame is over. Where the module has no HEIGHT, a
/// frame is as high as `y` can say; where it has no places, they are counted all the same.
void Miter::assume_frames(const std::vector<Port>& ours) {
  const Contract::Frames& f = *contract_.frames;
  const bool places = !f.x.empty();
  const std::string height =
      parameters_.count("HEIGHT") != 0 ? "HEIGHT" : fmt::format("(1 << {})", find(ours, f.y)->bits);
  const std::string step = parameters_.count("PIXELS_PER_CLOCK") != 0 ? "PIXELS_PER_CLOCK" : "1";
  verilog_ += fmt::format(
      "localparam GAP = {gap};\n"
      "reg frame_before = 0; reg [15:0] next_x = 0, next_y = 0, gap = GAP;\n"
      "assign now_x = frame_before ? next_x : 0, now_y = frame_before ? next_y : 0;\n"
      "wire row_ends = now_x + {step} == WIDTH;\n"
      "wire over = next_x == 0 && next_y == {height};\n"
      "wire at_place = {at_place};\n"
      "wire starts = !frame_before && gap >= GAP && {may_begin};\n"
      "wire frames_kept = {valid} ? !reset_before && at_place && (starts || (frame_before && "
      "!over))\n"
      "  : {cut};\n"
      "always @(posedge clk) begin\n"
      "  frame_before <= {valid};\n"
      "  if ({valid}) begin next_x <= row_ends ? 0 : now_x + {step}; "
      "next_y <= row_ends ? now_y + 1 : now_y; end\n"
      // Behind a reset nothing is left of the last frame.
      "  gap <= reset ? (GAP > 1 ? GAP - 1 : GAP) : {valid} ? 0 : gap < GAP ? gap + 1 : gap;\n"
      "end\n",
      fmt::arg("gap", f.gap), fmt::arg("step", step), fmt::arg("height", height),
      fmt::arg("at_place", places ? fmt::format("{} == now_x && {} == now_y", f.x, f.y) : "1'b1"),
      fmt::arg("may_begin", f.may_begin.empty() ? "1'b1" : "ours_" + f.may_begin),
      fmt::arg("valid", f.valid),
      fmt::arg("cut", f.whole ? "!frame_before || over || reset || reset_before" : "1'b1"));
}

/// Where theirs is narrower, its bits.
void Miter::compare(const Port& mine, unsigned bits) {
  std::string looked_at;
  for (const Contract::Gate& gate : contract_.gates) {
    if (gate.output != mine.name) continue;
    const bool is_input = find(inputs_, gate.by) != nullptr;
    looked_at = is_input ? gate.by : "ours_" + gate.by;
    if (!gate.once) continue;
    verilog_ +=
        fmt::format("reg {0}_written = 0;\nalways @(posedge clk) if ({1}) {0}_written <= 1;\n",
                    mine.name, looked_at + (is_input ? " && !reset" : ""));
    looked_at = mine.name + "_written";
  }
  differ(mine.name,
         fmt::format("{}ours_{}[{}:0] != theirs_{}", looked_at.empty() ? "" : looked_at + " && ",
                     mine.name, bits - 1, mine.name));
}

/// AXI4-Stream, by Arm's names (vp/protocol_rules.h).
void Miter::look_at_rules(const std::vector<Port>& ours) {
  for (const std::string& s : contract_.streams_out) {
    verilog_ += fmt::format(
        "reg {0}_stalls = 0;\nalways @(posedge clk) {0}_stalls <= "
        "ours_{0}_tvalid && !{0}_tready && !reset;\n",
        s);
    differ("AXI4STREAM_ERRM_TVALID_RESET", fmt::format("reset_before && ours_{}_tvalid", s));
    differ("AXI4STREAM_ERRM_TVALID_STABLE", fmt::format("{0}_stalls && !ours_{0}_tvalid", s));
    for (const char* wire : {"tdata", "tkeep", "tlast"}) {
      const std::string pin = fmt::format("ours_{}_{}", s, wire);
      if (find(ours, s + "_" + wire) == nullptr) continue;
      std::string rule = fmt::format("AXI4STREAM_ERRM_{}_STABLE", wire);
      std::transform(rule.begin(), rule.end(), rule.begin(),
                     [](unsigned char c) { return std::toupper(c); });
      verilog_ += fmt::format(
          "reg [31:0] {0}_before = 0;\nalways @(posedge clk) {0}_before <= {0};\n", pin);
      differ(rule, fmt::format("{}_stalls && {} != {}_before", s, pin, pin));
    }
  }
}

void Miter::differ(const std::string& name, const std::string& when) {
  verilog_ += fmt::format("wire differs_{} = {};\n", name, when);
  compared_.push_back(name);
}

void Miter::end() {
  std::string any;
  for (const std::string& name : compared_)
    any += (any.empty() ? "differs_" : " || differs_") + name;
  verilog_ += "assign bad = begun && allowed && (" + any + ");\nendmodule\n";
}

}  // namespace platform::proof
