#include <chip/block_design/import_design.h>
#include <chip/block_design/import_fit.h>
#include <chip/block_design/import_levels.h>

#include <slcr_registers.h>

#include <chip/handoff/netlist.h>
#include <fpga/device/clock_plan.h>
#include <fpga/device/device.h>
#include <vp/error.h>
#include <vp/text.h>
#include <vp/unit.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>

namespace platform::block_design {

namespace {

using handoff::BusInterface;
using handoff::Handoff;
using handoff::Module;
using handoff::Netlist;
using handoff::parameter;
using handoff::Port;

constexpr double hz_per_mhz = 1e6;
/// Vivado writes 666.666687 MHz for 666.666667: it computes with single precision.
constexpr double cpu_rounding_hz = 100;
/// `ps.ddr.dma_base` where nothing is said.
constexpr std::uint64_t usual_dma_base = 0x1000'0000;

/// A word as YAML has it: in quotes where it could be read as something else.
std::string yaml(const std::string& word) {
  const auto plain = [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '.' || c == '/' || c == '-';
  };
  const auto of_vlnv = [&](unsigned char c) { return plain(c) || c == ':'; };
  const bool good = !word.empty() && std::isalnum(static_cast<unsigned char>(word.front())) &&
                    std::isalnum(static_cast<unsigned char>(word.back())) &&
                    std::all_of(word.begin(), word.end(), of_vlnv);
  if (good) return word;
  std::string quoted = "\"";
  for (const char c : word) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

std::string hertz(double hz) {
  return vp::format_quantity(vp::Decimal(static_cast<vp::Decimal::Whole>(std::llround(hz)), 0),
                             vp::Unit::frequency);
}

bool is_memory_mapped(const BusInterface& bus) {
  return bus.kind == "aximm" || bus.kind == "lmb";
}

bool is_bus(const BusInterface& bus) {
  return is_memory_mapped(bus) || bus.kind == "axis" || bus.kind == "apb";
}

/// Parameters that say nothing of what an IP of the owner's does.
bool is_noise(const std::string& name) {
  static const std::set<std::string> names{"Component_Name", "EDK_IPTYPE", "C_BASEADDR",
                                           "C_HIGHADDR"};
  const auto ends_with = [&](const std::string& end) {
    return name.size() > end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0;
  };
  return names.count(name) != 0 || ends_with("_BASEADDR") || ends_with("_HIGHADDR");
}

/// Writes the sections of design.yaml one after the other.
class Writer {
 public:
  Writer(const Handoff& handoff, const handoff::RtlFinder& rtl)
      : handoff_(handoff), rtl_(rtl), nets_(handoff), wishes_(clock_wishes(handoff)) {}

  ImportedDesign write() {
    line("# Design '" + handoff_.name + "' of " + handoff_.file + ", Vivado " + handoff_.tool +
         ", for an " + handoff_.part + ".");
    line(
        "# Yours to edit: another 'markervp import' brings in what changed in Vivado, and keeps "
        "your");
    line("# changes.");
    line("name: " + identifier(handoff_.name));
    line("programs: [" + yaml("build/" + handoff_.name) + "]  # what CMakeLists.txt builds");
    write_settings();
    line("\nparts:");
    for (const Module& module : handoff_.modules) write_part(module);
    write_addresses();
    write_external();
    return std::move(result_);
  }

 private:
  void line(const std::string& text) { result_.text += text + "\n"; }

  static std::string identifier(std::string text) {
    for (char& c : text) {
      if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    }
    return text;
  }

  std::string ps(const std::string& name) const {
    return parameter(handoff_.ps().parameters, name);
  }

  bool ps_is(const std::string& name) const { return ps(name) == "1"; }

  void setting(const std::string& path, const std::string& value) {
    line("  " + path + ": " + value);
  }

  // Of equal wishes the platform's plan of the PLLs is that of the vendor's tool.
  void write_settings() {
    line("\n# Parameters of the platform; 'markervp config --design design.yaml' explains each.");
    line("settings:");
    setting("device", handoff_.device);
    const auto crystal = vp::Decimal::parse(ps("PCW_CRYSTAL_PERIPHERAL_FREQMHZ"));
    if (crystal) setting("ps.slcr.ps_clk", crystal->text() + " MHz");
    device::ClockWishes wishes;
    wishes.ethernet = ps_is("PCW_ENET0_PERIPHERAL_ENABLE");
    const auto cpu = vp::Decimal::parse(ps("PCW_ACT_APU_PERIPHERAL_FREQMHZ"));
    if (cpu) wishes.cpu_hz = cpu->to_double() * hz_per_mhz;
    if (cpu) setting("ps.cpu_clk.frequency", hertz(wishes.cpu_hz));
    wishes.fclk_hz = write_fclks();
    if (!is_planned(wishes,
                    crystal ? crystal->to_double() * hz_per_mhz : device::zedboard_crystal_hz))
      setting("clocks", "exact  # no PLL of the platform's plan gives them all");
    const auto last = vp::Decimal::parse(ps("PCW_DDR_RAM_HIGHADDR"));
    const auto whole = last ? last->whole() : std::nullopt;
    constexpr vp::Decimal::Whole mib = 1 << 20;
    if (whole && *whole >= 2 * mib) {
      setting("ps.ddr.size",
              vp::format_quantity(vp::Decimal(*whole + 1 - mib, 0), vp::Unit::bytes));
      // The upper half is for buffers of Linux; the platform's default is that of 512 MiB.
      if (*whole < usual_dma_base)
        setting("ps.ddr.dma_base", vp::hex(static_cast<std::uint64_t>(*whole + 1) / 2));
    }
    if (ps("PCW_UIPARAM_DDR_BUS_WIDTH").rfind("16", 0) == 0) setting("power.ddr.width", "16");
    setting("ps.ethernet", wishes.ethernet ? "true" : "false");
    write_uarts();
    write_pull_ups();
  }

  /// The clocks of the PL that are on. FCLK_CLK1 exists in any case: unused, it asks for nothing
  /// that the first one does not.
  std::vector<double> write_fclks() {
    std::map<unsigned, double> on;
    for (const Port& port : handoff_.ps().ports) {
      const bool is_clock = port.direction == 'O' && port.name.rfind("FCLK_CLK", 0) == 0 &&
                            port.name.size() == 9 && port.name[8] >= '0' && port.name[8] <= '3';
      if (is_clock && port.hz) on[static_cast<unsigned>(port.name[8] - '0')] = *port.hz;
    }
    if (on.count(0) == 1 && on.count(1) == 0) on[1] = on[0];
    std::vector<double> wishes;
    for (const auto& [number, hz] : on) {
      setting("ps.fclk_clk" + std::to_string(number) + ".frequency", hertz(hz));
      wishes.push_back(hz);
    }
    return wishes;
  }

  /// Whether the clocks come out within a hertz.
  bool is_planned(const device::ClockWishes& wishes, double crystal_hz) const {
    const device::ClockPlan plan =
        device::ClockPlanner(device::find_device(handoff_.device), crystal_hz).plan(wishes);
    for (std::size_t i = 0; i < wishes.fclk_hz.size(); ++i) {
      if (std::abs(plan.fclk[i].hz - wishes.fclk_hz[i]) > 1) return false;
    }
    return std::abs(plan.cpu.hz - wishes.cpu_hz) < cpu_rounding_hz;
  }

  // Without any, Linux was booted by other code, and the wizard's defaults are in the file.
  void write_uarts() {
    const bool first = ps_is("PCW_UART0_PERIPHERAL_ENABLE");
    const bool second = ps_is("PCW_UART1_PERIPHERAL_ENABLE");
    if (!first && !second) {
      result_.notes.push_back(
          "the PS has no UART: a PYNQ overlay often has the wizard's defaults there, and the board "
          "was set up by another boot loader; set ps.uart0.enabled, ps.slcr.ps_clk and "
          "ps.cpu_clk.frequency as on your board");
    }
    setting("ps.uart0.enabled", first ? "true" : "false");
    setting("ps.uart1.enabled", second ? "true" : "false");
  }

  /// Boot code sets up the MIO pins that are in use; of the others nothing is said.
  void write_pull_ups() {
    std::uint64_t on = slcr::mio_pin::pull_ups_at_reset;
    for (unsigned pin = 0; pin < slcr::mio_pins; ++pin) {
      const std::string said = ps("PCW_MIO_" + std::to_string(pin) + "_PULLUP");
      const std::uint64_t bit = std::uint64_t{1} << pin;
      if (said == "enabled") on |= bit;
      if (said == "disabled") on &= ~bit;
    }
    if (on != slcr::mio_pin::pull_ups_at_reset) setting("ps.slcr.mio_pull_ups", vp::hex(on));
  }

  void write_part(const Module& module) {
    const IpRule* rule = rule_for(module.vlnv);
    ImportedPart part{module.full_name.substr(1), module.vlnv, Kind::stub, "", module.instance};
    // The RTL of an application's own IP goes before its model.
    const bool is_own = !rule || !rule->maker.empty();
    if (is_own) look_for_rtl(module, part);
    if (part.kind == Kind::rtl) rule = nullptr;
    if (rule) {
      part.why = misfit(*rule, module, nets_, rtl_);
      part.kind = part.why.empty() ? rule->kind : Kind::stub;
    }
    line("  " + module.instance + ":");
    line("    ip: " + yaml(module.vlnv));
    if (rule && part.kind == Kind::stub) line("    as: stub  # " + part.why);
    if (part.kind == Kind::rtl) line("    rtl: build/" + part.target + ".so");
    write_parameters(with_file(module, part.kind), part.kind == Kind::stub ? nullptr : rule);
    if (part.kind == Kind::stub || part.kind == Kind::rtl) write_clocks(module);
    if (part.kind == Kind::model) note_files(module);
    write_pins(module, part.kind == Kind::stub);
    write_buses(module);
    result_.parts.push_back(std::move(part));
  }

  void look_for_rtl(const Module& module, ImportedPart& part) {
    if (rtl_.empty()) {
      part.why =
          module.is_vendors() ? "the platform has no model of it" : "no RTL was named for it";
      return;
    }
    part.rtl = rtl_.find(module);
    part.why = part.rtl.why;
    if (part.rtl.files.empty()) return;
    for (const BusInterface& bus : module.interfaces) {
      if (bus.kind != "apb" || bus.bus.empty()) continue;
      part.why = "its bus " + bus.name + " is APB, which RTL cannot have here";
      part.rtl.files.clear();
      return;
    }
    part.kind = Kind::rtl;
    for (const Port& port : module.ports) note_reset(module, port, part.rtl);
  }

  /// RTL that does not say at which level a pin resets is built for what drives the pin.
  void note_reset(const Module& module, const Port& port, handoff::RtlSources& rtl) {
    if (!leaves_level_open(port, rtl.files)) return;
    const auto source = nets_.driver(port);
    const std::optional<bool> low = source ? resets_low(nets_, *source) : std::nullopt;
    rtl.interfaces.push_back(port.name + (!low ? ": wire" : *low ? ": reset low" : ": reset high"));
    if (low) return;
    result_.notes.push_back("`" + module.instance + "." + port.name +
                            "` does not say at which level it resets, and neither does what drives "
                            "it: CMakeLists.txt takes it for a wire, which changes nothing but "
                            "checks; \"" +
                            port.name + ": reset high\" there names the level");
  }

  /// A memory that is loaded from a file, with the file that was found.
  Module with_file(const Module& module, Kind kind) const {
    Module found = module;
    if (kind == Kind::model && loads_memory(module))
      found.parameters["Coe_File"] = rtl_.data_file(parameter(module.parameters, "Coe_File"));
    return found;
  }

  /// Of the shelf's IP those that matter and are not as usual; of the owner's all.
  void write_parameters(const Module& module, const IpRule* rule) {
    std::vector<std::pair<std::string, std::string>> list;
    if (rule) {
      for (const ParameterRule& known : rule->parameters) {
        const std::string value = parameter(module.parameters, known.name);
        if (!value.empty() && unquoted(value) != known.usual) list.emplace_back(known.name, value);
      }
    } else if (!module.is_vendors()) {
      for (const auto& [name, value] : module.parameters)
        if (!is_noise(name)) list.emplace_back(name, value);
    }
    if (list.empty()) return;
    line("    parameters:");
    for (const auto& [name, value] : list) line("      " + yaml(name) + ": " + yaml(value));
  }

  /// Models that take files, or write them.
  void note_files(const Module& module) {
    const std::string setting = "`pl." + module.instance + ".frames_";
    if (module.ip() == "v_vid_in_axi4s")
      result_.notes.push_back(setting + "from` puts pictures of files at the video input of " +
                              module.instance + ", in the place of what is wired there");
    if (module.ip() == "v_axi4s_vid_out")
      result_.notes.push_back(setting + "to` names a folder for the frames that " +
                              module.instance + " sends");
  }

  /// Clocks that a stub would make, or RTL makes, and something uses.
  void write_clocks(const Module& module) {
    std::string lines;
    for (const Port& port : module.ports) {
      if (port.direction != 'O' || port.signal.empty()) continue;
      const std::optional<double> hz = port.kind == "clk" && port.hz ? port.hz : wished_hz(port);
      if (hz) lines += "      " + yaml(port.name) + ": " + hertz(*hz) + "\n";
    }
    if (!lines.empty()) result_.text += "    clocks:\n" + lines;
  }

  std::optional<double> wished_hz(const Port& driver) const {
    const auto wish = wishes_.find(driver.signal);
    return wish == wishes_.end() ? std::nullopt : std::optional<double>(wish->second);
  }

  /// Inputs that are driven, but those of buses.
  void write_pins(const Module& module, bool is_stub) {
    std::set<std::string> of_buses;
    for (const BusInterface& bus : module.interfaces) {
      const bool is_memory = bus.kind == "bram" && module.ip() == "axi_bram_ctrl";
      if (!is_bus(bus) && bus.kind != "ddrx" && !is_memory) continue;
      for (const auto& [logical, physical] : bus.pins) of_buses.insert(physical);
    }
    const IpRule* rule = rule_for(module.vlnv);
    const bool is_interconnect = rule && rule->kind == Kind::bus;
    std::string main_clock;
    bool first = true;
    for (const Port& port : module.ports) {
      if (port.direction != 'I' || of_buses.count(port.name) != 0) continue;
      const auto source = nets_.driver(port);
      if (!source) continue;
      const std::string text = pin_text(*source);
      if (!is_stub) note_missing(module, *source);
      if (is_interconnect) {
        if (port.kind != "clk") continue;
        if (main_clock.empty()) {
          main_clock = text;
        } else if (text == main_clock) {
          continue;
        }
      }
      if (first) line("    pins:");
      first = false;
      line("      " + yaml(port.name) + ": " + yaml(text));
    }
  }

  void note_missing(const Module& module, const handoff::Pin& source) {
    const IpRule* rule = source.module ? rule_for(source.module->vlnv) : nullptr;
    if (!rule || !lacks_output(*rule, source.port->name)) return;
    if (rule->ip == "axi_bram_ctrl" && module.ip() == "blk_mem_gen") return;  // they are one
    if (!misfit(*rule, *source.module, nets_, rtl_).empty()) return;          // a stub has any
    const std::string text = pin_text(source);
    if (!missing_.insert(text).second) return;
    result_.notes.push_back("`" + text + "` is not modelled: it stays " +
                            (idles_high(source.port->name) ? "1" : "0") +
                            ", and verdicts that rest on it are unknown");
  }

  std::string pin_text(const handoff::Pin& pin) {
    if (pin.module) return pin.module->instance + "." + pin.port->name;
    used_pins_.insert(pin.port->name);
    return "external." + pin.port->name;
  }

  void write_buses(const Module& module) {
    bool first = true;
    for (const BusInterface& bus : module.interfaces) {
      if (!is_bus(bus) || bus.sends || bus.listens) continue;
      const auto sender = nets_.sender(bus);
      if (!sender) continue;
      if (first) line("    buses:");
      first = false;
      line("      " + yaml(bus.name) + ": " +
           yaml(sender->module->instance + "." + sender->interface->name));
    }
  }

  void write_addresses() {
    using Ranges = std::vector<std::string>;
    std::map<std::string, std::vector<std::pair<std::string, Ranges>>> masters;
    for (const Module& module : handoff_.modules) {
      for (const handoff::Segment& segment : module.segments) {
        const std::string master = master_of(module, segment);
        if (leads_nowhere(module, master, segment)) continue;
        auto& slaves = masters[module.instance + "." + master];
        const std::string slave = segment.instance + "." + segment.slave;
        auto entry = std::find_if(slaves.begin(), slaves.end(),
                                  [&](const auto& known) { return known.first == slave; });
        if (entry == slaves.end()) entry = slaves.insert(entry, {slave, Ranges()});
        const std::string size = vp::format_quantity(
            vp::Decimal(static_cast<vp::Decimal::Whole>(segment.last - segment.base + 1), 0),
            vp::Unit::bytes);
        entry->second.push_back("[" + vp::hex(segment.base) + ", " + size + "]");
      }
    }
    if (masters.empty()) return;
    line("\n# What each master sees, and where: [base, size].");
    line("addresses:");
    for (const auto& [master, slaves] : masters) {
      line("  " + yaml(master) + ":");
      for (const auto& [slave, ranges] : slaves) {
        const bool one = ranges.size() == 1;
        line("    " + yaml(slave) + ": " +
             (one ? ranges.front() : "[" + vp::join(ranges, ", ") + "]"));
      }
    }
  }

  /// Where both general-purpose ports lead to one interconnect, Vivado names one of them for all
  /// slaves. Of the PS the address decides (UG585).
  std::string master_of(const Module& module, const handoff::Segment& segment) {
    constexpr std::uint64_t gp0 = 0x4000'0000, gp1 = 0x8000'0000, end = 0xC000'0000;
    if (&module != &handoff_.ps() || segment.base < gp0 || segment.base >= end)
      return segment.master;
    std::string port = segment.base < gp1 ? "M_AXI_GP0" : "M_AXI_GP1";
    const BusInterface* bus = module.interface(port);
    if (port == segment.master || !bus || bus->bus.empty()) return segment.master;
    result_.notes.push_back("the hand-off has " + segment.instance + " at " +
                            vp::hex(segment.base) + " for " + segment.master +
                            ", and the processor gets there by " + port + ": so it is here");
    return port;
  }

  /// Vivado keeps segments of a master whose bus was taken away.
  bool leads_nowhere(const Module& module, const std::string& master,
                     const handoff::Segment& segment) {
    const BusInterface* bus = module.interface(master);
    if (!bus || !bus->bus.empty()) return false;
    result_.notes.push_back("the hand-off has " + segment.instance + " at " +
                            vp::hex(segment.base) + " for " + module.instance + "." + master +
                            ", which is joined to nothing: an access there is answered with an "
                            "error, as on the chip");
    return true;
  }

  // What nothing inside reads needs no level.
  void write_external() {
    std::vector<std::string> lines;
    for (const Port& port : handoff_.ports) {
      if (port.direction != 'I' || used_pins_.count(port.name) == 0) continue;
      const std::optional<double> wished = wished_hz(port);
      if (port.kind == "clk" || wished) {
        const double hz = port.hz ? *port.hz : wished.value_or(1e8);
        lines.push_back("  " + yaml(port.name) + ": {clock: " + hertz(hz) + "}");
        result_.notes.push_back("the clock at pin " + port.name + " is " + hertz(hz) +
                                " as typed in Vivado, where 100 MHz is the default: correct it "
                                "under 'external' if the board has another");
      } else {
        const std::string width =
            port.width > 1 ? "width: " + std::to_string(port.width) + ", " : "";
        const bool high = idles_high(handoff_, port);
        lines.push_back("  " + yaml(port.name) + ": {" + width + "level: " + (high ? "1}" : "0}"));
        if (high)
          result_.notes.push_back("pin " + port.name +
                                  " resets at 0, and is at 1: nothing is in reset");
      }
    }
    if (lines.empty()) return;
    line("\n# Pins of the chip that drive the design, and what is at them.");
    line("external:");
    for (const std::string& text : lines) line(text);
  }

  const Handoff& handoff_;
  const handoff::RtlFinder& rtl_;
  Netlist nets_;
  std::map<std::string, double> wishes_;
  ImportedDesign result_;
  std::set<std::string> used_pins_;
  std::set<std::string> missing_;  ///< outputs that no model has
};

}  // namespace

ImportedDesign import_design(const Handoff& handoff, const handoff::RtlFinder& rtl) {
  return Writer(handoff, rtl).write();
}

}  // namespace platform::block_design
