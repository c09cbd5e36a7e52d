#include <chip/block_design/diagram.h>

#include <chip/block_design/shelf.h>
#include <host/process.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>
#include <vp/unit.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace platform::block_design {

namespace {

/// Fill colours of clocks, light enough for black text; later clocks begin again.
constexpr std::array palette{"#cfe8ff", "#ffe3c2", "#d9f2d0", "#f4d3ee", "#fff3b0", "#e0dcff",
                             "#c8f0ee", "#ffd2d2", "#dedede", "#e8d9b5", "#c9dcc0", "#f7c6a5"};

constexpr unsigned deepest = 8;  ///< concats one behind the other

/// Parts without a line, in a row of the group that holds them.
constexpr std::size_t parts_in_a_row = 4;

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + "\"";
}

/// For a label in HTML.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// What a line is.
enum class Line { bus, stream, interrupt, wire };

/// How Graphviz draws it. Heavy lines are short and straight.
const char* look_of(Line line) {
  switch (line) {
    case Line::bus:
      return "penwidth=2, weight=3";
    case Line::stream:
      return "penwidth=3, color=\"#2a6fbb\", weight=6";
    case Line::interrupt:
      return "color=\"#c0392b\"";
    case Line::wire:
      break;
  }
  return "color=gray40";
}

/// Collects lines, then writes node by node and line by line. The PS is a node for what it drives,
/// at the left, and one for what it takes, at the right: so lines lead from the left to the right.
class Drawing {
 public:
  explicit Drawing(const DesignFile& design) : design_(design) {
    for (const PlacedPart& part : design.parts) {
      const IpRule* rule = rule_for(part.vlnv);
      if (part.is_stub()) stubs_.insert(part.name);
      if (rule && rule->ip == "clk_wiz") managers_.insert(part.name);
    }
    for (const AddressSegment& segment : design.addresses) {
      std::string& label = places_[segment.slave.part];
      label += (label.empty() ? "" : "\\n") + vp::hex(segment.base) + ", " +
               vp::format_quantity(vp::Decimal(static_cast<vp::Decimal::Whole>(segment.size), 0),
                                   vp::Unit::bytes);
      mapped_.insert(segment.slave.text());
    }
    for (const PlacedPart& part : design.parts) collect(part);
  }

  std::string draw() {
    text_ = "digraph " + quoted(design_.name) +
            " {\n  rankdir=LR; nodesep=0.15; ranksep=0.45;\n  node [shape=box, style=filled, "
            "fontname=\"DejaVu Sans\", fontsize=10, fillcolor=white];\n  edge [fontname=\"DejaVu "
            "Sans\", fontsize=8];\n";
    std::vector<const PlacedPart*> loose;
    for (const PlacedPart& part : design_.parts) {
      if (joined_.count(part.name) == 0 && joined_.count(inputs_of(part.name)) == 0) {
        loose.push_back(&part);
      } else {
        node(part, "  ");
      }
    }
    for (const ExternalPin& pin : design_.external) {
      if (joined_.count("external." + pin.name) != 0)
        text_ += "  " + quoted("external." + pin.name) + " [shape=cds, label=" + quoted(pin.name) +
                 "];\n";
    }
    for (const auto& [ends, what] : lines_) line(ends, what);
    group(loose);
    legend();
    return text_ + "}\n";
  }

 private:
  using Ends = std::tuple<std::string, std::string, Line>;  ///< from, to

  bool is_clock(const End& source) const {
    if (source.part == "external") return design_.pin(source.port)->hz != 0;
    return source.port.rfind("FCLK_CLK", 0) == 0 ||
           (managers_.count(source.part) != 0 && source.port != "locked");
  }

  static bool is_reset(const std::string& pin) {
    return contains(pin, "reset") || contains(pin, "RESET") || contains(pin, "rst") ||
           pin == "dcm_locked";
  }

  /// By the names of both ends, or of what a concat joins.
  bool is_interrupt(const std::string& pin, const End& source, unsigned depth = 0) const {
    for (const char* name : {"IRQ", "irq", "intr", "irpt", "interrupt"})
      if (contains(source.port, name) || contains(pin, name)) return true;
    const PlacedPart* from = design_.part(source.part);
    if (!from || !contains(from->vlnv, "concat:") || depth == deepest) return false;
    return std::any_of(from->pins.begin(), from->pins.end(), [&](const auto& input) {
      return is_interrupt(input.first, input.second, depth + 1);
    });
  }

  static bool is_ps(const PlacedPart& part) {
    return vp::split(part.vlnv, ':')[2] == "processing_system7";
  }

  /// The node of the PS for what it takes; no name of a part has a space.
  static std::string inputs_of(const std::string& ps) { return ps + " inputs"; }

  std::string colour_of(const PlacedPart& part) {
    for (const auto& [pin, source] : part.pins) {
      if (!is_clock(source)) continue;
      const auto [place, is_new] = colours_.try_emplace(source.text(), colours_.size());
      return palette[place->second % palette.size()];
    }
    return "white";
  }

  bool is_memory_mapped(const PlacedPart& part, const std::string& bus) const {
    const IpRule* rule = rule_for(part.vlnv);
    return mapped_.count(part.name + "." + bus) != 0 || (rule && rule->kind == Kind::bus);
  }

  void join(const End& source, const PlacedPart& part, const std::string& port, Line kind) {
    const std::string from = source.part == "external" ? source.text() : source.part;
    const std::string to = is_ps(part) ? inputs_of(part.name) : part.name;
    lines_[{from, to, kind}].push_back(source.text() + " to " + part.name + "." + port);
    joined_.insert(from);
    joined_.insert(to);
    if (is_ps(part)) taken_[part.name].push_back(port);
  }

  void collect(const PlacedPart& part) {
    for (const auto& [bus, master] : part.buses)
      join(master, part, bus, is_memory_mapped(part, bus) ? Line::bus : Line::stream);
    for (const auto& [pin, source] : part.pins) {
      if (is_clock(source) || is_reset(source.port) || is_reset(pin)) continue;
      join(source, part, pin, is_interrupt(pin, source) ? Line::interrupt : Line::wire);
    }
  }

  // What each master sees of the PS is no address of the PS.
  void node(const PlacedPart& part, const std::string& margin) {
    const std::vector<std::string> vlnv = vp::split(part.vlnv, ':');
    std::string label = part.name + "\\n" + vlnv[2] + " " + vlnv[3];
    const auto place = places_.find(part.name);
    if (place != places_.end() && !is_ps(part)) label += "\\n" + place->second;
    std::string look = "fillcolor=" + quoted(colour_of(part));
    if (stubs_.count(part.name) != 0) look += ", style=\"filled,dashed\"";
    if (!part.rtl.empty()) look += ", peripheries=2";
    text_ += margin + quoted(part.name) + " [label=\"" + label +
             "\", tooltip=" + quoted(part.vlnv) + ", " + look + "];\n";
    const auto taken = taken_.find(part.name);
    if (taken != taken_.end())
      text_ += margin + quoted(inputs_of(part.name)) + " [label=\"" + part.name + "\\n" +
               vp::join(taken->second, "\\n") + "\", tooltip=" + quoted(part.vlnv) + ", " + look +
               "];\n";
  }

  /// One for all that leads from a part to another and is of one kind.
  void line(const Ends& ends, const std::vector<std::string>& what) {
    const auto& [from, to, kind] = ends;
    const bool several_buses = what.size() > 1 && (kind == Line::bus || kind == Line::stream);
    text_ += "  " + quoted(from) + " -> " + quoted(to) + " [" + look_of(kind) +
             (several_buses ? ", label=\"" + std::to_string(what.size()) + "\"" : "") +
             ", tooltip=\"" + vp::join(what, "\\n") + "\"];\n";
  }

  /// In rows, beside the lines.
  void group(const std::vector<const PlacedPart*>& loose) {
    if (loose.empty()) return;
    text_ +=
        "  subgraph cluster_loose {\n    label=\"clocks, resets and others without a line\"; "
        "style=dotted; fontname=\"DejaVu Sans\"; fontsize=10;\n";
    for (std::size_t i = 0; i < loose.size(); ++i) {
      node(*loose[i], "    ");
      if (i % parts_in_a_row != 0)
        text_ += "    " + quoted(loose[i - 1]->name) + " -> " + quoted(loose[i]->name) +
                 " [style=invis, weight=9];\n";
    }
    text_ += "  }\n";
  }

  void legend() {
    if (colours_.empty()) return;
    std::vector<const std::pair<const std::string, std::size_t>*> clocks(colours_.size());
    for (const auto& clock : colours_) clocks[clock.second] = &clock;
    text_ +=
        "  \"clocks of parts\" [shape=plain, style=\"\", label=<<table border=\"0\" "
        "cellborder=\"1\" cellspacing=\"0\" cellpadding=\"4\"><tr><td "
        "border=\"0\">clocks</td></tr>";
    for (const auto* clock : clocks)
      text_ += "<tr><td bgcolor=\"" + std::string(palette[clock->second % palette.size()]) + "\">" +
               escaped(clock->first) + "</td></tr>";
    text_ += "</table>>];\n";
  }

  const DesignFile& design_;
  std::string text_;
  std::set<std::string> stubs_, managers_, mapped_;
  std::map<std::string, std::string> places_;              ///< of a slave: its addresses
  std::map<std::string, std::vector<std::string>> taken_;  ///< of the PS: the ports that it takes
  std::map<Ends, std::vector<std::string>> lines_;         ///< "part.port to part.port"
  std::set<std::string> joined_;                           ///< nodes with a line
  std::map<std::string, std::size_t> colours_ = {};        ///< of clocks, by number
};

}  // namespace

std::string diagram(const DesignFile& design) {
  return Drawing(design).draw();
}

void write_diagram(const DesignFile& design, const std::string& file) {
  const std::string ending = std::filesystem::path(file).extension().string();
  if (ending == ".dot") return vp::write_file(file, diagram(design));
  if (ending != ".svg" && ending != ".png")
    throw vp::InputError("--diagram '" + file +
                         "': the file's name must end in .svg, .png or .dot");
  const vp::PartFile graph(file + ".dot");
  vp::write_file(graph.path(), diagram(design));
  const host::CommandEnd end =
      host::run_command({"dot", "-T" + ending.substr(1), "-o", file, graph.path()});
  if (end.exit_code == host::no_such_command)
    throw vp::InputError("--diagram needs Graphviz: apt-get install graphviz, or name a file .dot");
  if (end.exit_code != 0)
    throw vp::InputError("Graphviz cannot draw '" + file + "': " + vp::excerpt(end.out));
}

}  // namespace platform::block_design
