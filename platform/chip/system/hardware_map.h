#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <chip/handoff/device_tree.h>
#include <chip/system/xparameters.h>
#include <chip/system/zynq.h>
#include <facts/result.h>

namespace platform {

/// The map of the platform as it is built now.
facts::HardwareMap hardware_map(Zynq& zynq);

/// The device tree that Linux would have of the platform as it is built now. The devices of the
/// programmable logic are below `amba_pl`.
device_tree::Node hardware_tree(Zynq& zynq);

/// The lines of a module that interrupt controllers of the PL take.
std::vector<xparameters::FabricInterrupt> fabric_interrupts(Zynq& zynq,
                                                            const sc_core::sc_object& module);

/// What a register holds: "axi_dma_0.MM2S_DMASR: 0x00000002 (Idle 1, all else 0)"; "" where no
/// register is.
std::string register_text(const facts::HardwareMap& map, std::uint32_t address,
                          std::uint32_t value);

/// The text of xparameters.h for the platform as it is configured: what Vivado would export for it.
std::string xparameters_header(Zynq& zynq);
/// What programs ask of it by name.
std::shared_ptr<const xparameters::Values> xparameters_values(Zynq& zynq);

/// Which registers the program used, and which of their bits, as a page of Markdown: a table a
/// device, then the registers that it never touched. Reads that a poll passed over count.
std::string register_coverage(Zynq& zynq);

}  // namespace platform
