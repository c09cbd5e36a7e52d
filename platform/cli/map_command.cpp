#include <fmt/format.h>

#include <chip/block_design/diagram.h>
#include <chip/linux_app/linux_devices.h>
#include <chip/run/simulation.h>
#include <chip/system/hardware_map.h>
#include <chip/system/ps_blocks.h>
#include <cli/commands.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>
#include <vp/unit.h>

#include <algorithm>
#include <ostream>
#include <vector>

namespace platform::cli {

std::string bits_text(std::uint32_t mask) {
  constexpr unsigned most_ranges = 4;
  std::string text;
  unsigned ranges = 0;
  for (int high = 31; high >= 0; --high) {
    if ((mask >> high & 1) == 0) continue;
    int low = high;
    while (low > 0 && (mask >> (low - 1) & 1) != 0) --low;
    if (!text.empty()) text += ", ";
    text += high == low ? std::to_string(high) : fmt::format("{}:{}", high, low);
    ++ranges;
    high = low;
  }
  return ranges > most_ranges ? fmt::format("0x{:08X}", mask) : text;
}

FieldsOnce::Found FieldsOnce::find(const facts::HardwareMap::Register& r) {
  if (r.fields.empty()) return {none_, ""};
  const auto [place, first] = shown_.emplace(r.fields_of_kind, r.name);
  if (first) return {r.fields, ""};
  return {none_, place->second};
}

namespace {

using facts::HardwareMap;

constexpr const char* head = R"(# Registers

What software sees of the platform, as `markervp map --markdown` prints it; the program makes this page, a test keeps it
up to date. Names, offsets, reset values and access come from the register descriptions (`models/*/*/registers/`), which
the models and the PS software include, too.

Access: `rw` read and write, `ro` read only, `wo` write only (reads 0), `w1c` writing 1 clears the bit, `w1s` writing 1
sets it, `w1t` writing 1 inverts it. Writes change the bits of the column *writable* only; bits without field read 0. Reset
values are those of an IP with all its build options; *at the start* is what boot code has left in this platform when the
program begins. `markervp map DEVICE` shows the build and the values of one device of the platform as you configure it.
)";

/// A bar ends a cell of a table.
std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

/// 0x4120_0000, as the manuals write it.
std::string address(std::uint64_t value) {
  return fmt::format("0x{:04X}_{:04X}", value >> 16, value & 0xFFFF);
}

std::string devices(const HardwareMap& map) {
  std::string text =
      "\n## Memory map\n\n| Addresses | Size | Device | What | Reached through |\n"
      "|---|---|---|---|---|\n";
  for (const HardwareMap::Device& d : map.devices) {
    text += fmt::format("| {} … {} | {} | `{}` | {} | {} |\n", address(d.base),
                        address(d.base + d.size - 1),
                        vp::format_quantity(vp::Decimal(d.size, 0), vp::Unit::bytes), d.name,
                        cell(d.what), cell(d.way));
  }
  return text;
}

/// Those where no device of the map is.
std::string blocks_without_model(const HardwareMap& map) {
  std::string text =
      "\nEach core finds an interrupt controller's CPU interface, a private timer and a watchdog "
      "of its "
      "own at these addresses, and in the\ndistributor the registers of interrupts 0 to 31; the "
      "global "
      "timer's comparator is that of core 0.\n"
      "\n## Blocks of the PS without a model\n\nTheir registers are not there: an access is a data "
      "abort, which ends the program with their address.\nThe DDR works without its controller, "
      "and "
      "the caches are in the cost of memory accesses.\n\n| From | Block |\n|---|---|\n";
  for (const PsBlock& block : ps_blocks) {
    const bool modelled = std::any_of(
        map.devices.begin(), map.devices.end(), [&block](const HardwareMap::Device& device) {
          return block.base >= device.base && block.base - device.base < device.size;
        });
    if (!modelled) text += fmt::format("| {} | {} |\n", address(block.base), block.name);
  }
  return text;
}

std::string interrupts(const HardwareMap& map) {
  std::string text = "\n## Interrupts\n\n| Number | Raised by |\n|---|---|\n";
  for (const HardwareMap::Interrupt& i : map.interrupts) {
    text += fmt::format("| {} | `{}` |\n", i.id, i.source);
  }
  return text;
}

std::string clocks(const HardwareMap& map) {
  std::string text = "\n## Clocks\n\n| Clock | At the start | Set by |\n|---|---|---|\n";
  for (const HardwareMap::Clock& c : map.clocks) {
    text +=
        fmt::format("| `{}` | {} | {} |\n", c.name,
                    vp::format_quantity(vp::Decimal(c.hertz, 0), vp::Unit::frequency), c.set_by);
  }
  return text;
}

/// The fields of a device's registers; "" if none has any.
std::string fields(const HardwareMap::Device& device) {
  std::string text;
  FieldsOnce shown;
  for (const HardwareMap::Register& r : device.registers) {
    const FieldsOnce::Found found = shown.find(r);
    for (const HardwareMap::Field& field : found.fields) {
      const std::uint32_t lowest = field.mask & (~field.mask + 1);
      text += fmt::format("| {} | {} | {} | {} | 0x{:X} | {} |\n", r.name, bits_text(field.mask),
                          field.name, field.access, (r.declared_reset & field.mask) / lowest,
                          cell(field.documentation));
    }
  }
  if (text.empty()) return text;
  return "\n| Register | Bits | Field | Access | Reset | What |\n|---|---|---|---|---|---|\n" +
         text;
}

/// Devices of one kind: the first represents all.
std::string registers(const std::vector<const HardwareMap::Device*>& kind) {
  std::vector<std::string> names;
  names.reserve(kind.size());
  for (const HardwareMap::Device* d : kind) {
    names.push_back(fmt::format("`{}` at {}", d->name, address(d->base)));
  }
  const HardwareMap::Device& first = *kind.front();
  std::string text = fmt::format("\n## {}\n\n{}.\n\n", first.what, vp::join(names, ", "));
  FieldsOnce shown;
  text += "| Offset | Register | Access | Reset | Writable | What |\n|---|---|---|---|---|---|\n";
  for (const HardwareMap::Register& r : first.registers) {
    const std::string start =
        r.at_start == r.reset ? "" : fmt::format("; {} at the start", address(r.at_start));
    const std::string as = shown.find(r).as;
    text += fmt::format("| 0x{:03X} | {} | {} | {} | {} | {}{}{} |\n", r.offset, r.name, r.access,
                        address(r.declared_reset), address(r.writable), cell(r.documentation),
                        as.empty() ? "" : "; bits as in " + as, start);
  }
  return text + fields(first);
}

}  // namespace

std::string map_as_markdown(const HardwareMap& map) {
  std::string text =
      head + devices(map) + blocks_without_model(map) + interrupts(map) + clocks(map);
  std::vector<const void*> done;
  for (const HardwareMap::Device& device : map.devices) {
    if (device.registers.empty() ||
        std::find(done.begin(), done.end(), device.description) != done.end()) {
      continue;
    }
    done.push_back(device.description);
    std::vector<const HardwareMap::Device*> kind;
    for (const HardwareMap::Device& other : map.devices) {
      if (other.description == device.description) kind.push_back(&other);
    }
    text += registers(kind);
  }
  return text;
}

namespace {

using facts::HardwareMap;

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

/// With the file that a Linux application finds it at.
void print_interrupts(const HardwareMap& map, device_tree::Node tree, std::ostream& out) {
  const std::vector<LinuxDevices::Uio> uios = LinuxDevices::make_uios(tree, {});
  const auto file = [&uios](std::uint32_t id) -> std::string {
    for (std::size_t i = 0; i < uios.size(); ++i) {
      if (uios[i].interrupt == id) return "/dev/uio" + std::to_string(i);
    }
    return {};
  };
  out << fmt::format("\n{:>9}  {:<32} {}\n", "interrupt", "raised by", "with --linux");
  for (const HardwareMap::Interrupt& i : map.interrupts) {
    const std::string linux_file = file(i.id);
    out << (linux_file.empty() ? fmt::format("{:>9}  {}\n", i.id, i.source)
                               : fmt::format("{:>9}  {:<32} {}\n", i.id, i.source, linux_file));
  }
}

void print_clocks(const HardwareMap& map, std::ostream& out) {
  out << fmt::format("\n{:<20} {:>16}  {}\n", "clock", "frequency", "set by");
  for (const HardwareMap::Clock& c : map.clocks) {
    const std::string note =
        c.programmed == c.hertz
            ? ""
            : " (now it gives " + frequency_text(c.programmed) + ": from the first write on)";
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
    out << (device.what.rfind("RTL ", 0) == 0
                ? "no file describes its registers: markervp_add_rtl(… REGISTERS file) names one\n"
                : "memory, no registers\n");
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

void print_overview(const HardwareMap& map, const device_tree::Node& tree, bool registers,
                    std::ostream& out) {
  print_devices(map, out);
  print_interrupts(map, tree, out);
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

namespace {

int draw_map(const MapOptions& options, std::ostream& out) {
  const std::string file = options.configuration.design.value_or("");
  if (!block_design::is_design_yaml(file))
    throw vp::InputError("--diagram draws a design in YAML: name it with --design FILE.yaml");
  block_design::write_diagram(block_design::read_design_file(file), options.diagram);
  out << "wrote " << options.diagram << "\n";
  return done;
}

int write_device_tree(const device_tree::Node& tree, const std::string& file, std::ostream& out) {
  const std::string text = "/dts-v1/;\n\n" + device_tree::text(tree);
  if (file.empty()) {
    out << text;
  } else {
    vp::write_file(file, text);
    out << "wrote " << file << "\n";
  }
  return done;
}

}  // namespace

int print_map(const MapOptions& options, std::ostream& out) {
  if (!options.diagram.empty()) return draw_map(options, out);
  vp::Configuration configuration;
  load_configuration(options.configuration, configuration);
  SimulationOptions asked;
  asked.is_only_shown = true;
  const auto simulation = build(configuration, asked);
  Zynq& zynq = simulation->zynq();
  if (options.device_tree) return write_device_tree(hardware_tree(zynq), *options.device_tree, out);
  const HardwareMap map = hardware_map(zynq);
  if (options.markdown) {
    out << map_as_markdown(map);
  } else if (options.xparameters) {
    out << map.xparameters;
  } else if (!options.device.empty()) {
    print_registers(find_device(map, options.device), out);
  } else {
    print_overview(map, hardware_tree(zynq), options.registers, out);
  }
  return done;
}

}  // namespace platform::cli
