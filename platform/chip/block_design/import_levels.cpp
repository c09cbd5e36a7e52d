#include <chip/block_design/import_levels.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>

#include <vp/text.h>
#include <vp/unit.h>

namespace platform::block_design {

namespace {

using handoff::Handoff;
using handoff::Module;
using handoff::Netlist;
using handoff::Pin;
using handoff::Port;

/// How names of resets that are active at 0 end.
constexpr const char* low_ends[] = {"resetn", "rstn", "rst_n", "reset_n", "rst_ni"};

bool is_named_low(const std::string& name) {
  const std::string low = vp::lower(name);
  return std::any_of(std::begin(low_ends), std::end(low_ends),
                     [&](const char* end) { return vp::ends_with(low, end); });
}

/// Through inverters, this many.
constexpr unsigned most_inverters = 8;

std::optional<bool> level_of(const Netlist& nets, const Pin& driver, unsigned inverters) {
  if (!driver.module) return std::nullopt;
  const std::string ip = driver.module->ip();
  const bool is_source = ip == "proc_sys_reset" || ip == "processing_system7";
  if (is_source) {
    const std::string name = vp::lower(driver.port->name);
    if (is_named_low(name) || vp::ends_with(name, "_n")) return true;  // FCLK_RESET0_N
    return vp::ends_with(name, "reset") ? std::optional<bool>(false) : std::nullopt;
  }
  const bool inverts = ip == "util_vector_logic" &&
                       handoff::parameter(driver.module->parameters, "C_OPERATION") == "not";
  const Port* input = inverts ? driver.module->port("Op1") : nullptr;
  const auto source = input ? nets.driver(*input) : std::nullopt;
  if (!source || inverters == 0) return std::nullopt;
  const auto level = level_of(nets, *source, inverters - 1);
  return level ? std::optional<bool>(!*level) : std::nullopt;
}

/// Of the inputs of a processor system reset.
bool takes_low(const Module& reset, const std::string& pin) {
  const char* parameter = pin == "ext_reset_in" ? "C_EXT_RESET_HIGH" : "C_AUX_RESET_HIGH";
  const bool is_reset = pin == "ext_reset_in" || pin == "aux_reset_in";
  return is_reset && handoff::parameter(reset.parameters, parameter) == "0";
}

bool has_attribute(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  return vp::lower(text).find("polarity") != std::string::npos;
}

}  // namespace

std::optional<bool> resets_low(const Netlist& nets, const Pin& driver) {
  return level_of(nets, driver, most_inverters);
}

bool leaves_level_open(const Port& port, const std::vector<std::string>& sources) {
  if (port.kind != "rst" || port.direction != 'I' || port.active_high) return false;
  if (is_named_low(port.name) || vp::lower(port.name) == "ap_rst") return false;
  return std::none_of(sources.begin(), sources.end(), has_attribute);
}

// Where the design's edge says low, the vendor's tools mean that nothing was said: what is behind
// the pin decides.
bool idles_high(const Handoff& handoff, const Port& external) {
  if (external.kind != "rst" || external.width != 1) return false;
  for (const Module& module : handoff.modules) {
    for (const Port& port : module.ports) {
      if (port.direction != 'I' || port.signal != external.signal) continue;
      const bool is_low_at = module.ip() == "proc_sys_reset" && takes_low(module, port.name);
      if (is_low_at || is_named_low(port.name)) return true;
    }
  }
  return false;
}

std::map<std::string, double> clock_wishes(const Handoff& handoff) {
  std::map<std::string, double> wishes;
  for (const Module& module : handoff.modules) {
    for (const Port& port : module.ports) {
      if (port.direction != 'I' || port.signal.empty()) continue;
      if (port.kind == "clk" && port.hz) wishes.emplace(port.signal, *port.hz);
      if (module.ip() != "clk_wiz" || port.name != "clk_in1") continue;
      const auto mhz = vp::Decimal::parse(handoff::parameter(module.parameters, "PRIM_IN_FREQ"));
      if (mhz) wishes.emplace(port.signal, mhz->to_double() * 1e6);
    }
  }
  return wishes;
}

}  // namespace platform::block_design
