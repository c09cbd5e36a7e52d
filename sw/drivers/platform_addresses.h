#pragma once

#include <hal/hal.h>
#include <xparameters.h>

#include <cstdint>

/// Where the devices of the marker system are. Not before the program runs.
namespace drivers::addresses {

/// AXI GPIO 0: control packet, outputs.
inline std::uint32_t gpio_control() {
  return HAL_XPAR(AXI_GPIO_0_BASEADDR);
}
/// AXI GPIO 1: feature words, inputs.
inline std::uint32_t gpio_features() {
  return HAL_XPAR(AXI_GPIO_1_BASEADDR);
}
/// AXI DMA 0: MM2S, images to the PL.
inline std::uint32_t dma_image() {
  return HAL_XPAR(AXI_DMA_0_BASEADDR);
}
inline std::uint32_t dma_image_interrupt() {
  return HAL_XPAR(FABRIC_AXI_DMA_0_MM2S_INTROUT_INTR);
}
/// AXI DMA 1: S2MM, binary images to DDR.
inline std::uint32_t dma_binary() {
  return HAL_XPAR(AXI_DMA_1_BASEADDR);
}
inline std::uint32_t dma_binary_interrupt() {
  return HAL_XPAR(FABRIC_AXI_DMA_1_S2MM_INTROUT_INTR);
}

}  // namespace drivers::addresses
