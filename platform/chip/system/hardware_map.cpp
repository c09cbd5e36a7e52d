#include <chip/system/hardware_map.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <systemc>
#include <vector>

#include <axi/rtl_part.h>
#include <chip/handoff/register_file.h>
#include <gic_registers.h>
#include <uart_registers.h>
#include <vp/ip.h>
#include <vp/register_bank.h>
#include <vp/text.h>
#include <xilinx/axi_intc/axi_intc.h>
#include <xilinx/concat/concat.h>
#include <xilinx/register_stub/register_stub.h>
#include <xilinx/wiring/wiring.h>

namespace platform {

namespace {

using facts::HardwareMap;
using xparameters::Device;

/// What Vivado states for the 666,666,667 Hz of a ZedBoard: it multiplies 33.333333 MHz.
constexpr std::uint64_t usual_cpu_hz = 666'666'667, vivado_cpu_hz = 666'666'687;

}  // namespace

std::vector<xparameters::FabricInterrupt> fabric_interrupts(Zynq& zynq,
                                                            const sc_core::sc_object& module) {
  std::vector<xparameters::FabricInterrupt> list;
  for (auto* intc : vp::all_below<xilinx::AxiIntc>(zynq.pl())) {
    for (unsigned n = 0; n < intc->num_intr_inputs; ++n) {
      if (!intc->intr(n).bound()) continue;
      const xilinx::BitOrigin origin = xilinx::Wiring::origin(*intc->intr(n).signal(), 0);
      if (origin.signal && origin.signal->get_parent_object() == &module)
        list.push_back({vp::upper(origin.signal->basename()), vp::upper(intc->basename()), n});
    }
  }
  return list;
}

namespace {

/// A device with its lines to the interrupt controllers.
Device at_place(Zynq& zynq, const HardwareMap& map, const HardwareMap::Device& place,
                const sc_core::sc_object* module) {
  Device device{vp::upper(place.name),
                {},
                static_cast<std::uint32_t>(place.base),
                static_cast<std::uint32_t>(place.base + place.size - 1),
                {},
                {}};
  if (!module) return device;
  add_build(device, *module);
  // The outputs of a part of a block design are its own, not those of a register interface.
  const auto* slave = dynamic_cast<const axi::RtlPart*>(module->get_parent_object());
  const sc_core::sc_object* part = slave ? slave : module;
  device.part = vp::upper(part->basename());
  for (const auto& interrupt : map.interrupts) {
    const sc_core::sc_object* line = sc_core::sc_find_object(interrupt.source.c_str());
    if (line && line->get_parent_object() == part)
      device.interrupts.emplace_back(vp::upper(line->basename()), interrupt.id);
  }
  device.fabric_interrupts = fabric_interrupts(zynq, *module);
  return device;
}

std::vector<std::string> register_interfaces(const axi::RtlPart& rtl) {
  std::vector<std::string> names;
  for (const axi::Interface& one : rtl.interfaces())
    if (one.slave && (one.kind == axi::Kind::axi4 || one.kind == axi::Kind::axi_lite))
      names.push_back(one.name);
  return names;
}

/// Memory, or an IP of which only the address is known. The vendor's tools name the interface of an
/// IP that is not theirs: EXAMPLE_0_S_AXI_CONTROL.
Device without_bank(Zynq& zynq, const HardwareMap& map, const HardwareMap::Device& place) {
  const sc_core::sc_object* object = sc_core::sc_find_object(place.path.c_str());
  const auto* slave = dynamic_cast<const xilinx::RegisterStub::Slave*>(object);
  Device device = at_place(zynq, map, place, slave ? slave->get_parent_object() : object);
  std::vector<std::string> interfaces;
  if (const auto* rtl = dynamic_cast<const axi::RtlPart*>(object))
    interfaces = register_interfaces(*rtl);
  const auto* stub = dynamic_cast<const xilinx::RegisterStub*>(object);
  if (stub && stub->ip().rfind("xilinx.com:ip:", 0) != 0) {
    for (const auto* slave : vp::all_below<xilinx::RegisterStub::Slave>(*stub))
      interfaces.emplace_back(slave->basename());
  }
  if (interfaces.size() == 1) device.name += "_" + vp::upper(interfaces.front());
  return device;
}

/// What a module is, for people.
std::string title(const sc_core::sc_object& object) {
  if (const auto* ps = dynamic_cast<const ProcessingSystem*>(object.get_parent_object())) {
    for (const PsDevice& device : ps->devices)
      if (device.module.get() == &object) return device.title;
  }
  static const std::pair<const char*, const char*> titles[] = {
      {"ps::Gic", "Interrupt controller (PL390)"},
      {"ps::GlobalTimer", "Global timer"},
      {"ps::PrivateTimer", "Private timer and watchdog"},
      {"ps::Slcr", "System level control registers"},
      {"ps::Uart", "UART"},
      {"ps::Ocm", "On-chip memory"},
      {"ps::OcmLow", "On-chip memory at 0 (OCM_CFG)"},
      {"ps::Ddr", "DDR memory"},
      {"xilinx::AxiDma", "AXI DMA (PG021)"},
      {"xilinx::AxiGpio", "AXI GPIO (PG144)"},
      {"xilinx::AxiBramCtrl", "AXI BRAM controller (PG078)"},
      {"xilinx::AxiCdma", "AXI central DMA (PG034)"},
      {"xilinx::AxiFifoMmS", "AXI4-Stream FIFO (PG080)"},
      {"xilinx::AxiIic", "AXI IIC (PG090)"},
      {"xilinx::AxiIntc", "AXI interrupt controller (PG099)"},
      {"xilinx::AxiQuadSpi", "AXI Quad SPI (PG153)"},
      {"xilinx::AxiTimer", "AXI timer (PG079)"},
      {"xilinx::AxiUartlite", "AXI UART Lite (PG142)"},
      {"xilinx::AxiVdma", "AXI VDMA (PG020)"},
      {"xilinx::ClkWiz", "Clocking wizard (PG065)"},
      {"xilinx::VTc", "Video timing controller (PG016)"},
      {"xilinx::XadcWiz", "XADC wizard (PG091)"},
      {"ps::Gpio", "GPIO of the PS (MIO and EMIO)"},
      {"ps::I2c", "I2C"},
      {"ps::Spi", "SPI"},
      {"ps::Ttc", "Triple timer counter"},
      {"ps::XadcInterface", "XADC interface"},
      {"xilinx::RegisterStub", "Stub without model or RTL: reads give 0"}};
  for (const auto& [kind, text] : titles) {
    if (std::string(object.kind()) == kind) return text;
  }
  return object.kind();
}

std::string access_text(vp::Access access) {
  switch (access) {
    case vp::Access::read_write:
      return "rw";
    case vp::Access::read_only:
      return "ro";
    case vp::Access::write_only:
      return "wo";
    case vp::Access::write_1_to_clear:
      return "w1c";
    case vp::Access::write_1_to_set:
      return "w1s";
    case vp::Access::write_1_to_toggle:
      return "w1t";
  }
  return "";
}

const vp::RegisterBank* bank_of(const sc_core::sc_object& object) {
  if (const auto* bank = dynamic_cast<const vp::RegisterBank*>(&object)) return bank;
  for (const sc_core::sc_object* child : object.get_child_objects()) {
    if (const auto* bank = dynamic_cast<const vp::RegisterBank*>(child)) return bank;
  }
  return nullptr;
}

/// The module behind a region of the address map: it has the region's name, or the region is called
/// after it and one of its members ("gic_distributor": distributor of gic; of a stub in the
/// capitals of the hand-off).
const sc_core::sc_object* object_of(const std::string& parent, const std::string& region) {
  const std::string prefix = parent + ".";
  if (const auto* found = sc_core::sc_find_object((prefix + region).c_str())) return found;
  for (std::size_t at = region.find('_'); at != std::string::npos; at = region.find('_', at + 1)) {
    std::string name = region;
    name[at] = '.';
    if (const auto* found = sc_core::sc_find_object((prefix + name).c_str())) return found;
    name.replace(at + 1, std::string::npos, vp::upper(name.substr(at + 1)));
    if (const auto* found = sc_core::sc_find_object((prefix + name).c_str())) return found;
  }
  return nullptr;
}

std::vector<HardwareMap::Field> fields_of(const vp::Register& r) {
  std::vector<HardwareMap::Field> list;
  for (const vp::RegisterField& field : r.info().fields) {
    const std::uint32_t lowest = field.mask & (~field.mask + 1);
    list.push_back({field.name, field.mask, access_text(field.access),
                    (r.reset_value() & field.mask) / lowest, field.documentation});
  }
  return list;
}

std::vector<HardwareMap::Register> registers_of(const vp::RegisterBank& bank) {
  std::vector<HardwareMap::Register> list;
  for (const vp::Register& r : bank.registers()) {
    const vp::RegisterInfo& info = r.info();
    list.push_back({info.name, info.offset, info.reset, r.reset_value(), !r.removed(), r.value(),
                    access_text(info.access), info.writable, info.documentation, fields_of(r),
                    info.fields.first});
  }
  return list;
}

/// Those that a file describes, of RTL or of one of its interfaces.
std::vector<HardwareMap::Register> registers_of_rtl(const sc_core::sc_object& object) {
  const auto* slave = dynamic_cast<const axi::TlmToPins*>(&object);
  const auto* part =
      dynamic_cast<const axi::RtlPart*>(slave ? object.get_parent_object() : &object);
  const std::string file = part ? part->registers_file() : std::string();
  if (file.empty()) return {};
  const std::vector<std::string> slaves = register_interfaces(*part);
  const std::string name = slave ? slave->basename() : slaves.empty() ? "" : slaves.front();
  const auto maps = handoff::read_registers(file);
  const auto* found = handoff::registers_behind(maps, name, slaves.size() == 1);
  return found ? *found : std::vector<HardwareMap::Register>();
}

void add_devices(HardwareMap& map, const vp::Router& router, const std::string& parent,
                 const std::string& way, const std::vector<std::string>& buses = {}) {
  for (const vp::Router::Region& region : router.regions()) {
    if (std::find(buses.begin(), buses.end(), region.name) != buses.end()) continue;
    HardwareMap::Device device;
    device.name = region.name;
    device.base = region.base;
    device.size = region.size;
    device.way = way;
    if (const sc_core::sc_object* object = object_of(parent, region.name)) {
      const vp::RegisterBank* bank = bank_of(*object);
      device.path = bank ? bank->name() : object->name();
      device.what = bank == object ? title(*object->get_parent_object()) + ", " + object->basename()
                                   : title(*object);
      if (bank) {
        device.registers = registers_of(*bank);
        device.description = &bank->registers().front().info();
      } else {
        device.registers = registers_of_rtl(*object);
        for (HardwareMap::Register& one : device.registers) one.fields_of_kind = one.fields.data();
        device.description = object;
      }
    }
    map.devices.push_back(std::move(device));
  }
}

void add_pl_devices(HardwareMap& map, Zynq& zynq) {
  const vp::Router* bus = zynq.ports.registers();
  if (bus) add_devices(map, *bus, zynq.pl().name(), "m_axi_gp0");
  const vp::Router* second = zynq.ports.registers_gp1();
  if (second) add_devices(map, *second, zynq.pl().name(), "m_axi_gp1");
}

void add_interrupts(HardwareMap& map, Zynq& zynq) {
  for (const auto& interrupt : zynq.ps.interrupts()) {
    // What the PL drives is known by what is behind the pin of the PS.
    const auto* pin =
        dynamic_cast<const xilinx::WireAdapterBase*>(interrupt.source->get_parent_object());
    const vp::SignalBase* source = interrupt.source;
    if (pin) {
      const xilinx::BitOrigin origin = xilinx::Wiring::origin(pin->source(), 0);
      source = origin.signal ? origin.signal : &pin->source();
    }
    map.interrupts.push_back({interrupt.id, source->name()});
  }
  // A concat shows whose lines they are.
  const vp::SignalBase* lines = zynq.ps.gic.irq_f2p.signal();
  for (xilinx::Concat* concat : vp::all_below<xilinx::Concat>(zynq.pl())) {
    if (&concat->dout != lines) continue;
    for (unsigned bit = 0; bit < concat->dout.width(); ++bit) {
      const vp::SignalBase* source = concat->in(bit).signal();
      if (source) map.interrupts.push_back({gic::irq_f2p_id(bit), source->name()});
    }
  }
  // Other wiring is followed bit by bit.
  for (unsigned bit = 0; lines && bit < gic::irq_f2p_bits; ++bit) {
    const xilinx::BitOrigin origin = xilinx::Wiring::origin(*lines, bit);
    if (!origin.signal || origin.signal == lines) continue;
    // The width of an output of a stub is not known: it is one line, as interrupts of IP are.
    const bool is_known = origin.signal->width() <= gic::irq_f2p_bits;
    if (is_known || origin.bit == 0)
      map.interrupts.push_back({gic::irq_f2p_id(bit), origin.signal->name()});
  }
  std::sort(map.interrupts.begin(), map.interrupts.end(),
            [](const auto& a, const auto& b) { return a.id < b.id; });
}

void add_clocks(HardwareMap& map, ProcessingSystem& ps) {
  const auto add = [&map](const vp::Clock& clock, const std::string& set_by,
                          std::uint64_t programmed) {
    map.clocks.push_back({clock.name(), clock.frequency_hz(), set_by, programmed});
  };
  add(ps.cpu_clk.clk, "ARM_CLK_CTRL", ps.slcr.cpu_clocks().cpu_6x4x);
  for (const auto& [number, source] : ps.fclks()) {
    add(source->clk, "FPGA" + std::to_string(number) + "_CLK_CTRL",
        ps.slcr.programmed_fclk_hz(number));
  }
  add(ps.uart0_ref_clk, "UART_CLK_CTRL", ps.uart0_ref_clk.frequency_hz());
  add(ps.uart1_ref_clk, "UART_CLK_CTRL", ps.uart1_ref_clk.frequency_hz());
}

xparameters::Platform xparameters_platform(Zynq& zynq) {
  HardwareMap map;
  add_pl_devices(map, zynq);
  add_interrupts(map, zynq);
  xparameters::Platform platform;
  const std::uint64_t cpu_hz = zynq.ps.cpu_clk.clk.frequency_hz();
  platform.cpu_hz = cpu_hz == usual_cpu_hz ? vivado_cpu_hz : cpu_hz;
  platform.ps_clock_hz = static_cast<std::uint64_t>(zynq.ps.slcr.ps_clk.get());
  platform.ddr_base = ps::Ddr::base;
  platform.ddr_last = static_cast<std::uint32_t>(zynq.ps.ddr.end() - 1);
  if (zynq.ps.uart0.enabled) platform.uarts.push_back(uart::uart0_base);
  if (zynq.ps.uart1.enabled) platform.uarts.push_back(uart::uart1_base);
  // Those that software can reach, in the order in which drivers number them.
  for (const auto* bank : vp::all_below<vp::RegisterBank>(zynq.pl())) {
    for (const HardwareMap::Device& place : map.devices) {
      if (place.path == bank->name())
        platform.devices.push_back(at_place(zynq, map, place, bank->get_parent_object()));
    }
  }
  for (const HardwareMap::Device& place : map.devices) {
    const auto* bank =
        dynamic_cast<const vp::RegisterBank*>(sc_core::sc_find_object(place.path.c_str()));
    if (!bank) platform.devices.push_back(without_bank(zynq, map, place));
  }
  std::stable_sort(platform.devices.begin(), platform.devices.end(),
                   [](const Device& a, const Device& b) { return a.driver < b.driver; });
  return platform;
}

}  // namespace

std::string xparameters_header(Zynq& zynq) {
  return xparameters::header(xparameters_platform(zynq));
}

std::shared_ptr<const xparameters::Values> xparameters_values(Zynq& zynq) {
  return xparameters::values(xparameters_platform(zynq));
}

facts::HardwareMap hardware_map(Zynq& zynq) {
  HardwareMap map;
  ProcessingSystem& ps = zynq.ps;
  add_devices(map, ps.s_axi_hp0, ps.name(), "its own port; s_axi_hp0 of the PL");
  add_pl_devices(map, zynq);
  add_devices(map, ps.interconnect, ps.name(), "interconnect",
              {"m_axi_gp0", "m_axi_gp1", "private_bus", "peripheral_bus"});
  add_devices(map, ps.private_bus.devices, ps.name(), "private_bus");
  add_devices(map, ps.peripheral_bus.devices, ps.name(), "peripheral_bus");
  std::sort(map.devices.begin(), map.devices.end(),
            [](const auto& a, const auto& b) { return a.base < b.base; });
  add_interrupts(map, zynq);
  add_clocks(map, ps);
  map.xparameters = xparameters_header(zynq);
  return map;
}

std::string register_text(const HardwareMap& map, std::uint32_t address, std::uint32_t value) {
  for (const HardwareMap::Device& device : map.devices) {
    for (const HardwareMap::Register& r : device.registers) {
      if (device.base + r.offset != address) continue;
      std::string set;
      for (const HardwareMap::Field& field : r.fields) {
        const std::uint32_t bits = (value & field.mask) / (field.mask & (~field.mask + 1));
        if (bits != 0) set += field.name + " " + std::to_string(bits) + ", ";
      }
      return device.name + "." + r.name + ": " + vp::hex(value) +
             (set.empty() ? "" : " (" + set + "all else 0)");
    }
  }
  return {};
}

namespace {

/// "-" if the register was not used so.
std::string bits(std::uint64_t accesses, std::uint32_t mask) {
  return accesses == 0 ? "-" : vp::hex(mask);
}

std::string row(const vp::Register& r) {
  const vp::Register::Use& use = r.use();
  std::string text = "| " + std::string(r.info().name);
  text += " | " + std::to_string(use.reads) + " | " + std::to_string(use.writes);
  text += " | " + bits(use.reads, use.read_ones) + " | " + bits(use.reads, use.read_zeros);
  text += " | " + bits(use.writes, use.written_ones) + " | " + bits(use.writes, use.written_zeros);
  return text + " |\n";
}

std::string section(const std::string& device, const vp::RegisterBank& bank) {
  std::string rows, untouched;
  std::size_t used = 0, built = 0;
  for (const vp::Register& r : bank.registers()) {
    const bool touched = r.use().reads + r.use().writes != 0;
    if (r.removed() && !touched) continue;
    ++built;
    used += touched ? 1 : 0;
    if (touched) {
      rows += row(r);
    } else {
      untouched += (untouched.empty() ? "" : ", ") + std::string(r.info().name);
    }
  }
  std::string text = "\n## " + device + ": " + std::to_string(used) + " of " +
                     std::to_string(built) + " registers\n\n";
  if (!rows.empty()) {
    text +=
        "| Register | Reads | Writes | Read as 1 | Read as 0 | Written 1 | Written 0 |\n"
        "|---|---|---|---|---|---|---|\n" +
        rows + "\n";
  }
  if (!untouched.empty()) text += "Never touched: " + untouched + "\n";
  return text;
}

}  // namespace

std::string register_coverage(Zynq& zynq) {
  std::string text =
      "# Registers that the program used\n\nMasks show the bits that were seen or written with "
      "that value at least once.\n";
  for (const auto& device : hardware_map(zynq).devices) {
    const auto* bank =
        dynamic_cast<const vp::RegisterBank*>(sc_core::sc_find_object(device.path.c_str()));
    if (bank) text += section(device.name, *bank);
  }
  return text;
}

}  // namespace platform
