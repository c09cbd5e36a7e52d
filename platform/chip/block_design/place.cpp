#include <chip/block_design/place_ports.h>

#include <strings.h>
#include <vp/error.h>
#include <vp/report.h>
#include <vp/text.h>
#include <vp/unit.h>
#include <xilinx/axi_dma/axi_dma.h>
#include <xilinx/axi_gpio/axi_gpio.h>
#include <xilinx/axi_interconnect/axi_interconnect.h>
#include <xilinx/axis_buffer/axis_buffer.h>
#include <xilinx/proc_sys_reset/proc_sys_reset.h>
#include <xilinx/register_stub/register_stub.h>
#include <xilinx/wiring/wiring.h>

#include <algorithm>
#include <utility>

namespace platform::block_design {

std::string Placement::text(const std::string& name) const {
  for (const auto& [key, value] : part.parameters)
    if (::strcasecmp(key.c_str(), name.c_str()) == 0) return value;
  const IpRule* rule = rule_for(part.vlnv);
  const ParameterRule* known = rule ? find_parameter(*rule, name) : nullptr;
  return known ? known->usual : std::string();
}

std::uint64_t Placement::number(const std::string& name) const {
  const std::string digits = unquoted(text(name));
  const auto value = vp::Decimal::parse(digits);
  const auto whole = value ? value->whole() : std::nullopt;
  if (!whole || *whole < 0 || *whole > UINT64_MAX)
    refuse(name + " = '" + vp::excerpt(digits) + "' is not a whole number");
  return static_cast<std::uint64_t>(*whole);
}

vp::Clock& Placement::clock(const std::vector<std::string>& pins) const {
  vp::Clock* found = nullptr;
  std::string of;
  for (const std::string& pin : pins) {
    vp::Clock* clock = clock_at(pin);
    if (!clock) continue;
    if (found && clock != found) {
      refuse("its pins " + of + " and " + pin +
             " have different clocks, and its model has one: 'as: stub' leaves it out");
    }
    found = clock;
    of = pin;
  }
  if (!found)
    refuse("none of its clock pins is driven by a clock of a known frequency: " + vp::one_of(pins));
  return *found;
}

void Placement::refuse(const std::string& problem) const {
  throw vp::InputError(part.place + ": " + part.name + ": " + problem);
}

void Surroundings::refuse(const std::string& problem) const {
  throw vp::InputError(part.place + ": " + part.name + ": " + problem);
}

namespace {

xilinx::GpioChannelBuild gpio_channel(const Placement& at, const std::string& number) {
  xilinx::GpioChannelBuild build;
  const std::string end = number.empty() ? "" : "_" + number;
  if (at.flag("C_ALL_INPUTS" + end)) build.direction = xilinx::GpioDirection::all_inputs;
  if (at.flag("C_ALL_OUTPUTS" + end)) build.direction = xilinx::GpioDirection::all_outputs;
  build.width = static_cast<std::uint32_t>(at.number("C_GPIO" + number + "_WIDTH"));
  build.dout_default = static_cast<std::uint32_t>(at.number("C_DOUT_DEFAULT" + end));
  build.tri_default = static_cast<std::uint32_t>(at.number("C_TRI_DEFAULT" + end));
  return build;
}

Placed place_gpio(const Placement& at) {
  xilinx::AxiGpioBuild build;
  build.gpio = gpio_channel(at, "");
  build.gpio2 = gpio_channel(at, "2");
  build.is_dual = at.flag("C_IS_DUAL");
  build.interrupt_present = at.flag("C_INTERRUPT_PRESENT");
  auto gpio =
      std::make_unique<xilinx::AxiGpio>(at.part.name.c_str(), at.clock({"s_axi_aclk"}), build);
  Placed placed;
  placed.slaves = {{"S_AXI", registers(gpio->s_axi)}};
  placed.inputs = {{"s_axi_aresetn", input(at, "s_axi_aresetn", gpio->s_axi_aresetn)},
                   {"gpio_io_i", input(at, "gpio_io_i", gpio->gpio.io_i)},
                   {"gpio2_io_i", input(at, "gpio2_io_i", gpio->gpio2.io_i)}};
  placed.outputs = {{"gpio_io_o", &gpio->gpio.io_o},
                    {"gpio_io_t", &gpio->gpio.io_t},
                    {"gpio2_io_o", &gpio->gpio2.io_o},
                    {"gpio2_io_t", &gpio->gpio2.io_t},
                    {"ip2intc_irpt", &gpio->ip2intc_irpt}};
  placed.object = std::move(gpio);
  return placed;
}

constexpr std::uint32_t narrowest_engine = 4, bits_per_byte = 8;
/// Beats that a width converter holds (assumed).
constexpr std::uint32_t converter_depth = 8;

xilinx::DmaWidths dma_widths(const Placement& at, const char* memory, const char* stream) {
  const auto bytes = [&](const char* parameter) {
    return static_cast<std::uint32_t>(at.number(parameter) / bits_per_byte);
  };
  return {bytes(memory), std::max(bytes(stream), narrowest_engine)};
}

xilinx::AxiDmaBuild dma_build(const Placement& at) {
  xilinx::AxiDmaBuild build;
  build.include_mm2s = at.flag("C_INCLUDE_MM2S");
  build.include_s2mm = at.flag("C_INCLUDE_S2MM");
  build.include_sg = at.flag("C_INCLUDE_SG");
  build.length_width = static_cast<std::uint32_t>(at.number("C_SG_LENGTH_WIDTH"));
  build.mm2s_dre = at.flag("C_INCLUDE_MM2S_DRE");
  build.s2mm_dre = at.flag("C_INCLUDE_S2MM_DRE");
  build.mm2s_burst_beats = static_cast<std::uint32_t>(at.number("C_MM2S_BURST_SIZE"));
  build.s2mm_burst_beats = static_cast<std::uint32_t>(at.number("C_S2MM_BURST_SIZE"));
  build.mm2s = dma_widths(at, "C_M_AXI_MM2S_DATA_WIDTH", "C_M_AXIS_MM2S_TDATA_WIDTH");
  build.s2mm = dma_widths(at, "C_M_AXI_S2MM_DATA_WIDTH", "C_S_AXIS_S2MM_TDATA_WIDTH");
  return build;
}

/// The engine's streams have 32 bits or more. Narrower ones end in a converter, which takes a clock
/// (assumed): the same bytes, counted as bytes.
class NarrowStream : public sc_core::sc_module {
 public:
  NarrowStream(sc_core::sc_module_name name, vp::Clock& clock, std::uint32_t in_bytes,
               std::uint32_t out_bytes)
      : sc_module(name), buffer("buffer", clock, {in_bytes, out_bytes, converter_depth, 1}) {}
  const char* kind() const override { return "NarrowStream"; }

  vp::AxiStream inside{"inside"};
  xilinx::AxisBuffer buffer;
};

/// The resets that an engine passes on to what is at its streams.
class ResetOutputs : public sc_core::sc_module {
 public:
  explicit ResetOutputs(sc_core::sc_module_name name) : sc_module(name) {}
  const char* kind() const override { return "ResetOutputs"; }
  vp::Signal<bool> resetn{"resetn"};
};

/// Only where the design reads one.
void add_reset_outputs(const Placement& at, xilinx::AxiDma& dma, Placed& placed) {
  constexpr const char* names[] = {"mm2s_prmry_reset_out_n", "mm2s_cntrl_reset_out_n",
                                   "s2mm_prmry_reset_out_n", "s2mm_sts_reset_out_n"};
  const auto is_read = [&](const std::string& pin) {
    for (const PlacedPart& other : at.design.parts)
      for (const auto& [name, source] : other.pins)
        if (source.part == at.part.name && source.port == pin) return true;
    return false;
  };
  if (std::none_of(std::begin(names), std::end(names), is_read)) return;
  auto outputs = std::make_unique<ResetOutputs>((at.part.name + "_reset_out").c_str());
  dma.drive_reset_out(outputs->resetn);
  for (const char* name : names) placed.outputs[name] = &outputs->resetn;
  at.adapters.push_back(std::move(outputs));
}

void add_mm2s(const Placement& at, xilinx::AxiDma& dma, vp::Clock& clock, Placed& placed) {
  placed.masters["M_AXI_MM2S"] = memory_master(dma.mm2s().m_axi);
  const auto bytes =
      static_cast<std::uint32_t>(at.number("C_M_AXIS_MM2S_TDATA_WIDTH") / bits_per_byte);
  std::function<void(vp::AxiStream&, vp::Clock&)> bind = [&dma](vp::AxiStream& link, vp::Clock&) {
    dma.mm2s().m_axis(link);
  };
  if (bytes < narrowest_engine) {
    auto narrow = std::make_unique<NarrowStream>((at.part.name + "_mm2s_width").c_str(), clock,
                                                 narrowest_engine, bytes);
    dma.mm2s().m_axis(narrow->inside);
    narrow->buffer.s_axis(narrow->inside);
    bind = [line = narrow.get()](vp::AxiStream& link, vp::Clock&) { line->buffer.m_axis(link); };
    at.adapters.push_back(std::move(narrow));
  }
  placed.stream_masters["M_AXIS_MM2S"] = {bind, &clock, bytes};
}

void add_s2mm(const Placement& at, xilinx::AxiDma& dma, vp::Clock& clock, Placed& placed) {
  placed.masters["M_AXI_S2MM"] = memory_master(dma.s2mm().m_axi);
  const auto bytes =
      static_cast<std::uint32_t>(at.number("C_S_AXIS_S2MM_TDATA_WIDTH") / bits_per_byte);
  std::function<void(vp::AxiStream&, vp::Clock&)> bind = [&dma](vp::AxiStream& link, vp::Clock&) {
    dma.s2mm().s_axis(link);
  };
  if (bytes < narrowest_engine) {
    auto narrow = std::make_unique<NarrowStream>((at.part.name + "_s2mm_width").c_str(), clock,
                                                 bytes, narrowest_engine);
    narrow->buffer.m_axis(narrow->inside);
    dma.s2mm().s_axis(narrow->inside);
    bind = [line = narrow.get()](vp::AxiStream& link, vp::Clock&) { line->buffer.s_axis(link); };
    at.adapters.push_back(std::move(narrow));
  }
  placed.stream_slaves["S_AXIS_S2MM"] = {bind, &clock, bytes};
}

/// Several masters of a model that leave the IP as one.
void join_masters(Placed& placed, const std::vector<std::string>& names, const std::string& one) {
  std::vector<MasterPort> ports;
  for (const std::string& name : names) {
    const auto port = placed.masters.find(name);
    if (port == placed.masters.end()) continue;
    ports.push_back(port->second);
    placed.masters.erase(port);
  }
  placed.masters[one] = {[ports](vp::Router& way) {
                           for (const MasterPort& port : ports) port.bind(way);
                         },
                         [ports](xilinx::MemoryPath& path) {
                           for (const MasterPort& port : ports) port.share(path);
                         }};
}

Placed place_dma(const Placement& at) {
  const xilinx::AxiDmaBuild build = dma_build(at);
  vp::Clock& clock =
      at.clock({"s_axi_lite_aclk", "m_axi_mm2s_aclk", "m_axi_s2mm_aclk", "m_axi_sg_aclk"});
  auto dma = std::make_unique<xilinx::AxiDma>(at.part.name.c_str(), clock, build);
  Placed placed;
  placed.slaves = {{"S_AXI_LITE", registers(dma->s_axi_lite)}};
  placed.inputs = {{"axi_resetn", input(at, "axi_resetn", dma->axi_resetn)}};
  placed.outputs = {{"mm2s_introut", &dma->mm2s_introut}, {"s2mm_introut", &dma->s2mm_introut}};
  add_reset_outputs(at, *dma, placed);
  if (dma->include_mm2s) add_mm2s(at, *dma, clock, placed);
  if (dma->include_s2mm) add_s2mm(at, *dma, clock, placed);
  if (dma->include_sg) placed.masters["M_AXI_SG"] = memory_master(dma->scatter_gather().m_axi);
  if (at.flag("C_SINGLE_INTERFACE")) join_masters(placed, {"M_AXI_MM2S", "M_AXI_S2MM"}, "M_AXI");
  placed.object = std::move(dma);
  return placed;
}

Placed place_reset(const Placement& at) {
  auto reset =
      std::make_unique<xilinx::ProcSysReset>(at.part.name.c_str(), at.clock({"slowest_sync_clk"}));
  Placed placed;
  // The model takes the external reset active low, the auxiliary one active high.
  placed.inputs = {
      {"ext_reset_in", input(at, "ext_reset_in", reset->ext_reset_in, at.flag("C_EXT_RESET_HIGH"))},
      {"aux_reset_in",
       input(at, "aux_reset_in", reset->aux_reset_in, !at.flag("C_AUX_RESET_HIGH"))},
      {"dcm_locked", input(at, "dcm_locked", reset->dcm_locked)}};
  placed.unused_inputs = {"mb_debug_sys_rst"};
  placed.outputs = {{"bus_struct_reset", &reset->bus_struct_reset},
                    {"interconnect_aresetn", &reset->interconnect_aresetn},
                    {"peripheral_reset", &reset->peripheral_reset},
                    {"peripheral_aresetn", &reset->peripheral_aresetn},
                    {"mb_reset", &reset->mb_reset}};
  placed.object = std::move(reset);
  return placed;
}

/// Clocks from a beat in to that beat on offer, assumed: through a FIFO's memory, or one register.
constexpr std::uint32_t fifo_latency = 3, slice_latency = 1;

Placed place_stream_buffer(const Placement& at, const std::string& ip) {
  xilinx::AxisBufferBuild build;
  const auto bytes = [&](const char* name) { return static_cast<std::uint32_t>(at.number(name)); };
  if (ip == "axis_dwidth_converter") {
    build.in_bytes = bytes("S_TDATA_NUM_BYTES");
    build.out_bytes = bytes("M_TDATA_NUM_BYTES");
    build.depth = converter_depth;
  } else {
    build.in_bytes = build.out_bytes = bytes("TDATA_NUM_BYTES");
    build.strobe = at.flag("HAS_TSTRB") ? build.in_bytes : 0;
    build.user = bytes("TUSER_WIDTH");
    build.id = bytes("TID_WIDTH");
    build.dest = bytes("TDEST_WIDTH");
    const bool is_fifo = ip == "axis_data_fifo";
    build.depth = is_fifo ? static_cast<std::uint32_t>(at.number("FIFO_DEPTH")) : 2;
    build.latency = is_fifo ? fifo_latency : slice_latency;
  }
  vp::Clock& clock = at.clock({"s_axis_aclk", "aclk"});
  auto buffer = std::make_unique<xilinx::AxisBuffer>(at.part.name.c_str(), clock, build);
  Placed placed;
  xilinx::AxisBuffer* line = buffer.get();
  placed.inputs = {{"aresetn", input(at, "aresetn", buffer->aresetn)},
                   {"s_axis_aresetn", input(at, "s_axis_aresetn", buffer->aresetn)}};
  placed.stream_slaves["S_AXIS"] = {[line](vp::AxiStream& link, vp::Clock&) { line->s_axis(link); },
                                    &clock};
  placed.stream_masters["M_AXIS"] = {
      [line](vp::AxiStream& link, vp::Clock&) { line->m_axis(link); }, &clock, build.out_bytes};
  placed.object = std::move(buffer);
  return placed;
}

Placed place_bus(const Placement& at) {
  std::vector<std::string> clocks{"ACLK", "aclk", "s_axi_aclk"};
  Placed placed;
  placed.object = std::make_unique<xilinx::AxiInterconnect>(at.part.name.c_str(), at.clock(clocks));
  return placed;
}

std::unique_ptr<xilinx::Wiring> make_wiring(const Placement& at) {
  const std::string ip = vp::split(at.part.vlnv, ':').at(2);
  const char* name = at.part.name.c_str();
  const auto number = [&](const std::string& parameter) {
    return static_cast<unsigned>(std::min<std::uint64_t>(at.number(parameter), 4096));
  };
  if (ip == "xlconcat" || ip == "ilconcat") {
    std::vector<unsigned> widths;
    for (unsigned i = 0; i < number("NUM_PORTS"); ++i)
      widths.push_back(number("IN" + std::to_string(i) + "_WIDTH"));
    return xilinx::make_concat(name, widths);
  }
  if (ip == "xlslice" || ip == "ilslice")
    return xilinx::make_slice(name, number("DIN_FROM"), number("DIN_TO"));
  if (ip == "xlconstant" || ip == "ilconstant")
    return xilinx::make_constant(name, number("CONST_WIDTH"), at.number("CONST_VAL"));
  if (ip == "util_reduced_logic")
    return xilinx::make_reduction(name, at.text("C_OPERATION"), number("C_SIZE"));
  return xilinx::make_gates(name, at.text("C_OPERATION"), number("C_SIZE"));
}

/// Names of inputs by number: In0, Din, Op1.
std::vector<std::string> wiring_inputs(const std::string& ip, std::size_t count) {
  if (ip == "xlslice" || ip == "ilslice") return {"Din"};
  std::vector<std::string> names;
  const bool is_concat = ip == "xlconcat" || ip == "ilconcat";
  for (std::size_t i = 0; i < count; ++i)
    names.push_back(is_concat ? "In" + std::to_string(i) : "Op" + std::to_string(i + 1));
  return names;
}

Placed place_wiring(const Placement& at) {
  std::unique_ptr<xilinx::Wiring> wiring = make_wiring(at);
  Placed placed;
  xilinx::Wiring* wires = wiring.get();
  const auto names = wiring_inputs(vp::split(at.part.vlnv, ':').at(2), wires->inputs());
  for (std::size_t i = 0; i < names.size(); ++i) {
    placed.inputs[names[i]] = [wires, i](vp::SignalBase& source) { wires->connect(i, source); };
  }
  placed.outputs[wires->out.basename()] = &wires->out;
  placed.object = std::move(wiring);
  return placed;
}

/// Any pin, register interface and stream that the design speaks of.
Placed place_stub(const Placement& at) {
  vp::Clock* clock = nullptr;
  for (const auto& [pin, source] : at.part.pins) {
    if (!clock) clock = at.clock_at(pin);
  }
  vp::Clock& own = clock ? *clock : at.ports.fclk_clk(0);
  auto stub = std::make_unique<xilinx::RegisterStub>(at.part.name.c_str(), own, at.part.vlnv);
  if (!at.part.refused.empty())
    vp::warn(*stub, "/markervp/block_design/rtl",
             "a stub is in its place, for its RTL was refused when the folder was built: " +
                 at.part.refused);
  Placed placed;
  xilinx::RegisterStub* stand_in = stub.get();
  for (const auto& [pin, hertz] : at.part.clocks) placed.clocks[pin] = &stub->add_clock(pin, hertz);
  placed.any_output = [stand_in](const std::string& pin) -> vp::SignalBase* {
    return &stand_in->output(pin);
  };
  placed.any_slave = [stand_in](const std::string& interface) {
    return SlavePort{[stand_in, interface](RegionSocket& socket) {
      socket.bind(stand_in->add_slave(interface).socket);
    }};
  };
  placed.any_stream_master = [stand_in](const std::string&) {
    return StreamPort{
        [stand_in](vp::AxiStream& link, vp::Clock& clock) { stand_in->offer_stream(link, clock); }};
  };
  placed.any_stream_slave = [stand_in](const std::string&) {
    return StreamPort{
        [stand_in](vp::AxiStream& link, vp::Clock& clock) { stand_in->take_stream(link, clock); }};
  };
  placed.object = std::move(stub);
  return placed;
}

}  // namespace

Placed place_part(const Placement& at) {
  if (at.part.is_stub()) return place_stub(at);
  if (!at.part.rtl.empty()) return place_rtl(at);
  if (const OwnIp* own = own_ip(at.part.vlnv)) return own->place(at);
  const IpRule* rule = at.part.rule();
  if (rule->kind == Kind::left_out) return {};
  if (rule->kind == Kind::bus) return place_bus(at);
  if (rule->kind == Kind::wiring) return place_wiring(at);
  if (rule->ip == "axi_gpio") return place_gpio(at);
  if (rule->ip == "axi_dma") return place_dma(at);
  if (rule->ip == "axi_bram_ctrl") return place_bram_ctrl(at);
  if (rule->ip == "blk_mem_gen") return place_block_memory(at);
  if (rule->ip == "proc_sys_reset") return place_reset(at);
  if (const Placer placer = stream_placer(at)) return placer(at);
  if (rule->ip.rfind("axis_", 0) == 0) return place_stream_buffer(at, rule->ip);
  if (const Placer placer = peripheral_placer(rule->ip)) return placer(at);
  if (const Placer placer = video_placer(rule->ip)) return placer(at);
  return place_clock_manager(at);
}

}  // namespace platform::block_design
