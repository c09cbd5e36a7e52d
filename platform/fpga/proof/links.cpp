#include <fpga/proof/links.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include <fpga/proof/miter.h>
#include <vp/error.h>
#include <vp/text.h>

namespace platform::proof {

namespace {

/// Requests that a manager has under way at a time: more are a matter of depth, not of rules.
constexpr unsigned most_open = 7;

/// A channel of a link: what goes along with its VALID.
struct Channel {
  std::string prefix;
  bool of_manager;
  std::vector<std::string> payload;
};

const std::vector<Channel>& channels_of(Link::Kind kind) {
  static const std::vector<std::string> address{"addr", "id",    "len",  "size", "burst",
                                                "lock", "cache", "prot", "qos",  "region"};
  static const std::vector<Channel> bus{{"aw", true, address},
                                        {"ar", true, address},
                                        {"w", true, {"data", "strb", "last"}},
                                        {"b", false, {"resp", "id"}},
                                        {"r", false, {"data", "resp", "last", "id"}}},
      stream{{"t", true, {"data", "keep", "strb", "last", "user", "id", "dest"}}};
  return kind == Link::Kind::axi_stream ? stream : bus;
}

}  // namespace

std::vector<std::string> assumptions(const Pins& pins) {
  std::vector<std::string> lines, resets;
  for (const Pins::Reset& reset : pins.resets)
    resets.push_back(reset.port + (reset.active_low ? " low" : " high"));
  if (!resets.empty())
    lines.push_back(vp::join(resets, " and ") + " on the first clock, and free from then on");
  lines.emplace_back(
      "registers and memories without an initial value start at 0, as on the chip; x is 0");
  lines.emplace_back(
      "the other end of each link keeps its rules: VALID and what goes with it stay until READY, "
      "and VALID is low in a reset and on the first clock behind it");
  const auto any = [&pins](Link::Kind kind) {
    return std::any_of(pins.links.begin(), pins.links.end(),
                       [kind](const Link& link) { return link.kind == kind; });
  };
  if (any(Link::Kind::axi_lite))
    lines.push_back(
        fmt::format("AXI4-Lite: {} requests of each kind wait for their response at "
                    "most, and what is answered was asked for",
                    most_open));
  if (any(Link::Kind::axi4))
    lines.emplace_back(
        "AXI4: the other end has one burst of each direction at a time, INCR and no wider than the "
        "data, with LAST on its last beat");
  for (const auto& [port, value] : pins.ties)
    lines.push_back(fmt::format("{} is 0x{:x} on every clock", port, value));
  lines.emplace_back("all other inputs are free");
  return lines;
}

namespace {

/// Throws vp::InputError for what cannot be tied.
void check_ties(const std::vector<Port>& ports, const Pins& pins) {
  for (const auto& [name, value] : pins.ties) {
    const std::string& tied = name;  // for lambdas, which cannot capture `name`
    const auto port = std::find_if(ports.begin(), ports.end(),
                                   [&tied](const Port& one) { return one.name == tied; });
    if (port == ports.end()) throw vp::InputError("--tie: the RTL has no port '" + name + "'");
    const auto refuse = [&](const std::string& why) {
      throw vp::InputError(port->place + ": --tie: '" + tied + "' " + why);
    };
    if (port->output) refuse("is an output: only inputs can be tied");
    if (name == pins.clock) refuse("is the clock: without edges there is nothing to prove");
    if (port->bits < 64 && value >> port->bits != 0)
      refuse("has " + std::to_string(port->bits) + " bits" + ", and " + vp::hex(value) +
             " does not fit");
    for (const Pins::Reset& reset : pins.resets) {
      if (reset.port == name)
        refuse("is a reset: say --interface \"" + name + ": wire\", or leave it free");
    }
  }
}

}  // namespace

/// Writes the rules of one link, and what is assumed of its other end.
class LinkRules {
 public:
  LinkRules(const Link& link, const std::vector<Port>& ports) : link_(link), ports_(ports) {
    for (const Channel& channel : channels_of(link.kind)) look_at(channel);
    if (link.kind != Link::Kind::axi_stream) count();
  }
  std::string verilog;
  std::vector<std::string> assumed;
  std::vector<std::pair<std::string, std::string>> rules;  ///< names, and when they are broken

 private:
  bool has(const std::string& signal) const { return link_.ports.count(signal) != 0; }
  /// The net of a signal; `otherwise` where the RTL has none.
  std::string net(const std::string& signal, const std::string& otherwise = "1'b1") const {
    return has(signal) ? port(signal).output ? "ours_" + port(signal).name : port(signal).name
                       : otherwise;
  }
  const Port& port(const std::string& signal) const {
    const std::string name = Miter::input_prefix + link_.ports.at(signal);
    return *std::find_if(ports_.begin(), ports_.end(), [&](const Port& one) {
      return one.name == name || Miter::input_prefix + one.name == name;
    });
  }
  std::string own(const std::string& text) const { return link_.name + "_" + text; }
  bool drives(const Channel& channel) const { return channel.of_manager != link_.slave; }
  std::string rule_of(const Channel& channel, const std::string& what) const {
    return (link_.kind == Link::Kind::axi_stream ? "AXI4STREAM_ERR" : "AXI4_ERR") +
           std::string(channel.of_manager ? "M_" : "S_") + vp::upper(what);
  }
  void broken(const std::string& rule, const std::string& when) {
    rules.emplace_back(own(rule), when);
  }
  void look_at(const Channel& channel);
  void look_at_payload(const Channel& channel, const std::string& signal, const std::string& waits);
  void count();
  void follow_burst(const std::string& request, const std::string& data);
  bool is_lite() const { return link_.kind == Link::Kind::axi_lite; }
  void count_one(const std::string& name, const std::string& more, const std::string& less);

  const Link& link_;
  const std::vector<Port>& ports_;
};

void LinkRules::look_at(const Channel& channel) {
  const std::string& c = channel.prefix;
  if (!has(c + "valid")) return;
  const std::string valid = net(c + "valid"), waits = own(c + "_waits");
  verilog += fmt::format(
      "reg {0} = 0;\nalways @(posedge clk) {0} <= {1} && !{2} && !reset;\n"
      "wire {3} = {1} && {2} && !reset;\n",
      waits, valid, net(c + "ready"), own(c + "_passes"));
  if (drives(channel)) {
    broken(rule_of(channel, c + "valid_reset"), fmt::format("reset_before && !reset && {}", valid));
    broken(rule_of(channel, c + "valid_stable"), fmt::format("{} && !reset && !{}", waits, valid));
  } else {
    assumed.push_back(fmt::format("!{} || !(reset || reset_before)", valid));
    assumed.push_back(fmt::format("!{} || reset || {}", waits, valid));
  }
  for (const std::string& signal : channel.payload) {
    if (has(c + signal)) look_at_payload(channel, c + signal, waits);
  }
}

/// Of data that are written or kept, the bytes that are.
void LinkRules::look_at_payload(const Channel& channel, const std::string& signal,
                                const std::string& waits) {
  const std::string now = net(signal), before = own(signal + "_before");
  const unsigned bits = port(signal).bits;
  verilog += fmt::format("reg [{}:0] {} = 0;\nalways @(posedge clk) {} <= {};\n", bits - 1, before,
                         before, now);
  const std::string lanes = signal == "wdata" ? "wstrb" : signal == "tdata" ? "tkeep" : "";
  std::string changed;
  if (!lanes.empty() && has(lanes) && port(lanes).bits * 8 == bits) {
    for (unsigned lane = 0; lane < bits / 8; ++lane) {
      const std::string on = port(lanes).bits == 1 ? "" : fmt::format("[{}]", lane);
      changed += fmt::format("{}({}{} && {}[{}:{}] != {}[{}:{}])", lane == 0 ? "" : " || ",
                             own(lanes + "_before"), on, now, 8 * lane + 7, 8 * lane, before,
                             8 * lane + 7, 8 * lane);
    }
  } else {
    changed = fmt::format("{} != {}", now, before);
  }
  const std::string valid = net(channel.prefix + "valid");
  if (drives(channel))
    broken(rule_of(channel, signal + "_stable"),
           fmt::format("{} && !reset && {} && ({})", waits, valid, changed));
  else
    assumed.push_back(fmt::format("!{} || reset || {} == {}", waits, now, before));
}

void LinkRules::count_one(const std::string& name, const std::string& more,
                          const std::string& less) {
  verilog += fmt::format(
      "reg [3:0] {0} = 0;\nalways @(posedge clk) if (reset) {0} <= 0; "
      "else {0} <= {0} + {{3'b0, {1}}} - {{3'b0, {2}}};\n",
      own(name), more, less);
}

/// Responses answer requests.
void LinkRules::count() {
  struct Count {
    const char *name, *request, *response, *rule;
  };
  std::vector<Count> counts;
  if (has("awvalid") && has("bvalid")) {
    counts.push_back({"aw_open", "aw", "b", "BRESP_AW"});
    counts.push_back({"w_open", "w", "b", is_lite() ? "BRESP_WLAST" : ""});
  }
  if (has("arvalid") && has("rvalid")) counts.push_back({"ar_open", "ar", "r", "RID"});
  for (const auto& [name, request, response, rule] : counts) {
    const std::string r = response, q = request;
    count_one(name, own(q + "_passes") + (q == "w" ? " && " + net("wlast") : ""),
              own(r + "_passes") + (r == "r" ? " && " + net("rlast") : ""));
    const std::string none = fmt::format("{} && {} == 0", net(r + "valid"), own(name));
    if (!link_.slave) {
      assumed.push_back("reset || !(" + none + ")");
      assumed.push_back("!" + own(name) + "[3]");
    } else {
      if (*rule != 0) broken("AXI4_ERRS_" + std::string(rule), "!reset && " + none);
      assumed.push_back(fmt::format("!({} && {} == {})", net(q + "valid"), own(name), most_open));
    }
  }
  if (!is_lite()) {
    if (has("awvalid")) follow_burst("aw", "w");
    if (has("arvalid")) follow_burst("ar", "r");
    return;
  }
  for (const char* response : {"bresp", "rresp"}) {
    if (!has(response)) continue;
    const std::string exokay =
        fmt::format("{} && {} == 1", net(std::string(1, *response) + "valid"), net(response));
    if (link_.slave)
      broken("AXI4_ERRS_" + vp::upper(response) + "_EXOKAY", "!reset && " + exokay);
    else
      assumed.push_back("!(" + exokay + ")");
  }
}

/// The other end sends and takes one burst of AXI4 at a time, whose LAST it sets where it belongs.
void LinkRules::follow_burst(const std::string& request, const std::string& data) {
  const std::string left = own(data + "_left"), passes = own(request + "_passes");
  const std::string length = has(request + "len") ? net(request + "len") : "8'd0";
  verilog += fmt::format(
      "reg [8:0] {0} = 0;\nalways @(posedge clk) if (reset) {0} <= 0; else if ({1}) {0} <= {2} + "
      "1; "
      "else if ({3} && {0} != 0) {0} <= {0} - 1;\n",
      left, passes, length, own(data + "_passes"));
  const bool sends = (data == "w") == link_.slave;  // the other end sends the data
  if (sends) {
    assumed.push_back(fmt::format("!{} || {} != 0", net(data + "valid"), left));
    if (has(data + "last"))
      assumed.push_back(
          fmt::format("!{} || {} == ({} == 1)", net(data + "valid"), net(data + "last"), left));
  }
  const std::string open = own(request + "_open");
  if (!has(data == "w" ? "bvalid" : "rvalid")) return;
  if (!link_.slave) {
    assumed.push_back(fmt::format("!{} || {} == 0", net(request + "ready"), open));
    return;
  }
  assumed.push_back(fmt::format("!{} || ({} == 0 && {} == 0)", net(request + "valid"), open, left));
  if (has(request + "burst"))
    assumed.push_back(
        fmt::format("!{} || {} == 1", net(request + "valid"), net(request + "burst")));
  if (has(request + "size"))
    assumed.push_back(fmt::format("!{} || 8 << {} <= {}", net(request + "valid"),
                                  net(request + "size"), port(data + "data").bits));
}

// Inputs have names of their own: a port may be called `reset` or `bad`.
Miter::Miter(const std::vector<Port>& ports, const Pins& pins) : contract_(nothing()) {
  check_ties(ports, pins);
  std::string connections, outputs;
  std::vector<Port> nets;
  verilog_ = "module miter(\n  input clk";
  for (const Port& port : ports) {
    std::string net = "clk";
    if (port.output) {
      net = "ours_" + port.name;
      outputs += fmt::format("wire [{}:0] {};\n", port.bits - 1, net);
    } else if (const auto tie = pins.ties.find(port.name); tie != pins.ties.end()) {
      net = input_prefix + port.name;
      outputs += fmt::format("wire [{0}:0] {1} = {2};\n", port.bits - 1, net,
                             fmt::format("{}'h{:x}", port.bits, tie->second));
      nets.push_back({net, port.bits, false, port.place});
    } else if (port.name != pins.clock) {
      net = input_prefix + port.name;
      inputs_.push_back({net, port.bits, false, port.place});
      verilog_ += ",\n  " + declaration_of(inputs_.back());
    }
    connections += fmt::format("{}.{}({})", connections.empty() ? "" : ", ", port.name, net);
  }
  nets.insert(nets.end(), inputs_.begin(), inputs_.end());
  std::copy_if(ports.begin(), ports.end(), std::back_inserter(nets),
               [](const Port& port) { return port.output; });
  std::string any = "1'b0", all = "1'b1";
  for (const Pins::Reset& reset : pins.resets) {
    const std::string active = (reset.active_low ? "!" : "") + (input_prefix + reset.port);
    any += " || " + active;
    all += " && " + active;
  }
  verilog_ += fmt::format(
      ",\n  output bad);\n{0}ours ours({1});\nwire reset = {2};\n"
      "reg begun = 0, reset_before = 0, dropped = 0;\n",
      outputs, connections, any);
  std::string kept = "begun" + (pins.resets.empty() ? " || 1'b1" : " || (" + all + ")");
  kept = "(" + kept + ")";
  for (const Link& link : pins.links) {
    const LinkRules rules(link, nets);
    verilog_ += rules.verilog;
    for (const auto& [name, when] : rules.rules) differ(name, when);
    for (const std::string& holds : rules.assumed) kept += " && (" + holds + ")";
  }
  verilog_ += "wire allowed = !dropped && " + kept +
              ";\nalways @(posedge clk) begin begun <= 1; reset_before <= reset; "
              "dropped <= !allowed; end\n";
  end();
}

}  // namespace platform::proof
