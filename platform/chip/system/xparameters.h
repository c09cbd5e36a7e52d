#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <systemc>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

/// Writes xparameters.h as the vendor's tools do, in the names of both flows: the classic one, and
/// the one with a system device tree (SDT, releases from 2023.2 on).
namespace xparameters {

using Options = std::vector<std::pair<std::string, std::uint32_t>>;

/// A line of a device to an interrupt controller of the PL.
struct FabricInterrupt {
  std::string line;        ///< "IP2INTC_IRPT"
  std::string controller;  ///< its device: "AXI_INTC_0"
  unsigned number;         ///< of its input
};

inline bool operator==(const FabricInterrupt& a, const FabricInterrupt& b) {
  return std::tie(a.line, a.controller, a.number) == std::tie(b.line, b.controller, b.number);
}

/// One device of the PL as its driver sees it.
struct Device {
  std::string name;    ///< of the instance in capitals: "AXI_GPIO_0"
  std::string driver;  ///< of the vendor's driver in capitals: "GPIO"; empty: it has none
  std::uint32_t base;
  std::uint32_t last;  ///< last address of its segment
  /// Build options in the names of the classic flow: "IS_DUAL", 0.
  Options options;
  /// Lines to the interrupt controller: "MM2S_INTROUT", 61.
  std::vector<std::pair<std::string, std::uint32_t>> interrupts;
  /// Those of the SDT flow, where the tree has them.
  Options sdt_options = {};
  std::string compatible = {};  ///< "xlnx,axi-gpio-2.0"
  /// Lines to interrupt controllers of the PL.
  std::vector<FabricInterrupt> fabric_interrupts = {};
  std::string part = {};  ///< whose interrupts they are, in capitals; empty: `name`
};

inline bool operator==(const Device& a, const Device& b) {
  const auto all = [](const Device& d) {
    return std::tie(d.name, d.driver, d.base, d.last, d.options, d.interrupts, d.sdt_options,
                    d.compatible, d.fabric_interrupts);
  };
  return all(a) == all(b);
}

struct Platform {
  std::uint64_t cpu_hz;
  std::uint64_t ps_clock_hz;
  std::uint32_t ddr_base;
  std::uint32_t ddr_last;
  /// Base addresses in the order of their numbers; the last is the console.
  std::vector<std::uint32_t> uarts;
  std::vector<Device> devices;  ///< those of one driver in the order of their numbers
  std::string part = "7z020";   ///< as SDT names the device
};

inline bool operator==(const Platform& a, const Platform& b) {
  const auto all = [](const Platform& p) {
    return std::tie(p.cpu_hz, p.ps_clock_hz, p.ddr_base, p.ddr_last, p.uarts, p.devices, p.part);
  };
  return all(a) == all(b);
}

/// Fills in driver, compatible string and build options of a device of the PL, by its model; none
/// for one that the vendor has no driver for.
void add_build(Device& device, const sc_core::sc_object& module);

/// The text of xparameters.h.
std::string header(const Platform& platform);

/// What its lines give names without their XPAR_; of a name with several lines the first one's.
using Values = std::unordered_map<std::string, std::uint32_t>;
/// Those of the header. Points of a sweep ask for the same again and again: they are kept for the
/// last few platforms of the thread.
std::shared_ptr<const Values> values(const Platform& platform);

}  // namespace xparameters
