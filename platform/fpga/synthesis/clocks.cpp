#include <fpga/synthesis/clocks.h>

#include <map>
#include <optional>
#include <set>
#include <unordered_map>

#include <fpga/synthesis/cell_kinds.h>
#include <vp/text.h>

namespace platform::synthesis {

namespace {

using Json = nlohmann::json;

std::string text_parameter(const Json& cell, const char* name) {
  const auto parameters = cell.find("parameters");
  if (parameters == cell.end()) return "";
  const auto found = parameters->find(name);
  return found != parameters->end() && found->is_string() ? found->get<std::string>() : "";
}

/// A parameter of one bit, which Yosys writes as 32.
bool is_set(const Json& cell, const char* name) {
  return text_parameter(cell, name).find('1') != std::string::npos;
}

/// The first place that Yosys names for a cell, outside of its own library: " (own.v:4)".
std::string place_of(const Json& cell) {
  const auto attributes = cell.find("attributes");
  const std::string all = attributes == cell.end() ? "" : attributes->value("src", "");
  for (const std::string& src : vp::split(all, '|')) {
    const bool has_line = src.find(":0.") == std::string::npos;
    if (src.empty() || !has_line || src.find("/yosys/") != std::string::npos) continue;
    const std::string place = src.substr(src.rfind('/') + 1);
    return " (" + place.substr(0, place.find('.', place.rfind(':'))) + ")";
  }
  return "";
}

/// From where a clock comes.
struct Origin {
  enum class Kind { port, logic, divider, chosen };

  Kind kind = Kind::port;
  std::string name;
  std::string place;      ///< of what makes it, in the sources
  bool inverted = false;  ///< an odd number of times on its way
  bool gated = false;     ///< passes a buffer with an enable
  bool regional = false;  ///< passes a regional buffer instead of a global one
};

class Clocks {
 public:
  explicit Clocks(const Json& module) {
    for (const auto& [name, net] : module.at("netnames").items()) {
      if (net.value("hide_name", 0) != 0) continue;
      const Json& bits = net.at("bits");
      for (std::size_t i = 0; i < bits.size(); ++i) {
        if (!bits[i].is_number()) continue;
        const std::string full = bits.size() == 1 ? name : name + "[" + std::to_string(i) + "]";
        std::string& known = names_[bits[i]];
        if (known.empty() || full.size() < known.size()) known = full;
      }
    }
    for (const auto& [name, cell] : module.at("cells").items()) {
      for (const auto& [port, bits] : cell.at("connections").items()) {
        if (cell.at("port_directions").at(port) == "input") continue;
        for (const Json& bit : bits) {
          if (bit.is_number()) drivers_[bit] = &cell;
        }
      }
    }
    name_through_buffers(module);
  }

  /// Through buffers and inverters, and back from what they bring to what drives them.
  Origin origin_of(unsigned bit) const {
    Origin origin;
    // Each step passes another cell; more steps than cells would be a loop of buffers.
    for (std::size_t step = 0; step <= drivers_.size(); ++step) {
      const auto driver = drivers_.find(bit);
      if (driver == drivers_.end()) break;
      const Json& cell = *driver->second;
      const std::optional<unsigned> before = pass(cell, origin);
      if (!before) {
        origin.place = place_of(cell);
        break;
      }
      bit = *before;
    }
    const auto name = names_.find(bit);
    origin.name = name == names_.end() ? "a net without name" : name->second;
    return origin;
  }

 private:
  /// What the RTL names is behind the buffer that Yosys puts at an output or a clock.
  void name_through_buffers(const Json& module) {
    for (const auto& [unused, cell] : module.at("cells").items()) {
      const Json& ports = cell.at("connections");
      if (kind_of(cell.at("type")) != Kind::outside || !ports.contains("I")) continue;
      const Json &in = ports.at("I")[0], &out = ports.at("O")[0];
      if (!in.is_number() || !out.is_number()) continue;
      const auto name = names_.find(out);
      if (name != names_.end()) names_.try_emplace(in, name->second);
    }
  }

  /// The bit before a buffer or an inverter; none where the clock is made.
  static std::optional<unsigned> pass(const Json& cell, Origin& origin) {
    const std::string type = cell.at("type");
    const Kind kind = kind_of(type);
    const Json& ports = cell.at("connections");
    const auto input = [&](const char* port) -> std::optional<unsigned> {
      const auto found = ports.find(port);
      if (found == ports.end() || found->empty() || !(*found)[0].is_number()) return std::nullopt;
      return (*found)[0].get<unsigned>();
    };
    if (kind == Kind::inverter || type == "LUT1") {
      origin.inverted = !origin.inverted;
      return input(type == "LUT1" ? "I0" : "I");
    }
    const bool divides = type == "BUFR" && !text_parameter(cell, "BUFR_DIVIDE").empty() &&
                         text_parameter(cell, "BUFR_DIVIDE") != "BYPASS";
    if (kind == Kind::outside && ports.contains("I") && !divides) {
      origin.gated |= type == "BUFGCE" || type == "BUFHCE";
      origin.regional |= type == "BUFR" || type == "BUFIO";
      return input("I");
    }
    origin.kind = type == "BUFGMUX" || type == "BUFGCTRL" ? Origin::Kind::chosen
                  : kind == Kind::ff || kind == Kind::latch || kind == Kind::shift || divides
                      ? Origin::Kind::divider
                      : Origin::Kind::logic;
    return std::nullopt;
  }

  std::unordered_map<unsigned, std::string> names_;
  std::unordered_map<unsigned, const Json*> drivers_;
};

/// Calls found(cell, port, bit) for each clock pin that a net drives.
template <class Found>
void each_clock_pin(const Json& module, const Found& found) {
  for (const auto& [name, cell] : module.at("cells").items()) {
    const Kind kind = kind_of(cell.at("type"));
    for (const auto& [port, bits] : cell.at("connections").items()) {
      if (kind == Kind::outside || !is_clock(kind, port) || bits.empty()) continue;
      if (bits[0].is_number()) found(cell, port, bits[0].template get<unsigned>());
    }
  }
}

/// Of a block RAM or a multiplier; 0: none of its own.
std::pair<double, const char*> limit_of(const Json& cell, const PathTiming& timing) {
  const Kind kind = kind_of(cell.at("type"));
  if (kind == Kind::bram) {
    for (const char* end : {"RAM_EXTENSION_A", "RAM_EXTENSION_B"}) {
      const std::string extension = text_parameter(cell, end);
      if (!extension.empty() && extension != "NONE")
        return {timing.limit_mhz("bram_cascaded"), "cascaded block RAM"};
    }
    const bool read_first = text_parameter(cell, "WRITE_MODE_A") == "READ_FIRST" ||
                            text_parameter(cell, "WRITE_MODE_B") == "READ_FIRST";
    if (read_first && text_parameter(cell, "RDADDR_COLLISION_HWCONFIG") != "PERFORMANCE")
      return {timing.limit_mhz("bram_read_first"), "block RAM that reads first"};
    return {timing.limit_mhz("bram"), "block RAM"};
  }
  if (kind != Kind::dsp) return {0, ""};
  if (is_set(cell, "PREG") && !is_set(cell, "MREG"))
    return {timing.limit_mhz("dsp_without_mreg"),
            "multiplier (DSP48E1) without its inner register"};
  return {timing.limit_mhz("dsp"), "multiplier (DSP48E1)"};
}

/// What Fmax leaves out of one clock; "" if nothing.
std::string why_not_covered(const Origin& origin) {
  const std::string name = "'" + origin.name + "'";
  switch (origin.kind) {
    case Origin::Kind::divider:
      return "the clock " + name + " is made by a register" + origin.place +
             ": its own frequency and its delay behind the clock that it is made of";
    case Origin::Kind::logic:
      return "the clock " + name + " comes out of logic" + origin.place +
             ": its delay, and glitches of the gate";
    case Origin::Kind::chosen:
      return "the clock " + name + " is chosen among several" + origin.place;
    case Origin::Kind::port:
      break;
  }
  return origin.gated ? "the clock " + name + " is gated by a buffer: when its enable must be there"
                      : "";
}

std::string joined(const std::set<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "'" : ", '") + name + "'";
  return text;
}

}  // namespace

ClockLimit clock_limit(const Json& module, const PathTiming& timing) {
  const Clocks clocks(module);
  std::set<unsigned> seen;
  ClockLimit limit{timing.limit_mhz("regional_buffer"), "regional clock buffer (BUFR, BUFIO)"};
  bool all_regional = true;
  each_clock_pin(module, [&](const Json&, const std::string&, unsigned bit) {
    if (seen.insert(bit).second) all_regional &= clocks.origin_of(bit).regional;
  });
  if (!all_regional || seen.empty())
    limit = {timing.limit_mhz("global_buffer"), "global clock buffer (BUFG)"};
  for (const auto& [name, cell] : module.at("cells").items()) {
    const auto [mhz, of] = limit_of(cell, timing);
    if (mhz != 0 && mhz < limit.mhz) limit = {mhz, of};
  }
  return limit;
}

std::vector<std::string> clocks_not_covered(const Json& module) {
  const Clocks clocks(module);
  std::vector<std::string> found;
  const auto say = [&](const std::string& text) {
    if (!text.empty() && std::find(found.begin(), found.end(), text) == found.end())
      found.push_back(text);
  };
  std::set<std::string> names;
  std::map<std::string, std::set<bool>> edges;  // falling or not, by clock
  std::set<std::string> latches;
  each_clock_pin(module, [&](const Json& cell, const std::string& port, unsigned bit) {
    const std::string type = cell.at("type");
    const Origin origin = clocks.origin_of(bit);
    if (kind_of(type) == Kind::latch) {
      const Json& q = cell.at("connections").at("Q")[0];
      const Origin held = q.is_number() ? clocks.origin_of(q) : Origin{};
      std::string name = held.name.substr(0, held.name.find('['));
      latches.insert("'" + name + "'" + place_of(cell));
      return;
    }
    names.insert(origin.name);
    say(why_not_covered(origin));
    const bool at_falling = type.size() > 2 && type.compare(type.size() - 2, 2, "_1") == 0;
    const bool inverted = is_set(cell, ("IS_" + port + "_INVERTED").c_str());
    edges[origin.name].insert(origin.inverted != (at_falling != inverted));
  });
  for (const std::string& latch : latches)
    say("a latch holds " + latch + ": what passes it while it is open");
  if (names.size() > 1) say("several clocks, " + joined(names) + ": paths from one to another");
  for (const auto& [name, both] : edges) {
    if (both.size() > 1)
      say("both edges of '" + name + "' are used: paths from one to the other have half a period");
  }
  return found;
}

}  // namespace platform::synthesis
