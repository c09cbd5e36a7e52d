#include <chip/block_design/diagram.h>

#include <chip/block_design/shelf.h>
#include <host/process.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>
#include <vp/unit.h>

#include <array>
#include <filesystem>
#include <map>
#include <set>

namespace platform::block_design {

namespace {

/// Fill colours of clocks, light enough for black text; later clocks begin again.
constexpr std::array palette{"#cfe8ff", "#ffe3c2", "#d9f2d0", "#f4d3ee", "#fff3b0", "#e0dcff"};

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + "\"";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Draws node by node, then edge by edge.
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
  }

  std::string draw() {
    text_ = "digraph " + quoted(design_.name) +
            " {\n  rankdir=LR;\n  node [shape=box, style=filled, fontname=\"DejaVu Sans\", "
            "fontsize=10, fillcolor=white];\n  edge [fontname=\"DejaVu Sans\", fontsize=8];\n";
    for (const PlacedPart& part : design_.parts) node(part);
    for (const ExternalPin& pin : design_.external)
      text_ +=
          "  " + quoted("external." + pin.name) + " [shape=cds, label=" + quoted(pin.name) + "];\n";
    for (const PlacedPart& part : design_.parts) edges(part);
    legend();
    return text_ + "}\n";
  }

 private:
  bool is_clock(const End& source) const {
    if (source.part == "external") return design_.pin(source.port)->hz != 0;
    return source.port.rfind("FCLK_CLK", 0) == 0 ||
           (managers_.count(source.part) != 0 && source.port != "locked");
  }

  static bool is_reset(const std::string& pin) {
    return contains(pin, "reset") || contains(pin, "RESET") || contains(pin, "rst");
  }

  std::string colour_of(const PlacedPart& part) {
    for (const auto& [pin, source] : part.pins) {
      if (!is_clock(source)) continue;
      const auto [place, is_new] = colours_.try_emplace(source.text(), colours_.size());
      return palette[place->second % palette.size()];
    }
    return "white";
  }

  // What each master sees of the PS is no address of the PS.
  void node(const PlacedPart& part) {
    const std::vector<std::string> vlnv = vp::split(part.vlnv, ':');
    const bool is_ps = vlnv[2] == "processing_system7";
    std::string label = part.name + "\\n" + vlnv[2] + " " + vlnv[3];
    const auto place = places_.find(part.name);
    if (place != places_.end() && !is_ps) label += "\\n" + place->second;
    std::string look = "fillcolor=" + quoted(colour_of(part));
    if (stubs_.count(part.name) != 0) look += ", style=\"filled,dashed\"";
    if (!part.rtl.empty()) look += ", peripheries=2";
    text_ += "  " + quoted(part.name) + " [label=\"" + label + "\", " + look + "];\n";
  }

  void edge(const std::string& from, const std::string& to, const std::string& look) {
    text_ += "  " + quoted(from) + " -> " + quoted(to) + " [" + look + "];\n";
  }

  bool is_memory_mapped(const PlacedPart& part, const std::string& bus) const {
    const IpRule* rule = rule_for(part.vlnv);
    return mapped_.count(part.name + "." + bus) != 0 || (rule && rule->kind == Kind::bus);
  }

  void edges(const PlacedPart& part) {
    for (const auto& [bus, master] : part.buses) {
      edge(master.part, part.name,
           is_memory_mapped(part, bus) ? "penwidth=2" : "penwidth=3, color=\"#2a6fbb\"");
    }
    std::set<std::string> drawn;  // one edge for all wires from a part
    for (const auto& [pin, source] : part.pins) {
      if (is_clock(source) || is_reset(source.port) || is_reset(pin)) continue;
      const std::string from = source.part == "external" ? source.text() : source.part;
      if (!drawn.insert(from).second) continue;
      const bool interrupts = contains(pin, "IRQ") || contains(source.port, "intr") ||
                              contains(source.port, "irq") || contains(source.port, "irpt") ||
                              contains(source.port, "interrupt");
      edge(from, part.name,
           interrupts ? "color=\"#c0392b\", constraint=false" : "color=gray40, constraint=false");
    }
  }

  void legend() {
    if (colours_.empty()) return;
    text_ +=
        "  subgraph cluster_clocks {\n    label=\"clocks\"; fontname=\"DejaVu Sans\"; "
        "fontsize=10;\n";
    for (const auto& [clock, number] : colours_) {
      text_ += "    " + quoted("clock " + clock) + " [label=" + quoted(clock) +
               ", fillcolor=" + quoted(palette[number % palette.size()]) + "];\n";
    }
    text_ += "  }\n";
  }

  const DesignFile& design_;
  std::string text_;
  std::set<std::string> stubs_, managers_, mapped_;
  std::map<std::string, std::string> places_;        ///< of a slave: its addresses
  std::map<std::string, std::size_t> colours_ = {};  ///< of clocks, by number
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
