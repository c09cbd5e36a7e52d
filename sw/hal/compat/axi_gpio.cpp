// xgpio.h.
#include <axi_gpio_registers.h>
#include <hal/hal.h>
#include <xgpio.h>

#include "device_tables.h"

namespace {

std::uint32_t read(const XGpio* instance, std::uint32_t offset) {
  return hal_read32(static_cast<std::uint32_t>(instance->BaseAddress) + offset);
}

void write(const XGpio* instance, std::uint32_t offset, std::uint32_t word) {
  hal_write32(static_cast<std::uint32_t>(instance->BaseAddress) + offset, word);
}

std::uint32_t data_of(const XGpio* instance, unsigned channel) {
  return static_cast<std::uint32_t>(instance->BaseAddress) +
         (channel == 2 ? axi_gpio::GPIO2_DATA : axi_gpio::GPIO_DATA);
}

std::uint32_t direction_of(const XGpio* instance, unsigned channel) {
  return static_cast<std::uint32_t>(instance->BaseAddress) +
         (channel == 2 ? axi_gpio::GPIO2_TRI : axi_gpio::GPIO_TRI);
}

#define MARKERVP_AXI_GPIO(number)                                                  \
  {                                                                                \
    number, MARKERVP_XPAR(GPIO_##number##_BASEADDR, 0),                            \
        static_cast<int>(MARKERVP_XPAR(GPIO_##number##_INTERRUPT_PRESENT, 0)),     \
        static_cast<int>(MARKERVP_XPAR(GPIO_##number##_IS_DUAL, 0)),               \
        MARKERVP_XPAR(XGPIO_##number##_INTERRUPTS, markervp_compat::no_interrupt), \
        XPAR_XSCUGIC_0_BASEADDR,                                                   \
  }

}  // namespace

extern "C" {

XGpio_Config* XGpio_LookupConfig(UINTPTR DeviceId) {
  static XGpio_Config configs[] = MARKERVP_EACH_DEVICE(MARKERVP_AXI_GPIO);
  static const unsigned count = markervp_compat::devices(MARKERVP_XPAR(XGPIO_NUM_INSTANCES, 0));
  for (unsigned n = 0; n < count; ++n) {
    if (DeviceId == n || DeviceId == configs[n].BaseAddress) return &configs[n];
  }
  return nullptr;
}

int XGpio_CfgInitialize(XGpio* InstancePtr, XGpio_Config* Config, UINTPTR EffectiveAddr) {
  InstancePtr->BaseAddress = EffectiveAddr;
  InstancePtr->InterruptPresent = Config->InterruptPresent;
  InstancePtr->IsDual = Config->IsDual;
  InstancePtr->IsReady = XIL_COMPONENT_IS_READY;
  return XST_SUCCESS;
}

int XGpio_Initialize(XGpio* InstancePtr, UINTPTR DeviceId) {
  XGpio_Config* config = XGpio_LookupConfig(DeviceId);
  if (config == nullptr) return XST_DEVICE_NOT_FOUND;
  return XGpio_CfgInitialize(InstancePtr, config, config->BaseAddress);
}

int XGpio_SelfTest(XGpio* InstancePtr) {
  return InstancePtr->IsReady == XIL_COMPONENT_IS_READY ? XST_SUCCESS : XST_FAILURE;
}

void XGpio_SetDataDirection(XGpio* InstancePtr, unsigned Channel, u32 DirectionMask) {
  hal_write32(direction_of(InstancePtr, Channel), DirectionMask);
}

u32 XGpio_GetDataDirection(XGpio* InstancePtr, unsigned Channel) {
  return hal_read32(direction_of(InstancePtr, Channel));
}

u32 XGpio_DiscreteRead(XGpio* InstancePtr, unsigned Channel) {
  return hal_read32(data_of(InstancePtr, Channel));
}

void XGpio_DiscreteWrite(XGpio* InstancePtr, unsigned Channel, u32 Mask) {
  hal_write32(data_of(InstancePtr, Channel), Mask);
}

void XGpio_DiscreteSet(XGpio* InstancePtr, unsigned Channel, u32 Mask) {
  XGpio_DiscreteWrite(InstancePtr, Channel, XGpio_DiscreteRead(InstancePtr, Channel) | Mask);
}

void XGpio_DiscreteClear(XGpio* InstancePtr, unsigned Channel, u32 Mask) {
  XGpio_DiscreteWrite(InstancePtr, Channel, XGpio_DiscreteRead(InstancePtr, Channel) & ~Mask);
}

void XGpio_InterruptGlobalEnable(XGpio* InstancePtr) {
  write(InstancePtr, axi_gpio::GIER, axi_gpio::gier::Global_Interrupt_Enable);
}

void XGpio_InterruptGlobalDisable(XGpio* InstancePtr) {
  write(InstancePtr, axi_gpio::GIER, 0);
}

void XGpio_InterruptEnable(XGpio* InstancePtr, u32 Mask) {
  write(InstancePtr, axi_gpio::IP_IER, read(InstancePtr, axi_gpio::IP_IER) | Mask);
}

void XGpio_InterruptDisable(XGpio* InstancePtr, u32 Mask) {
  write(InstancePtr, axi_gpio::IP_IER, read(InstancePtr, axi_gpio::IP_IER) & ~Mask);
}

// A 1 toggles the bit: only those that are set are written.
void XGpio_InterruptClear(XGpio* InstancePtr, u32 Mask) {
  write(InstancePtr, axi_gpio::IP_ISR, read(InstancePtr, axi_gpio::IP_ISR) & Mask);
}

u32 XGpio_InterruptGetEnabled(XGpio* InstancePtr) {
  return read(InstancePtr, axi_gpio::IP_IER);
}

u32 XGpio_InterruptGetStatus(XGpio* InstancePtr) {
  return read(InstancePtr, axi_gpio::IP_ISR);
}

}  // extern "C"
