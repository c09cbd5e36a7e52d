#pragma once

#include <gic_registers.h>

#include <cstdint>

/// Where the devices of the marker system are: what Vivado would export for it.
namespace drivers::addresses {

inline constexpr std::uint32_t gpio_control = 0x4120'0000;  ///< AXI GPIO 0: control packet, outputs
inline constexpr std::uint32_t gpio_features = 0x4121'0000;  ///< AXI GPIO 1: feature words, inputs
inline constexpr std::uint32_t dma_image = 0x4040'0000;      ///< AXI DMA 0: MM2S, images to the PL
inline constexpr std::uint32_t dma_binary = 0x4041'0000;  ///< AXI DMA 1: S2MM, binary images to DDR

inline constexpr std::uint32_t dma_image_interrupt = gic::irq_f2p_0_id;       ///< IRQ_F2P[0]
inline constexpr std::uint32_t dma_binary_interrupt = gic::irq_f2p_0_id + 1;  ///< IRQ_F2P[1]

}  // namespace drivers::addresses
