#include <axi/interfaces.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <utility>

#include <vp/error.h>
#include <vp/text.h>

namespace axi {

namespace {

/// "s_axi_awvalid": interface and signal. Behind the signal `_i` and `_o` are ignored.
struct Split {
  std::string interface, signal;
};

std::optional<Split> split(const std::string& port) {
  static const std::regex form(
      "^(?:(.*)_)?((?:aw|ar)(?:id|addr|len|size|burst|lock|cache|prot|qos|region|user|valid|ready)"
      "|w(?:id|data|strb|last|user|valid|ready)|b(?:id|resp|user|valid|ready)"
      "|r(?:id|data|resp|last|user|valid|ready)"
      "|t(?:data|keep|strb|last|id|dest|user|valid|ready))(?:_[io])?$",
      std::regex::icase);
  std::smatch match;
  if (!std::regex_match(port, match, form)) return {};
  return Split{match[1], vp::lower(match[2].str())};
}

/// How much two names begin alike: whole words first, as s00_axi is nearer to s00_axi_aclk than to
/// s00_axis_aclk, then characters.
std::pair<std::size_t, std::size_t> common_start(const std::string& a, const std::string& b) {
  std::size_t words = 0, length = 0;
  const auto ends = [&](const std::string& name) {
    return length == name.size() || name[length] == '_';
  };
  for (; length < std::min(a.size(), b.size()) && a[length] == b[length]; ++length) {
    if (a[length] == '_') ++words;
  }
  if (length > 0 && ends(a) && ends(b)) ++words;
  return {words, length};
}

bool of_stream(const std::string& signal) {
  return signal.front() == 't';
}

/// The bits of a signal that all interfaces have the same of; 0: they differ. AXI3 has other ones
/// of LOCK and LEN.
unsigned bits_of(const std::string& signal) {
  for (const char* end : {"valid", "ready", "last"}) {
    if (vp::ends_with(signal, end)) return 1;
  }
  if (vp::ends_with(signal, "resp") || vp::ends_with(signal, "burst")) return 2;
  return vp::ends_with(signal, "size") ? 3 : 0;
}

/// What one interface must have to be whole.
std::vector<std::string> required(const Interface& interface) {
  if (interface.kind == Kind::axi_stream) return {"tdata", "tvalid"};
  std::vector<std::string> list;
  const auto add = [&list](std::initializer_list<const char*> signals) {
    list.insert(list.end(), signals.begin(), signals.end());
  };
  if (interface.has("awvalid") || interface.has("wvalid") || interface.has("bvalid"))
    add({"awaddr", "awvalid", "awready", "wdata", "wvalid", "wready", "bvalid", "bready"});
  if (interface.has("arvalid") || interface.has("rvalid"))
    add({"araddr", "arvalid", "arready", "rdata", "rvalid", "rready"});
  return list;
}

class Finder {
 public:
  Finder(const RtlDescriptor& rtl, std::string option)
      : rtl_(rtl), option_(std::move(option)), owner_(rtl.port_count) {}

  std::vector<Interface> find() {
    check_notes();
    group_ports();
    for (Interface& interface : found_) classify(interface);
    add_single_ports();
    std::sort(found_.begin(), found_.end(),
              [](const Interface& a, const Interface& b) { return first_port(a) < first_port(b); });
    for (Interface& interface : found_) find_clock(interface);
    return std::move(found_);
  }

 private:
  static std::uint32_t first_port(const Interface& interface) {
    std::uint32_t first = ~0u;
    for (const auto& [signal, port] : interface.ports) first = std::min(first, port);
    return first;
  }
  const RtlPort& port(std::uint32_t number) const { return rtl_.ports[number]; }

  [[noreturn]] void refuse(const std::string& place, const std::string& why) const {
    throw vp::InputError(place + ": " + why);
  }

  /// What is said of a port or of the prefix of several; "" if nothing is.
  std::string note(const char* what, const std::string& name) const {
    for (std::uint32_t i = 0; i < rtl_.note_count; ++i) {
      if (std::string(rtl_.notes[i].what) == what &&
          vp::lower(rtl_.notes[i].port) == vp::lower(name))
        return rtl_.notes[i].text;
    }
    return {};
  }
  /// The value of a key in X_INTERFACE_PARAMETER of any port: "ASSOCIATED_BUSIF a:b, POLARITY …".
  static std::string parameter(const std::string& text, const std::string& key) {
    std::smatch match;
    const std::regex form("(?:^|[, ])" + key + " +([^, ]+)", std::regex::icase);
    return std::regex_search(text, match, form) ? match[1].str() : std::string();
  }
  static bool says(const std::string& note, const std::string& word) {
    std::istringstream words(note);
    for (std::string found; words >> found;) {
      if (found == word) return true;
    }
    return false;
  }
  /// "" if it says only other things: "clock b_clk", "high".
  static std::string said_kind(const std::string& note) {
    std::istringstream words(note);
    std::string first, second;
    words >> first >> second;
    if (first == "clock") return second.empty() ? first : "";
    return first == "reset" || first == "interrupt" || first == "wire" ? first : "";
  }
  static std::string said_clock(const std::string& note) {
    std::istringstream words(note);
    for (std::string word; words >> word;) {
      if (word == "clock" && words >> word) return word;
    }
    return {};
  }

  void check_notes() const;
  void group_ports();
  void classify(Interface& interface) const;
  void add_single_ports();
  Interface single(std::uint32_t number) const;
  bool is_low(const std::string& name, const std::string& said) const;
  void find_clock(Interface& interface) const;
  std::vector<std::string> clocks() const;
  bool is_associated(const std::string& clock, const std::string& name) const;

  const RtlDescriptor& rtl_;
  const std::string option_;  ///< by which users say what a port is
  std::vector<bool> owner_;   ///< the port belongs to an interface
  std::vector<Interface> found_;
};

const std::set<std::string>& known_words() {
  static const std::set<std::string> words{"axi4",  "axi_lite", "stream", "interrupt", "clock",
                                           "reset", "wire",     "high",   "low",       "rising"};
  return words;
}

void Finder::check_notes() const {
  for (std::uint32_t i = 0; i < rtl_.note_count; ++i) {
    const RtlNote& note = rtl_.notes[i];
    if (std::string(note.what) != "interface") continue;
    const std::string name = vp::lower(note.port);
    const auto belongs = [&](const RtlPort& port) {
      const std::string whole = vp::lower(port.name);
      return whole == name || whole.rfind(name + "_", 0) == 0;
    };
    if (std::none_of(rtl_.ports, rtl_.ports + rtl_.port_count, belongs))
      refuse(rtl_.place, option_ + " speaks of '" + note.port + "', and module '" + rtl_.top +
                             "' has no such port");
    for (std::uint32_t k = 0; k < i; ++k) {
      if (std::string(rtl_.notes[k].what) == note.what && vp::lower(rtl_.notes[k].port) == name)
        refuse(rtl_.place,
               option_ + " speaks of '" + note.port + "' twice: say all of it in one place");
    }
    std::istringstream words(note.text);
    std::string clock;
    for (std::string word; words >> word;) {
      if (known_words().count(word) == 0)
        refuse(rtl_.place, option_ + " says '" + word + "' of '" + note.port + "': use " +
                               vp::one_of({known_words().begin(), known_words().end()}));
      if (word == "clock" && words >> word && !std::exchange(clock, word).empty())
        refuse(rtl_.place,
               option_ + " gives '" + note.port + "' more than one clock: each interface has one");
    }
  }
}

/// Ports whose names, or whose attributes, say an interface and a signal of it.
void Finder::group_ports() {
  std::map<std::pair<std::string, bool>, Interface> groups;
  for (std::uint32_t i = 0; i < rtl_.port_count; ++i) {
    std::optional<Split> at = split(port(i).name);
    // "xilinx.com:interface:aximm:1.0 S_AXI AWADDR"
    std::istringstream info(note("info", port(i).name));
    std::string vlnv, interface, signal;
    if (info >> vlnv >> interface >> signal &&
        (vlnv.find(":aximm:") != vlnv.npos || vlnv.find(":axis:") != vlnv.npos)) {
      at = Split{interface, vp::lower(signal)};
    }
    if (!at || says(note("interface", at->interface), "wire") ||
        !note("interface", port(i).name).empty()) {
      continue;
    }
    Interface& group = groups[{vp::lower(at->interface), of_stream(at->signal)}];
    if (group.ports.empty()) group.name = at->interface;
    group.kind = of_stream(at->signal) ? Kind::axi_stream : Kind::axi_lite;
    group.ports[at->signal] = i;
  }
  for (auto& [key, group] : groups) {
    // Without any VALID they are wires that happen to be called so.
    if (!group.has("awvalid") && !group.has("arvalid") && !group.has("tvalid")) continue;
    for (const auto& [signal, number] : group.ports) owner_[number] = true;
    if (group.name.empty()) group.name = group.kind == Kind::axi_stream ? "axis" : "axi";
    found_.push_back(group);
  }
}

void Finder::classify(Interface& interface) const {
  const std::string valid = interface.has("tvalid")    ? "tvalid"
                            : interface.has("awvalid") ? "awvalid"
                                                       : "arvalid";
  const RtlPort& shown = port(interface.ports.at(valid));
  interface.slave = shown.output == 0;
  const bool bursts = interface.has("awlen") || interface.has("arlen") || interface.has("wlast") ||
                      interface.has("rlast");
  if (interface.kind != Kind::axi_stream) interface.kind = bursts ? Kind::axi4 : Kind::axi_lite;
  for (const std::string& signal : required(interface)) {
    if (interface.has(signal)) continue;
    refuse(shown.place, "half an interface: '" + interface.name + "' has '" + shown.name +
                            "' and lacks its signal '" + signal + "'; add the port, or say " +
                            option_ + " \"" + interface.name + ": wire\"");
  }
  for (const auto& [signal, number] : interface.ports) {
    if (const unsigned bits = bits_of(signal); bits != 0 && port(number).bits != bits)
      refuse(port(number).place, std::string("port '") + port(number).name + "' has " +
                                     std::to_string(port(number).bits) + " bits: " +
                                     vp::upper(signal) + " of AXI has " + std::to_string(bits));
    const bool answers =
        vp::ends_with(signal, "ready") != (signal.front() == 'b' || signal.front() == 'r');
    const bool output = interface.slave ? answers : !answers;
    if ((port(number).output != 0) == output) continue;
    refuse(port(number).place, std::string("port '") + port(number).name + "' of the " +
                                   (interface.slave ? "slave '" : "master '") + interface.name +
                                   "' must be an " + (output ? "output" : "input"));
  }
}

bool Finder::is_low(const std::string& name, const std::string& said) const {
  if (says(said, "low") || says(said, "high")) return says(said, "low");
  const std::string polarity = vp::lower(parameter(note("parameter", name), "POLARITY"));
  if (!polarity.empty()) return polarity == "active_low";
  for (const char* end : {"resetn", "rstn", "rst_n", "reset_n", "rst_ni", "reset_ni"}) {
    if (vp::ends_with(vp::lower(name), end)) return true;
  }
  // ARESETn without its n, and what high-level synthesis calls a reset that is high.
  for (const char* end : {"areset", "ap_rst"}) {
    if (vp::ends_with(vp::lower(name), end)) return false;
  }
  const auto* place = std::find_if(rtl_.ports, rtl_.ports + rtl_.port_count,
                                   [&](const RtlPort& port) { return port.name == name; });
  refuse(place->place, "reset '" + name +
                           "' does not say at which level it resets: the vendor's "
                           "tools take it for low, most sources mean high; say " +
                           option_ + " \"" + name + ": reset high\" or \"" + name +
                           ": reset low\", or \"" + name + ": wire\" if it resets nothing");
}

Interface Finder::single(std::uint32_t number) const {
  static const std::regex clock("(.*_)?(clk|clkin|clock(_.*)?|aclk|aclkin|clk_i)|.*_aclk",
                                std::regex::icase);
  static const std::regex reset(
      "(.*_)?(areset|aresetn|axi_resetn|reset(_.*)?|resetin|resetn|rst|rst_n|rstin|rstn|rst_i|rst_"
      "ni)",
      std::regex::icase);
  static const std::regex interrupt("interrupt|irq|intr|introut|.*_(irq|intr|introut|interrupt)",
                                    std::regex::icase);
  Interface one;
  one.name = port(number).name;
  one.slave = port(number).output == 0;
  one.ports[""] = number;
  const std::string said = note("interface", one.name), info = note("info", one.name);
  const bool bit = port(number).bits == 1;
  const auto is = [&](const char* word, const char* vlnv, bool by_name) {
    const std::string kind = said_kind(said);
    if (!kind.empty()) return kind == word;
    if (!info.empty()) return info.find(vlnv) != info.npos;
    return bit && by_name;
  };
  if (is("clock", "signal:clock:", one.slave && std::regex_match(one.name, clock))) {
    one.kind = Kind::clock;
  } else if (is("reset", "signal:reset:", one.slave && std::regex_match(one.name, reset))) {
    one.kind = Kind::reset;
    one.active_low = is_low(one.name, said);
  } else if (is("interrupt",
                "signal:interrupt:", !one.slave && std::regex_match(one.name, interrupt))) {
    one.kind = Kind::interrupt;
    const std::string sense = vp::lower(parameter(note("parameter", one.name), "SENSITIVITY"));
    one.edge = says(said, "rising") || sense == "edge_rising";
  }
  if (one.kind != Kind::wire && !bit)
    refuse(port(number).place, "port '" + one.name + "' is a " + to_string(one.kind) + " and has " +
                                   std::to_string(port(number).bits) + " bits: it must have one");
  return one;
}

void Finder::add_single_ports() {
  for (std::uint32_t i = 0; i < rtl_.port_count; ++i) {
    if (!owner_[i]) found_.push_back(single(i));
  }
}

std::vector<std::string> Finder::clocks() const {
  std::vector<std::string> names;
  for (const Interface& interface : found_) {
    if (interface.kind == Kind::clock) names.push_back(interface.name);
  }
  return names;
}

bool Finder::is_associated(const std::string& clock, const std::string& name) const {
  const std::string text = note("parameter", clock);
  const std::string associated = ":" + vp::lower(parameter(text, "ASSOCIATED_BUSIF")) + ":" +
                                 vp::lower(parameter(text, "ASSOCIATED_RESET")) + ":";
  return associated.find(":" + vp::lower(name) + ":") != associated.npos;
}

void Finder::find_clock(Interface& interface) const {
  if (interface.kind == Kind::clock) return;
  const std::vector<std::string> names = clocks();
  const std::string said = said_clock(note("interface", interface.name));
  if (!said.empty()) {
    if (std::find(names.begin(), names.end(), said) == names.end())
      refuse(rtl_.place, option_ + " says that '" + interface.name + "' belongs to clock '" + said +
                             "', which the RTL does not have");
    interface.clock = said;
    return;
  }
  std::vector<std::string> best, associated;
  std::pair<std::size_t, std::size_t> longest;
  for (const std::string& name : names) {
    if (is_associated(name, interface.name)) associated.push_back(name);
    const auto common = common_start(vp::lower(name), vp::lower(interface.name));
    if (common > longest) best.clear();
    if (common >= longest) best.push_back(name);
    longest = std::max(longest, common);
  }
  if (!associated.empty()) best = associated;
  if (best.size() == 1) interface.clock = best.front();
  const bool needs_one = interface.kind == Kind::axi4 || interface.kind == Kind::axi_lite ||
                         interface.kind == Kind::axi_stream;
  if (!interface.clock.empty() || !needs_one) return;
  refuse(port(first_port(interface)).place,
         names.empty() ? "interface '" + interface.name + "' has no clock: no port is one; say " +
                             option_ + " \"<port>: clock\""
                       : "interface '" + interface.name + "' may belong to " + vp::one_of(names) +
                             ": say " + option_ + " \"" + interface.name + ": clock <port>\"");
}

}  // namespace

const char* to_string(Kind kind) {
  switch (kind) {
    case Kind::axi4:
      return "AXI4";
    case Kind::axi_lite:
      return "AXI4-Lite";
    case Kind::axi_stream:
      return "AXI4-Stream";
    case Kind::interrupt:
      return "interrupt";
    case Kind::clock:
      return "clock";
    case Kind::reset:
      return "reset";
    case Kind::wire:
      break;
  }
  return "wire";
}

std::vector<Interface> find_interfaces(const RtlDescriptor& rtl, const std::string& option) {
  return Finder(rtl, option).find();
}

}  // namespace axi
