#include <chip/system/xparameters.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <map>

#include <chip/system/xparameters_text.h>
#include <gic_registers.h>

namespace xparameters {

namespace {

std::string digits(const char* format, std::uint32_t value) {
  char text[16];
  std::snprintf(text, sizeof text, format, static_cast<unsigned>(value));
  return text;
}

constexpr const char* beginning =
    "#ifndef XPARAMETERS_H\n"
    "#define XPARAMETERS_H\n"
    "\n"
    "/*\n"
    " * Written from the memory map of the platform: what Vivado would export for it. A test "
    "holds\n"
    " * the two together. Names without a condition are those of both flows.\n"
    " */\n";

/// The drivers of the PL whose interrupts have another name than their other values.
std::string interrupt_driver(const std::string& driver) {
  return driver == "AXI_FIFO" ? "LLFIFO" : driver;
}

/// The name that SDT makes of the driver's folder.
std::string sdt_driver(const std::string& driver) {
  return "X" + interrupt_driver(driver);
}

/// An interrupt controller of the PL, for the lines that it takes.
struct Controller {
  unsigned number;  ///< among those of its driver
  std::uint32_t base;
};
using Controllers = std::map<std::string, Controller>;

/// "AXI_INTC_0_AXI_GPIO_0_IP2INTC_IRPT_INTR", and the driver's name for it.
void define_behind_controllers(Section& out, const Device& device, unsigned number,
                               const Controllers& controllers) {
  for (const FabricInterrupt& interrupt : device.fabric_interrupts) {
    const auto controller = controllers.find(interrupt.controller);
    if (controller == controllers.end()) continue;
    const std::string end = device.name + "_" + interrupt.line;
    out.number(Section::classic, interrupt.controller + "_" + end + "_INTR", interrupt.number);
    out.address(Section::classic, end + "_MASK", 1u << interrupt.number);
    if (device.driver.empty()) continue;
    const std::string driver = "INTC_" + std::to_string(controller->second.number) + "_" +
                               interrupt_driver(device.driver) + "_" + std::to_string(number);
    const bool is_only = device.fabric_interrupts.size() == 1;
    out.number(Section::classic, driver + (is_only ? "" : "_" + interrupt.line) + "_VEC_ID",
               interrupt.number);
  }
}

void define_classic(Section& out, const Device& device, unsigned number) {
  const bool has_driver = !device.driver.empty();
  std::vector<std::string> names{device.name};
  if (has_driver) names.push_back(device.driver + "_" + std::to_string(number));
  for (const std::string& name : names) {
    if (has_driver) out.number(Section::classic, name + "_DEVICE_ID", number);
    out.address(Section::classic, name + "_BASEADDR", device.base);
    out.address(Section::classic, name + "_HIGHADDR", device.last);
    for (const auto& [option, value] : device.options)
      out.number(Section::classic, name + "_" + option, value);
  }
  for (const auto& [line, id] : device.interrupts)
    out.number(Section::classic,
               "FABRIC_" + (device.part.empty() ? device.name : device.part) + "_" + line + "_INTR",
               id);
  if (!has_driver) return;
  const std::string fabric =
      "FABRIC_" + interrupt_driver(device.driver) + "_" + std::to_string(number);
  for (const auto& [line, id] : device.interrupts)
    out.number(Section::classic, fabric + "_" + line + "_VEC_ID", id);
  if (device.interrupts.size() == 1)
    out.number(Section::classic, fabric + "_VEC_ID", device.interrupts.front().second);
}

/// Under the label and, but for what only the label has, under the driver's name.
void define_sdt(Section& out, const Device& device, unsigned number) {
  std::vector<std::string> names{device.name};
  if (!device.driver.empty())
    names.push_back(sdt_driver(device.driver) + "_" + std::to_string(number));
  for (const std::string& name : names) {
    out.address(Section::sdt, name + "_BASEADDR", device.base);
    out.address(Section::sdt, name + "_HIGHADDR", device.last);
    if (!device.compatible.empty())
      out.words(Section::sdt, name + "_COMPATIBLE", device.compatible);
    for (const auto& [option, value] : device.sdt_options)
      out.hex(Section::sdt, name + "_" + option, value);
    for (std::size_t n = 0; n < device.interrupts.size(); ++n) {
      const std::uint32_t id = device.interrupts[n].second;
      const std::string end = n == 0 ? "" : "_" + std::to_string(n);
      const bool is_asked_for = n == 0 || name == device.name;
      out.hex(is_asked_for ? Section::sdt : Section::library, name + "_INTERRUPTS" + end,
              sdt_interrupt(id));
      if (!is_asked_for || id < gic::first_spi) continue;
      out.number(Section::sdt, "FABRIC_" + name + "_INTR" + end, id - gic::first_spi);
    }
    if (!device.interrupts.empty())
      out.address(Section::sdt, name + "_INTERRUPT_PARENT", gic::distributor_base);
  }
}

/// The lowest bit of a controller's address says that it is one of the PL.
void define_sdt_behind_controllers(Section& out, const Device& device, unsigned number,
                                   const Controllers& controllers) {
  constexpr std::uint32_t is_in_the_logic = 1;
  if (device.fabric_interrupts.empty() || device.driver.empty()) return;
  for (const std::string& name :
       {device.name, sdt_driver(device.driver) + "_" + std::to_string(number)}) {
    for (std::size_t n = 0; n < device.fabric_interrupts.size(); ++n) {
      const std::string end = n == 0 ? "" : "_" + std::to_string(n);
      const unsigned input = device.fabric_interrupts[n].number;
      out.hex(Section::sdt, name + "_INTERRUPTS" + end, input);
      out.number(Section::sdt, "FABRIC_" + name + "_INTR" + end, input);
    }
    const auto controller = controllers.find(device.fabric_interrupts.front().controller);
    if (controller != controllers.end())
      out.address(Section::sdt, name + "_INTERRUPT_PARENT",
                  controller->second.base | is_in_the_logic);
  }
}

}  // namespace

// Both flows may write one number in different ways.
void Section::add(Flow flow, const std::string& name, const std::string& value) {
  char* end = nullptr;
  const unsigned long long number = std::strtoull(value.c_str(), &end, 0);
  const std::string key = name + ' ' + (end == value.c_str() ? value : std::to_string(number));
  const auto [place, is_new] = by_text_.try_emplace(key, lines_.size());
  if (is_new) {
    lines_.push_back({name, value, flow});
  } else {
    lines_[place->second].flows |= flow;
  }
}

void Section::number(Flow flow, const std::string& name, std::uint64_t value) {
  add(flow, "XPAR_" + name, std::to_string(value));
}

void Section::hex(Flow flow, const std::string& name, std::uint32_t value) {
  add(flow, "XPAR_" + name, digits("0x%x", value));
}

void Section::address(Flow flow, const std::string& name, std::uint32_t value) {
  add(flow, "XPAR_" + name, digits("0x%08XU", value));
}

void Section::words(Flow flow, const std::string& name, const std::string& text) {
  add(flow, "XPAR_" + name, '"' + text + '"');
}

void Section::plain(Flow flow, const std::string& name, const std::string& value) {
  add(flow, name, value);
}

std::string Section::lines_of(unsigned flows, bool interrupts) const {
  std::string text;
  for (const Line& line : lines_) {
    const bool is_interrupt = line.name.find("_INTERRUPT") != std::string::npos;
    if (line.flows != flows || (flows == sdt && is_interrupt != interrupts)) continue;
    text += "#define " + line.name + (line.value.empty() ? "" : " " + line.value) + "\n";
  }
  return text;
}

// The compatibility layer's own sources are those of both flows: they know interrupts as SDT does.
std::string Section::text() const {
  std::string text = "\n/* " + title_ + " */\n" + lines_of(both);
  const auto add_if = [&text](const char* condition, const std::string& lines) {
    if (!lines.empty()) text += std::string(condition) + "\n" + lines + "#endif\n";
  };
  add_if("#ifndef SDT", lines_of(classic));
  add_if("#ifdef SDT", lines_of(sdt, false));
  add_if("#if defined SDT || defined MARKERVP_BOTH_FLOWS", lines_of(sdt, true));
  add_if("#ifdef MARKERVP_BOTH_FLOWS", lines_of(library));
  return text;
}

namespace {

std::string clocks_and_memory(const Platform& platform) {
  Section out("Processor and memory");
  for (const char* name : {"CPU_CORTEXA9_CORE_CLOCK_FREQ_HZ", "CPU_CORTEXA9_0_CPU_CLK_FREQ_HZ",
                           "PS7_CORTEXA9_0_CPU_CLK_FREQ_HZ"})
    out.number(Section::classic, name, platform.cpu_hz);
  out.number(Section::sdt, "CPU_CORE_CLOCK_FREQ_HZ", platform.cpu_hz);
  // The compatibility layer's timers count by it in both flows.
  out.number(Section::sdt, "CPU_CORTEXA9_CORE_CLOCK_FREQ_HZ", platform.cpu_hz);
  out.number(Section::both, "PS7_CRYSTAL_FREQ_HZ", platform.ps_clock_hz);
  out.words(Section::sdt, "DEVICE_ID", platform.part);
  out.address(Section::classic, "PS7_DDR_0_S_AXI_BASEADDR", platform.ddr_base);
  out.address(Section::classic, "PS7_DDR_0_S_AXI_HIGHADDR", platform.ddr_last);
  out.address(Section::sdt, "PS7_DDR_0_BASEADDRESS", platform.ddr_base);
  out.address(Section::sdt, "PS7_DDR_0_HIGHADDRESS", platform.ddr_last);
  out.plain(Section::classic, "PLATFORM_ZYNQ", "");
  out.plain(Section::classic, "XSLEEP_TIMER_IS_DEFAULT_TIMER", "");
  return out.text();
}

/// What the driver of interrupt controllers of the PL takes of all of them.
std::string controllers_in_common(const Platform& platform) {
  std::uint32_t most = 0;
  for (const Device& device : platform.devices) {
    for (const auto& [option, value] : device.options)
      if (option == "NUM_INTR_INPUTS") most = std::max(most, value);
  }
  if (most == 0) return {};
  Section out("Interrupt controllers of the PL");
  out.number(Section::both, "INTC_MAX_NUM_INTR_INPUTS", most);
  for (const char* name : {"IPR", "SIE", "CIE", "IVR"})
    out.number(Section::both, std::string("XINTC_HAS_") + name, 1);
  return out.text();
}

std::string console(const Platform& platform) {
  if (platform.uarts.empty()) return {};
  Section out("Console");
  const std::string at = digits("0x%08XU", platform.uarts.back());
  out.plain(Section::both, "STDIN_BASEADDRESS", at);
  out.plain(Section::both, "STDOUT_BASEADDRESS", at);
  return out.text();
}

}  // namespace

std::string header(const Platform& platform) {
  std::string text = beginning + clocks_and_memory(platform) +
                     processing_system(platform.cpu_hz, platform.uarts) +
                     "#include <xparameters_ps.h>\n";
  Controllers controllers;
  for (const Device& device : platform.devices) {
    if (device.driver == "INTC")
      controllers.emplace(device.name,
                          Controller{static_cast<unsigned>(controllers.size()), device.base});
  }
  std::map<std::string, unsigned> numbers;
  for (const Device& device : platform.devices) {
    Section out(device.name);
    const unsigned number = numbers[device.driver]++;
    define_classic(out, device, number);
    define_behind_controllers(out, device, number, controllers);
    define_sdt(out, device, number);
    if (device.interrupts.empty()) define_sdt_behind_controllers(out, device, number, controllers);
    text += out.text();
  }
  Section counts("How many a driver has");
  for (const auto& [driver, count] : numbers) {
    if (!driver.empty()) counts.number(Section::both, sdt_driver(driver) + "_NUM_INSTANCES", count);
  }
  return text + counts.text() + controllers_in_common(platform) + console(platform) + "\n#endif\n";
}

namespace {

Values values_in(const std::string& text) {
  const std::string start = "#define XPAR_";
  Values values;
  for (std::size_t at = text.find(start); at != text.npos; at = text.find(start, at)) {
    at += start.size();
    const std::size_t end = text.find_first_of(" \n", at);
    if (end == text.npos || text[end] == '\n') continue;  // it has no value
    const unsigned long value = std::strtoul(text.c_str() + end, nullptr, 0);
    values.try_emplace(text.substr(at, end - at), static_cast<std::uint32_t>(value));
  }
  return values;
}

}  // namespace

std::shared_ptr<const Values> values(const Platform& platform) {
  constexpr std::size_t most_kept = 16;
  thread_local std::vector<std::pair<Platform, std::shared_ptr<const Values>>> kept;
  for (const auto& [known, found] : kept) {
    if (known == platform) return found;
  }
  if (kept.size() == most_kept) kept.erase(kept.begin());
  kept.emplace_back(platform, std::make_shared<const Values>(values_in(header(platform))));
  return kept.back().second;
}

}  // namespace xparameters
