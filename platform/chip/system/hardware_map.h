#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <chip/system/zynq.h>
#include <facts/result.h>

/// Writes xparameters.h from a memory map, in the names that Vivado exports.
namespace xparameters {

/// One device as its driver sees it.
struct Device {
  std::string name;    ///< of the instance in capitals: "AXI_GPIO_0"
  std::string driver;  ///< of the vendor's driver in capitals: "GPIO"; empty: it has none
  std::uint32_t base;
  std::uint32_t last;  ///< last address of its segment
  /// Build options: "IS_DUAL", 0.
  std::vector<std::pair<std::string, std::uint32_t>> options;
  /// Lines to the interrupt controller: "MM2S_INTROUT", 61.
  std::vector<std::pair<std::string, std::uint32_t>> interrupts;
};

struct Platform {
  std::uint64_t cpu_hz;
  std::uint64_t ps_clock_hz;
  std::uint32_t ddr_base;
  std::uint32_t ddr_last;
  /// Base addresses in the order of their numbers; the last is the console.
  std::vector<std::uint32_t> uarts;
  std::vector<Device> devices;  ///< those of one driver in the order of their numbers
};

/// The text of xparameters.h.
std::string header(const Platform& platform);

}  // namespace xparameters

namespace platform {

/// The map of the platform as it is built now.
facts::HardwareMap hardware_map(Zynq& zynq);

/// What a register holds: "axi_dma_0.MM2S_DMASR: 0x00000002 (Idle 1, all else 0)"; "" where no
/// register is.
std::string register_text(const facts::HardwareMap& map, std::uint32_t address,
                          std::uint32_t value);

/// The text of xparameters.h for the platform as it is configured: what Vivado would export for it.
std::string xparameters_header(Zynq& zynq);

/// Which registers the program used, and which of their bits, as a page of Markdown: a table a
/// device, then the registers that it never touched. Reads that a poll passed over count.
std::string register_coverage(Zynq& zynq);

}  // namespace platform
