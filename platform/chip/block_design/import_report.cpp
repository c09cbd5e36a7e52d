#include <chip/block_design/import_design.h>

#include <chip/handoff/netlist.h>
#include <gic_registers.h>
#include <vp/text.h>
#include <vp/unit.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace platform::block_design {

namespace {

using handoff::Handoff;
using handoff::Module;
using handoff::Netlist;

std::string quantity(std::uint64_t value, vp::Unit unit) {
  return vp::format_quantity(vp::Decimal(static_cast<vp::Decimal::Whole>(value), 0), unit);
}

std::string parts_table(const ImportedDesign& design) {
  std::string text = "\n## Parts\n\n| Part | IP | Here | |\n|---|---|---|---|\n";
  for (const ImportedPart& part : design.parts) {
    const IpRule* rule = rule_for(part.vlnv);
    const std::string remark = part.kind == Kind::stub ? part.why : rule ? rule->what : "";
    text += "| `" + part.name + "` | " + part.vlnv + " | " + to_string(part.kind) + " | " + remark +
            " |\n";
  }
  return text;
}

std::string missing(const ImportedDesign& design) {
  const auto stubs = std::count_if(design.parts.begin(), design.parts.end(),
                                   [](const ImportedPart& p) { return p.kind == Kind::stub; });
  if (stubs == 0) return "\nEvery part has its model: verdicts rest on all of the design.\n";
  return "\n" + std::to_string(stubs) + (stubs == 1 ? " part is a stub" : " parts are stubs") +
         ". A stub answers each read of its registers with 0 and warns, swallows what streams "
         "bring, "
         "and drives 0.\nWhat it takes of the chip and how fast it is are unknown, so the "
         "verdict's "
         "parts \"fits\" and \"timing\" are unknown, too.\n";
}

std::string addresses_table(const Handoff& handoff) {
  std::string rows;
  for (const Module& module : handoff.modules) {
    for (const handoff::Segment& segment : module.segments) {
      rows += "| `" + module.instance + "." + segment.master + "` | `" + segment.instance + "." +
              segment.slave + "` | " + vp::hex(segment.base) + " | " +
              quantity(segment.last - segment.base + 1, vp::Unit::bytes) + " |\n";
    }
  }
  if (rows.empty()) return "\n## Addresses\n\nNo master sees a slave.\n";
  return "\n## Addresses\n\n| Master | Slave | Base | Size |\n|---|---|---|---|\n" + rows;
}

/// A line that waits for an interrupt and has none: open, or a constant.
std::string open_row(const std::string& number) {
  return "| " + number + " | nothing: open or a constant, so it never comes |\n";
}

/// Outputs for interrupts that nothing reads.
std::string unread_interrupts(const Handoff& handoff) {
  std::set<std::string> read;
  for (const Module& module : handoff.modules)
    for (const handoff::Port& port : module.ports)
      if (port.direction != 'O') read.insert(port.signal);
  for (const handoff::Port& port : handoff.ports)
    if (port.direction != 'I') read.insert(port.signal);
  std::string names;
  for (const Module& module : handoff.modules) {
    for (const handoff::Port& port : module.ports) {
      if (&module == &handoff.ps() || port.direction != 'O' || port.kind != "INTERRUPT") continue;
      if (port.signal.empty() || read.count(port.signal) == 0)
        names += (names.empty() ? "`" : ", `") + module.instance + "." + port.name + "`";
    }
  }
  return names.empty() ? "" : "\nThese reach nothing, so programs poll them: " + names + ".\n";
}

std::string interrupts_table(const Handoff& handoff, const Netlist& nets) {
  std::string rows;
  std::vector<Netlist::Interrupt> interrupts = nets.interrupts();
  const auto behind = nets.interrupts_of_controllers();
  interrupts.insert(interrupts.end(), behind.begin(), behind.end());
  for (const Netlist::Interrupt& interrupt : interrupts) {
    const handoff::PinBit& source = interrupt.source;
    rows += "| " + std::to_string(interrupt.id) +
            (interrupt.controller ? " of `" + interrupt.controller->instance + "`" : "") + " | `" +
            (source.pin.module ? source.pin.module->instance : "external") + "." +
            source.pin.port->name +
            (source.pin.port->width > 1 ? "[" + std::to_string(source.bit) + "]" : "") + "` |\n";
  }
  const handoff::Port* const lines = handoff.ps().port("IRQ_F2P");
  const std::string unread = unread_interrupts(handoff);
  if (rows.empty()) {
    return std::string("\n## Interrupts\n\n") +
           (lines ? "IRQ_F2P is there, and nothing drives it: programs poll.\n"
                  : "None: programs poll.\n") +
           unread;
  }
  const auto has_source = [&interrupts](std::uint32_t id, const Module* controller) {
    return std::any_of(interrupts.begin(), interrupts.end(), [&](const auto& interrupt) {
      return interrupt.id == id && interrupt.controller == controller;
    });
  };
  for (unsigned bit = 0; lines && bit < lines->width && bit < gic::irq_f2p_bits; ++bit) {
    if (!has_source(gic::irq_f2p_id(bit), nullptr))
      rows += open_row(std::to_string(gic::irq_f2p_id(bit)));
  }
  for (const Module& module : handoff.modules) {
    const bool is_controller = module.is_vendors() && module.ip() == "axi_intc";
    const handoff::Port* const inputs = is_controller ? module.port("intr") : nullptr;
    for (unsigned bit = 0; inputs && bit < inputs->width; ++bit) {
      if (!has_source(bit, &module))
        rows += open_row(std::to_string(bit) + " of `" + module.instance + "`");
    }
  }
  return "\n## Interrupts\n\n| Number | Source |\n|---|---|\n" + rows + unread;
}

std::string clocks_table(const Handoff& handoff) {
  std::string rows;
  const auto add = [&](const std::string& where, const handoff::Port& port, bool drives) {
    if (port.kind != "clk" || !port.hz || !drives) return;
    rows += "| `" + where + "." + port.name + "` | " +
            quantity(static_cast<std::uint64_t>(std::llround(*port.hz)), vp::Unit::frequency) +
            " |\n";
  };
  for (const Module& module : handoff.modules)
    for (const handoff::Port& port : module.ports)
      add(module.instance, port, port.direction == 'O' && !port.signal.empty());
  for (const handoff::Port& port : handoff.ports) add("external", port, port.direction == 'I');
  if (rows.empty()) return "";
  return "\n## Clocks\n\n| Source | Frequency |\n|---|---|\n" + rows;
}

}  // namespace

std::string import_report(const Handoff& handoff, const ImportedDesign& design,
                          const std::string& problem) {
  const Netlist nets(handoff);
  std::string text =
      "# Import of " + handoff.name + "\n\nFrom " + handoff.file + ", written by Vivado " +
      handoff.tool + (handoff.date.empty() ? "" : " on " + handoff.date) + ", for an " +
      handoff.part + (handoff.board.empty() ? "" : " (board " + handoff.board + ")") + ".\n";
  if (!problem.empty()) text += "\n**The design cannot be built as it is:** " + problem + "\n";
  text += missing(design);
  if (!design.notes.empty()) text += "\n## To look at\n\n";
  for (const std::string& note : design.notes) text += "* " + note + "\n";
  text += parts_table(design) + addresses_table(handoff) + interrupts_table(handoff, nets) +
          clocks_table(handoff);
  return text +
         "\n## Next\n\n```\nmarkervp map --design design.yaml\nmarkervp config --design "
         "design.yaml\n"
         "cmake -S . -B build -DCMAKE_PREFIX_PATH=<where markervp is installed>\ncmake --build "
         "build\n"
         "markervp run --design design.yaml\n```\n\n"
         "If the program wants a header of the vendor's that is missing, name its drivers: "
         "`-DVENDOR_BSP=<BSP>` for the first `cmake`, the\n`libsrc` of a board support package or "
         "a checkout of the vendor's `embeddedsw`.\n";
}

namespace {

std::string quoted_lines(const std::vector<std::string>& files) {
  return "\n  \"" + vp::join(files, "\"\n  \"") + "\"";
}

/// The user's RTL in the place of parts, each an object of its own.
std::string rtl_targets(const ImportedDesign& design) {
  std::string text;
  for (const ImportedPart& part : design.parts) {
    if (part.kind != Kind::rtl) continue;
    text +=
        "markervp_add_rtl(" + part.target + " TOP " + part.rtl.top + " SOURCES" +
        quoted_lines(part.rtl.files) +
        (part.rtl.include_dirs.empty() ? ""
                                       : "\n  INCLUDE_DIRS" + quoted_lines(part.rtl.include_dirs)) +
        (part.rtl.parameters.empty() ? ""
                                     : "\n  PARAMETERS " + vp::join(part.rtl.parameters, " ")) +
        (part.rtl.interfaces.empty()
             ? ""
             : "\n  INTERFACES \"" + vp::join(part.rtl.interfaces, "\" \"") + "\"") +
        "\n  FIGURES STUB_IF_REFUSED)\nset_target_properties(" + part.target +
        " PROPERTIES LIBRARY_OUTPUT_DIRECTORY \"${CMAKE_BINARY_DIR}\")\n\n";
  }
  return text;
}

/// The program, with the drivers of the design's own IP.
std::string program_target(const std::string& name, bool is_sdt) {
  return "file(GLOB drivers CONFIGURE_DEPENDS drivers/*/*.c)\n"
         "file(GLOB driver_folders LIST_DIRECTORIES true CONFIGURE_DEPENDS drivers/*)\n"
         "set(VENDOR_BSP \"\" CACHE PATH \"the vendor's drivers, in the place of markervp's: "
         "libsrc of a BSP, or embeddedsw\")\n"
         "if(VENDOR_BSP)\n  set(vendor VENDOR_BSP \"${VENDOR_BSP}\")\nendif()\n"
         "if(sources)\n  markervp_add_program(" +
         name +
         " SOURCES ${sources} DRIVERS ${drivers} LIBRARIES markervp::compat ${vendor})\n"
         "  # xparameters.h of this design, before that of the package.\n"
         "  target_include_directories(" +
         name +
         " BEFORE PRIVATE \"${CMAKE_CURRENT_SOURCE_DIR}\" ${driver_folders})\n"
         "  # Drivers of HLS are for Linux, too, where the compiler says so.\n"
         "  target_compile_options(" +
         name + " PRIVATE -U__linux__)\n" +
         (is_sdt ? "  # It names devices as Vitis does from 2023.2 on.\n"
                   "  target_compile_definitions(" +
                       name + " PRIVATE SDT)\n"
                 : "") +
         "  set_target_properties(" + name +
         " PROPERTIES LIBRARY_OUTPUT_DIRECTORY \"${CMAKE_BINARY_DIR}\")\nendif()\n";
}

}  // namespace

std::string import_cmake(const std::string& name, const ImportedDesign& design,
                         const std::vector<std::string>& sources, bool is_sdt) {
  const std::string rtl = rtl_targets(design);
  std::string text =
      "# What belongs to this design: its PS program, in C or C++, as written for the vendor's "
      "tools" +
      std::string(rtl.empty() ? "" : ",\n# and the RTL of its parts") +
      ".\n#   cmake -S . -B build -DCMAKE_PREFIX_PATH=<where markervp is installed>\n"
      "#   cmake --build build\n"
      "cmake_minimum_required(VERSION 3.25)\n"
      "project(" +
      name +
      " LANGUAGES C CXX)\n"
      "find_package(markervp REQUIRED COMPONENTS programs" +
      (rtl.empty() ? "" : " rtl") + ")\n\n" + rtl;
  text += sources.empty() ? "file(GLOB sources CONFIGURE_DEPENDS software/*.c software/*.cpp)\n"
                          : "set(sources" + quoted_lines(sources) + ")\n";
  return text + program_target(name, is_sdt);
}

}  // namespace platform::block_design
