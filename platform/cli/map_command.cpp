#include <fmt/format.h>

#include <ostream>

#include <cli/commands.h>
#include <cli/map.h>
#include <run/simulation.h>
#include <vp/error.h>
#include <vp/text.h>
#include <vp/unit.h>
#include <zynq/hardware_map.h>

namespace platform::cli {

namespace {

using report::HardwareMap;

std::string size_text(std::uint64_t bytes) {
  return vp::format_quantity(vp::Decimal(bytes, 0), vp::Unit::bytes);
}
std::string frequency_text(std::uint64_t hertz) {
  return vp::format_quantity(vp::Decimal(hertz, 0), vp::Unit::frequency);
}

void print_devices(const HardwareMap& map, std::ostream& out) {
  out << fmt::format("{:<23} {:>8}  {:<18} {:<15} {}\n", "address", "size", "device", "through",
                     "what");
  for (const HardwareMap::Device& d : map.devices) {
    // The way of memory is a sentence: left to the page of the documentation.
    out << fmt::format("0x{:08X}..0x{:08X}  {:>8}  {:<18} {:<15} {}\n", d.base, d.base + d.size - 1,
                       size_text(d.size), d.name, d.way.find(' ') == std::string::npos ? d.way : "",
                       d.what);
  }
}

void print_interrupts(const HardwareMap& map, std::ostream& out) {
  out << "\ninterrupt  raised by\n";
  for (const HardwareMap::Interrupt& i : map.interrupts) {
    out << fmt::format("{:>9}  {}\n", i.id, i.source);
  }
}

void print_clocks(const HardwareMap& map, std::ostream& out) {
  out << fmt::format("\n{:<20} {:>16}  {}\n", "clock", "frequency", "set by");
  for (const HardwareMap::Clock& c : map.clocks) {
    const std::string note = c.programmed == c.hertz
                                 ? ""
                                 : " (as it stands it gives " + frequency_text(c.programmed) +
                                       ": from the first write on)";
    out << fmt::format("{:<20} {:>16}  {}{}\n", c.name, frequency_text(c.hertz), c.set_by, note);
  }
}

std::string remark(const HardwareMap::Register& r, const FieldsOnce::Found& fields) {
  if (!r.built) return " [not in this build]";
  const std::string bits = fields.as.empty() ? "" : " [bits as in " + fields.as + "]";
  return r.at_start == r.reset ? bits : fmt::format("{} [0x{:08X} at the start]", bits, r.at_start);
}

void print_fields(const FieldsOnce::Found& found, std::ostream& out) {
  for (const HardwareMap::Field& field : found.fields) {
    out << fmt::format("{:>16}  {:<18} {:<4} 0x{:<8X}  {}\n", bits_text(field.mask), field.name,
                       field.access, field.reset, field.documentation);
  }
}

void print_registers(const HardwareMap::Device& device, std::ostream& out) {
  out << fmt::format("{}: {}, 0x{:08X} to 0x{:08X} ({})\n", device.name, device.what, device.base,
                     device.base + device.size - 1, device.path);
  if (device.registers.empty()) {
    out << "memory, no registers\n";
    return;
  }
  out << fmt::format("\n{:<10}  {:<22} {:<6} {:<10}  {:<10}  {}\n", "address", "register", "access",
                     "reset", "writable", "what");
  FieldsOnce shown;
  for (const HardwareMap::Register& r : device.registers) {
    const FieldsOnce::Found found = shown.find(r);
    out << fmt::format("0x{:08X}  {:<22} {:<6} 0x{:08X}  0x{:08X}  {}{}\n", device.base + r.offset,
                       r.name, r.access, r.reset, r.writable, r.documentation, remark(r, found));
    print_fields(found, out);
  }
}

const HardwareMap::Device& find_device(const HardwareMap& map, const std::string& name) {
  std::vector<std::string> names;
  for (const HardwareMap::Device& device : map.devices) {
    if (device.name == name) return device;
    names.push_back(device.name);
  }
  const std::string nearest = vp::nearest_match(name, names);
  throw vp::InputError("unknown device '" + name +
                       "': " + (nearest.empty() ? "" : "did you mean '" + nearest + "'? ") +
                       "there are " + vp::join(names, ", "));
}

void print_overview(const HardwareMap& map, bool registers, std::ostream& out) {
  print_devices(map, out);
  print_interrupts(map, out);
  print_clocks(map, out);
  if (!registers) {
    out << "\n'markervp map DEVICE' shows the registers of a device.\n";
    return;
  }
  for (const HardwareMap::Device& device : map.devices) {
    if (device.registers.empty()) continue;
    out << "\n";
    print_registers(device, out);
  }
}

}  // namespace

int print_map(const MapOptions& options, std::ostream& out) {
  vp::Configuration configuration;
  load_configuration(options.configuration, configuration);
  const HardwareMap map = hardware_map(build(configuration, {})->zynq());
  if (options.markdown) {
    out << map_as_markdown(map);
  } else if (options.xparameters) {
    out << map.xparameters;
  } else if (!options.device.empty()) {
    print_registers(find_device(map, options.device), out);
  } else {
    print_overview(map, options.registers, out);
  }
  return done;
}

}  // namespace platform::cli
