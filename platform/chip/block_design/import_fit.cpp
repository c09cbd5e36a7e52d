#include <chip/block_design/import_fit.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace platform::block_design {

namespace {

using handoff::Module;
using handoff::Netlist;
using handoff::parameter;
using handoff::Port;

std::string wrong_parameter(const IpRule& rule, const Module& module) {
  for (const ParameterRule& known : rule.parameters) {
    const std::string value = parameter(module.parameters, known.name);
    if (!value.empty() && !is_allowed(known, value))
      return known.name + " = " + value + " is not modelled, but " + allowed_values(known);
  }
  return {};
}

/// The model takes devices of the board as a whole.
std::string driven_board_input(const IpRule& rule, const Module& module, const Netlist& nets) {
  for (const std::string& pin : board_inputs(rule.ip)) {
    const Port* port = module.port(pin);
    const auto source = port ? nets.driver(*port) : std::nullopt;
    if (!source || !source->module ||
        may_drive_board_input(rule.ip, source->module->vlnv, source->port->name))
      continue;
    return "its pin " + pin + " is driven by " + source->module->instance + "." +
           source->port->name + ", and the model takes devices of the board only";
  }
  return {};
}

/// Streams that a model lacks: open ones matter to nothing.
std::string joined_stream(const IpRule& rule, const Module& module) {
  const handoff::BusInterface* stream =
      rule.ip == "xadc_wiz" ? module.interface("M_AXIS") : nullptr;
  return stream && !stream->bus.empty() ? "its stream M_AXIS is not modelled" : "";
}

/// Models of engines have one clock where the vendor's may have several. Clocks of one frequency
/// may be the same by another way: building the design shows it.
std::string several_clocks(const IpRule& rule, const Module& module, const Netlist& nets) {
  using Pins = std::vector<std::string>;
  static const std::map<std::string, std::vector<Pins>> groups{
      {"axi_dma", {{"s_axi_lite_aclk", "m_axi_mm2s_aclk", "m_axi_s2mm_aclk", "m_axi_sg_aclk"}}},
      {"axi_cdma", {{"m_axi_aclk", "s_axi_lite_aclk"}}},
      {"axi_vdma",
       {{"m_axi_mm2s_aclk", "m_axis_mm2s_aclk"}, {"m_axi_s2mm_aclk", "s_axis_s2mm_aclk"}}}};
  const auto known = groups.find(rule.ip);
  if (known == groups.end()) return {};
  for (const Pins& pins : known->second) {
    const Port* first = nullptr;
    for (const std::string& pin : pins) {
      const Port* port = module.port(pin);
      const auto source = port ? nets.driver(*port) : std::nullopt;
      if (!source || !source->port->hz) continue;
      if (first && *nets.driver(*first)->port->hz != *source->port->hz)
        return "its pins " + first->name + " and " + port->name +
               " have different clocks, and its model has one";
      if (!first) first = port;
    }
  }
  return {};
}

/// Whether something else than a BRAM controller is at a port of a memory.
bool has_native_port(const Module& memory, const Netlist& nets) {
  for (const char* pin : {"addra", "addrb"}) {
    const Port* port = memory.port(pin);
    const auto source = port ? nets.driver(*port) : std::nullopt;
    if (source && (!source->module || source->module->ip() != "axi_bram_ctrl")) return true;
  }
  return false;
}

std::string wrong_memory(const IpRule& rule, const Module& module, const Netlist& nets,
                         const handoff::RtlFinder& rtl) {
  const std::string file = parameter(module.parameters, "Coe_File");
  if (loads_memory(module) && rtl.data_file(file).empty())
    return "its contents, " + std::filesystem::path(file).filename().string() +
           ", were not found: name their folder with --rtl";
  if (!has_native_port(module, nets)) return {};
  const std::string type = parameter(module.parameters, "C_MEM_TYPE");
  for (const char* end : {"A", "B"}) {
    const std::string reads = parameter(module.parameters, std::string("C_READ_WIDTH_") + end);
    const std::string writes = parameter(module.parameters, std::string("C_WRITE_WIDTH_") + end);
    const bool does_both = type == "0" || type == "2";
    if (does_both && reads != writes)
      return std::string("its port ") + end + " reads " + reads + " bits and writes " + writes +
             ", which is not modelled";
  }
  return wrong_parameter(rule, module);
}

}  // namespace

bool loads_memory(const Module& module) {
  return module.ip() == "blk_mem_gen" && parameter(module.parameters, "C_LOAD_INIT_FILE") == "1";
}

std::string misfit(const IpRule& rule, const Module& module, const Netlist& nets,
                   const handoff::RtlFinder& rtl) {
  if (rule.ip == "blk_mem_gen") return wrong_memory(rule, module, nets, rtl);
  std::string wrong = wrong_parameter(rule, module);
  if (wrong.empty()) wrong = joined_stream(rule, module);
  if (wrong.empty()) wrong = several_clocks(rule, module, nets);
  return wrong.empty() ? driven_board_input(rule, module, nets) : wrong;
}

}  // namespace platform::block_design
