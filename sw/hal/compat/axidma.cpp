// xaxidma.h.
#include <axi_dma_registers.h>
#include <hal/hal.h>
#include <xaxidma.h>

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
