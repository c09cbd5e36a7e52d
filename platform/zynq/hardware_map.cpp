#include <zynq/hardware_map.h>

#include <gic_registers.h>
#include <slcr_registers.h>
#include <vp/hierarchy.h>
#include <vp/register_bank.h>
#include <xilinx/concat/concat.h>
#include <zynq/xparameters.h>
#include <algorithm>
#include <string>

namespace platform {

namespace {

using report::HardwareMap;

/// What a module is, for people.
std::string title(const sc_core::sc_object& object) {
  static const std::pair<const char*, const char*> titles[] = {
      {"ps::Gic", "Interrupt controller (PL390)"},
      {"ps::GlobalTimer", "Global timer"},
      {"ps::PrivateTimer", "Private timer and watchdog"},
      {"ps::Slcr", "System level control registers"},
      {"ps::Uart", "UART"},
      {"ps::Ocm", "On-chip memory"},
      {"ps::Ddr", "DDR memory"},
      {"xilinx::AxiDma", "AXI DMA (PG021)"},
      {"xilinx::AxiGpio", "AXI GPIO (PG144)"},
      {"xilinx::AxiBramCtrl", "AXI BRAM controller (PG078)"}};
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
/// after it and one of its members ("gic_distributor": distributor of gic).
const sc_core::sc_object* object_of(const std::string& parent, const std::string& region) {
  const std::string prefix = parent + ".";
  if (const auto* found = sc_core::sc_find_object((prefix + region).c_str())) return found;
  for (std::size_t at = region.find('_'); at != std::string::npos; at = region.find('_', at + 1)) {
    std::string name = region;
    name[at] = '.';
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
      }
    }
    map.devices.push_back(std::move(device));
  }
}

void add_interrupts(HardwareMap& map, Zynq& zynq) {
  for (const auto& interrupt : zynq.ps.interrupts()) {
    map.interrupts.push_back({interrupt.id, interrupt.source->name()});
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

}  // namespace

report::HardwareMap hardware_map(Zynq& zynq) {
  HardwareMap map;
  ProcessingSystem& ps = zynq.ps;
  add_devices(map, ps.s_axi_hp0, ps.name(), "its own port; s_axi_hp0 of the PL");
  if (zynq.ports.registers())
    add_devices(map, *zynq.ports.registers(), zynq.pl().name(), "m_axi_gp0");
  add_devices(map, ps.interconnect, ps.name(), "interconnect",
              {"m_axi_gp0", "private_bus", "peripheral_bus"});
  add_devices(map, ps.private_bus.devices, ps.name(), "private_bus");
  add_devices(map, ps.peripheral_bus.devices, ps.name(), "peripheral_bus");
  std::sort(map.devices.begin(), map.devices.end(),
            [](const auto& a, const auto& b) { return a.base < b.base; });
  add_interrupts(map, zynq);
  add_clocks(map, ps);
  map.xparameters = xparameters_header(zynq, map);
  return map;
}

}  // namespace platform
