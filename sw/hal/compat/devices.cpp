// xaxidma.h.
#include <axi_dma_registers.h>
#include <axi_gpio_registers.h>
#include <hal/hal.h>
#include <xaxidma.h>
#include <xgpio.h>

namespace {

/// The register of one channel: S2MM's are MM2S's, further up.
std::uint32_t at(const XAxiDma* instance, std::uint32_t mm2s_offset, int direction) {
  const std::uint32_t channel =
      direction == XAXIDMA_DEVICE_TO_DMA ? axi_dma::S2MM_DMACR - axi_dma::MM2S_DMACR : 0;
  return static_cast<std::uint32_t>(instance->RegBase) + mm2s_offset + channel;
}

bool has_channel(const XAxiDma* instance, int direction) {
  return direction == XAXIDMA_DEVICE_TO_DMA ? instance->HasS2Mm != 0 : instance->HasMm2S != 0;
}

/// A bus address has 32 bits; a buffer elsewhere exists on the virtual platform only.
constexpr UINTPTR last_bus_address = 0xFFFF'FFFF;

bool is_possible(const XAxiDma* instance, UINTPTR address, u32 length, int direction) {
  return has_channel(instance, direction) && length > 0 && length <= instance->MaxTransferLen &&
         address <= last_bus_address && address % instance->Alignment == 0;
}

constexpr unsigned reset_polls = 500;

}  // namespace

extern "C" {

XAxiDma_Config* XAxiDma_LookupConfig(u32 DeviceId) {
  static XAxiDma_Config configs[] = {
      {XPAR_AXI_DMA_0_DEVICE_ID, HAL_XPAR(AXI_DMA_0_BASEADDR),
       static_cast<int>(HAL_XPAR(AXI_DMA_0_INCLUDE_MM2S)),
       static_cast<int>(HAL_XPAR(AXI_DMA_0_INCLUDE_S2MM)), HAL_XPAR(AXI_DMA_0_SG_LENGTH_WIDTH),
       HAL_XPAR(AXI_DMA_0_M_AXI_MM2S_DATA_WIDTH)},
      {XPAR_AXI_DMA_1_DEVICE_ID, HAL_XPAR(AXI_DMA_1_BASEADDR),
       static_cast<int>(HAL_XPAR(AXI_DMA_1_INCLUDE_MM2S)),
       static_cast<int>(HAL_XPAR(AXI_DMA_1_INCLUDE_S2MM)), HAL_XPAR(AXI_DMA_1_SG_LENGTH_WIDTH),
       HAL_XPAR(AXI_DMA_1_M_AXI_MM2S_DATA_WIDTH)},
  };
  static_assert(sizeof configs / sizeof configs[0] == XPAR_XAXIDMA_NUM_INSTANCES, "one entry each");
  for (XAxiDma_Config& config : configs) {
    if (config.DeviceId == DeviceId) return &config;
  }
  return nullptr;
}

int XAxiDma_CfgInitialize(XAxiDma* InstancePtr, XAxiDma_Config* Config) {
  InstancePtr->Initialized = 0;
  if (Config == nullptr) return XST_INVALID_PARAM;
  InstancePtr->RegBase = Config->BaseAddr;
  InstancePtr->HasMm2S = Config->HasMm2S;
  InstancePtr->HasS2Mm = Config->HasS2Mm;
  InstancePtr->MaxTransferLen = (1u << Config->LengthWidth) - 1;
  InstancePtr->Alignment = Config->DataWidth / 8;
  XAxiDma_Reset(InstancePtr);
  for (unsigned polls = 0; !XAxiDma_ResetIsDone(InstancePtr); ++polls) {
    if (polls == reset_polls) return XST_FAILURE;
  }
  InstancePtr->Initialized = 1;
  return XST_SUCCESS;
}

void XAxiDma_Reset(XAxiDma* InstancePtr) {
  const int direction = InstancePtr->HasMm2S ? XAXIDMA_DMA_TO_DEVICE : XAXIDMA_DEVICE_TO_DMA;
  hal_write32(at(InstancePtr, axi_dma::MM2S_DMACR, direction), axi_dma::dmacr::Reset);
}

int XAxiDma_ResetIsDone(XAxiDma* InstancePtr) {
  const int direction = InstancePtr->HasMm2S ? XAXIDMA_DMA_TO_DEVICE : XAXIDMA_DEVICE_TO_DMA;
  const std::uint32_t control = hal_read32(at(InstancePtr, axi_dma::MM2S_DMACR, direction));
  return (control & axi_dma::dmacr::Reset) == 0;
}

u32 XAxiDma_SimpleTransfer(XAxiDma* InstancePtr, UINTPTR BuffAddr, u32 Length, int Direction) {
  if (!is_possible(InstancePtr, BuffAddr, Length, Direction)) return XST_INVALID_PARAM;
  const std::uint32_t control = at(InstancePtr, axi_dma::MM2S_DMACR, Direction);
  const std::uint32_t status = hal_read32(at(InstancePtr, axi_dma::MM2S_DMASR, Direction));
  if (!(status & (axi_dma::dmasr::Halted | axi_dma::dmasr::Idle))) return XST_FAILURE;
  hal_write32(at(InstancePtr, axi_dma::MM2S_SA, Direction), static_cast<std::uint32_t>(BuffAddr));
  hal_write32(control, hal_read32(control) | axi_dma::dmacr::RS);
  hal_write32(at(InstancePtr, axi_dma::MM2S_LENGTH, Direction), Length);
  return XST_SUCCESS;
}

u32 XAxiDma_Busy(XAxiDma* InstancePtr, int Direction) {
  const std::uint32_t status = hal_read32(at(InstancePtr, axi_dma::MM2S_DMASR, Direction));
  return (status & axi_dma::dmasr::Idle) ? FALSE : TRUE;
}

void XAxiDma_IntrEnable(XAxiDma* InstancePtr, u32 Mask, int Direction) {
  const std::uint32_t control = at(InstancePtr, axi_dma::MM2S_DMACR, Direction);
  hal_write32(control, hal_read32(control) | (Mask & XAXIDMA_IRQ_ALL_MASK));
}

void XAxiDma_IntrDisable(XAxiDma* InstancePtr, u32 Mask, int Direction) {
  const std::uint32_t control = at(InstancePtr, axi_dma::MM2S_DMACR, Direction);
  hal_write32(control, hal_read32(control) & ~(Mask & XAXIDMA_IRQ_ALL_MASK));
}

u32 XAxiDma_IntrGetIrq(XAxiDma* InstancePtr, int Direction) {
  return hal_read32(at(InstancePtr, axi_dma::MM2S_DMASR, Direction)) & XAXIDMA_IRQ_ALL_MASK;
}

void XAxiDma_IntrAckIrq(XAxiDma* InstancePtr, u32 Mask, int Direction) {
  hal_write32(at(InstancePtr, axi_dma::MM2S_DMASR, Direction), Mask & XAXIDMA_IRQ_ALL_MASK);
}

}  // extern "C"

// xgpio.h.

namespace {

std::uint32_t data_of(const XGpio* instance, unsigned channel) {
  return static_cast<std::uint32_t>(instance->BaseAddress) +
         (channel == 2 ? axi_gpio::GPIO2_DATA : axi_gpio::GPIO_DATA);
}

std::uint32_t direction_of(const XGpio* instance, unsigned channel) {
  return static_cast<std::uint32_t>(instance->BaseAddress) +
         (channel == 2 ? axi_gpio::GPIO2_TRI : axi_gpio::GPIO_TRI);
}

}  // namespace

extern "C" {

XGpio_Config* XGpio_LookupConfig(u16 DeviceId) {
  static XGpio_Config configs[] = {
      {XPAR_AXI_GPIO_0_DEVICE_ID, HAL_XPAR(AXI_GPIO_0_BASEADDR),
       static_cast<int>(HAL_XPAR(AXI_GPIO_0_INTERRUPT_PRESENT)),
       static_cast<int>(HAL_XPAR(AXI_GPIO_0_IS_DUAL))},
      {XPAR_AXI_GPIO_1_DEVICE_ID, HAL_XPAR(AXI_GPIO_1_BASEADDR),
       static_cast<int>(HAL_XPAR(AXI_GPIO_1_INTERRUPT_PRESENT)),
       static_cast<int>(HAL_XPAR(AXI_GPIO_1_IS_DUAL))},
  };
  static_assert(sizeof configs / sizeof configs[0] == XPAR_XGPIO_NUM_INSTANCES, "one entry each");
  for (XGpio_Config& config : configs) {
    if (config.DeviceId == DeviceId) return &config;
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

int XGpio_Initialize(XGpio* InstancePtr, u16 DeviceId) {
  XGpio_Config* config = XGpio_LookupConfig(DeviceId);
  if (config == nullptr) return XST_DEVICE_NOT_FOUND;
  return XGpio_CfgInitialize(InstancePtr, config, config->BaseAddress);
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

}  // extern "C"
