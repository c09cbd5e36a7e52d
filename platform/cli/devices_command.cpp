#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <ostream>

#include <cli/commands.h>
#include <cli/program.h>
#include <device/device.h>

namespace platform::cli {

namespace {

using device::Device;
using device::FigureInfo;

void print_table(std::ostream& out) {
  out << fmt::format("{:<10} {:>7} {:>7} {:>7} {:>4} {:>5} {:>11} {:>8} {:>8} {:>8} {:>5} {:>7}\n",
                     "device", "LUT", "FF", "BRAM36", "DSP", "cores", "CPU, MHz", "DDR, MHz",
                     "FCLK,MHz", "VCO, MHz", "Fmax", "static");
  for (const Device& d : device::devices()) {
    out << fmt::format(
        "{:<10} {:>7} {:>7} {:>7} {:>4} {:>5} {:>11} {:>8.0f} {:>8.0f} {:>8.0f} {:>5} {:>5.0f}mW\n",
        d.name(), d.lut.value, d.ff.value, d.bram36.value, d.dsp.value, d.cores.value,
        fmt::format("{:.0f} / {:.0f}", d.cpu_621_mhz.value, d.cpu_421_mhz.value), d.ddr_mhz.value,
        d.fclk_mhz.value, d.vco_max_mhz.value, fmt::format("x{:.2f}", d.fmax_factor.value),
        1000 * d.static_w.value);
  }
  out << "\nClocks are the highest of the speed grade; CPU by ratio, 6:2:1 / 4:2:1; static power "
         "at "
         "25 C.\n'markervp devices DEVICE' has every figure with its source, '--set "
         "device=DEVICE' uses one.\n";
}

void print_device(const Device& device, std::ostream& out) {
  out << fmt::format("{}, IDCODE 0x{:08X}\n\n", device.name(), device.idcode());
  for (const FigureInfo& info : device::figures()) {
    const device::Figure& figure = device.*info.figure;
    out << fmt::format("{:<16} {:>11}  {:<9}  {}\n{:31}{}\n", info.name,
                       fmt::format("{:.10g} {}", figure.value, info.unit),
                       to_string(figure.confidence), info.documentation, "", figure.source);
  }
}

nlohmann::ordered_json as_json(const Device& device) {
  nlohmann::ordered_json json;
  json["name"] = device.name();
  json["part"] = device.part;
  json["grade"] = device.grade;
  for (const FigureInfo& info : device::figures()) {
    const device::Figure& figure = device.*info.figure;
    json[info.name] = {{"value", figure.value},
                       {"unit", info.unit},
                       {"confidence", to_string(figure.confidence)},
                       {"source", figure.source}};
  }
  return json;
}

}  // namespace

int list_devices(const DevicesOptions& options, std::ostream& out) {
  if (options.json) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    if (options.device.empty()) {
      for (const Device& device : device::devices()) list.push_back(as_json(device));
    } else {
      list.push_back(as_json(device::find_device(options.device)));
    }
    out << list.dump(2) << "\n";
  } else if (options.device.empty()) {
    print_table(out);
  } else {
    print_device(device::find_device(options.device), out);
  }
  return done;
}

}  // namespace platform::cli
