#pragma once

// What the drivers know of AXI GPIO and AXI DMA: the values of xparameters.h under the driver's
// names, whatever the instances are called. A design may have more devices than the header that
// this library was built with; their values come from the platform (HAL_XPAR), and those here stand
// where there is no such device.

#include <hal/hal.h>
#include <xparameters.h>

namespace markervp_compat {

/// How many devices of a driver are looked up: four at most.
inline unsigned devices(std::uint32_t instances) {
  return instances < 4 ? instances : 4;
}

}  // namespace markervp_compat

#ifndef XPAR_GPIO_0_BASEADDR
#define XPAR_GPIO_0_BASEADDR 0
#define XPAR_GPIO_0_INTERRUPT_PRESENT 0
#define XPAR_GPIO_0_IS_DUAL 0
#endif
#ifndef XPAR_GPIO_1_BASEADDR
#define XPAR_GPIO_1_BASEADDR 0
#define XPAR_GPIO_1_INTERRUPT_PRESENT 0
#define XPAR_GPIO_1_IS_DUAL 0
#endif
#ifndef XPAR_GPIO_2_BASEADDR
#define XPAR_GPIO_2_BASEADDR 0
#define XPAR_GPIO_2_INTERRUPT_PRESENT 0
#define XPAR_GPIO_2_IS_DUAL 0
#endif
#ifndef XPAR_GPIO_3_BASEADDR
#define XPAR_GPIO_3_BASEADDR 0
#define XPAR_GPIO_3_INTERRUPT_PRESENT 0
#define XPAR_GPIO_3_IS_DUAL 0
#endif

#ifndef XPAR_AXIDMA_0_BASEADDR
#define XPAR_AXIDMA_0_BASEADDR 0
#define XPAR_AXIDMA_0_INCLUDE_MM2S 0
#define XPAR_AXIDMA_0_INCLUDE_S2MM 0
#define XPAR_AXIDMA_0_INCLUDE_SG 0
#define XPAR_AXIDMA_0_SG_LENGTH_WIDTH 14
#define XPAR_AXIDMA_0_M_AXI_MM2S_DATA_WIDTH 32
#define XPAR_AXIDMA_0_M_AXI_S2MM_DATA_WIDTH 32
#endif
#ifndef XPAR_AXIDMA_1_BASEADDR
#define XPAR_AXIDMA_1_BASEADDR 0
#define XPAR_AXIDMA_1_INCLUDE_MM2S 0
#define XPAR_AXIDMA_1_INCLUDE_S2MM 0
#define XPAR_AXIDMA_1_INCLUDE_SG 0
#define XPAR_AXIDMA_1_SG_LENGTH_WIDTH 14
#define XPAR_AXIDMA_1_M_AXI_MM2S_DATA_WIDTH 32
#define XPAR_AXIDMA_1_M_AXI_S2MM_DATA_WIDTH 32
#endif
#ifndef XPAR_AXIDMA_2_BASEADDR
#define XPAR_AXIDMA_2_BASEADDR 0
#define XPAR_AXIDMA_2_INCLUDE_MM2S 0
#define XPAR_AXIDMA_2_INCLUDE_S2MM 0
#define XPAR_AXIDMA_2_INCLUDE_SG 0
#define XPAR_AXIDMA_2_SG_LENGTH_WIDTH 14
#define XPAR_AXIDMA_2_M_AXI_MM2S_DATA_WIDTH 32
#define XPAR_AXIDMA_2_M_AXI_S2MM_DATA_WIDTH 32
#endif
#ifndef XPAR_AXIDMA_3_BASEADDR
#define XPAR_AXIDMA_3_BASEADDR 0
#define XPAR_AXIDMA_3_INCLUDE_MM2S 0
#define XPAR_AXIDMA_3_INCLUDE_S2MM 0
#define XPAR_AXIDMA_3_INCLUDE_SG 0
#define XPAR_AXIDMA_3_SG_LENGTH_WIDTH 14
#define XPAR_AXIDMA_3_M_AXI_MM2S_DATA_WIDTH 32
#define XPAR_AXIDMA_3_M_AXI_S2MM_DATA_WIDTH 32
#endif

// A device without interrupts has the number that the vendor's tables have then.
#ifndef XPAR_XGPIO_0_INTERRUPTS
#define XPAR_XGPIO_0_INTERRUPTS 0xFFFF
#endif
#ifndef XPAR_XGPIO_1_INTERRUPTS
#define XPAR_XGPIO_1_INTERRUPTS 0xFFFF
#endif
#ifndef XPAR_XGPIO_2_INTERRUPTS
#define XPAR_XGPIO_2_INTERRUPTS 0xFFFF
#endif
#ifndef XPAR_XGPIO_3_INTERRUPTS
#define XPAR_XGPIO_3_INTERRUPTS 0xFFFF
#endif
#ifndef XPAR_XAXIDMA_0_INTERRUPTS
#define XPAR_XAXIDMA_0_INTERRUPTS 0xFFFF
#endif
#ifndef XPAR_XAXIDMA_1_INTERRUPTS
#define XPAR_XAXIDMA_1_INTERRUPTS 0xFFFF
#endif
#ifndef XPAR_XAXIDMA_2_INTERRUPTS
#define XPAR_XAXIDMA_2_INTERRUPTS 0xFFFF
#endif
#ifndef XPAR_XAXIDMA_3_INTERRUPTS
#define XPAR_XAXIDMA_3_INTERRUPTS 0xFFFF
#endif
#ifndef XPAR_XAXIDMA_0_INTERRUPTS_1
#define XPAR_XAXIDMA_0_INTERRUPTS_1 0xFFFF
#endif
#ifndef XPAR_XAXIDMA_1_INTERRUPTS_1
#define XPAR_XAXIDMA_1_INTERRUPTS_1 0xFFFF
#endif
#ifndef XPAR_XAXIDMA_2_INTERRUPTS_1
#define XPAR_XAXIDMA_2_INTERRUPTS_1 0xFFFF
#endif
#ifndef XPAR_XAXIDMA_3_INTERRUPTS_1
#define XPAR_XAXIDMA_3_INTERRUPTS_1 0xFFFF
#endif

#ifndef XPAR_XGPIO_NUM_INSTANCES
#define XPAR_XGPIO_NUM_INSTANCES 0
#endif
#ifndef XPAR_XAXIDMA_NUM_INSTANCES
#define XPAR_XAXIDMA_NUM_INSTANCES 0
#endif
