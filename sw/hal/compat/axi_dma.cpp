// xaxidma.h: the engine in direct register mode, and rings of descriptors.
#include <algorithm>
#include <cstring>

#include <axi_dma_registers.h>
#include <hal/hal.h>
#include <xaxidma.h>
#include <xil_printf.h>

#include "device_tables.h"

namespace {

using namespace axi_dma;

/// A bus address has 32 bits; a buffer elsewhere exists on the virtual platform only.
constexpr UINTPTR last_bus_address = 0xFFFF'FFFF;
constexpr unsigned reset_polls = 500;

XAxiDma_BdRing& ring_of(XAxiDma* instance, int direction) {
  return direction == XAXIDMA_DEVICE_TO_DMA ? instance->RxBdRing[0] : instance->TxBdRing;
}

bool has_channel(const XAxiDma* instance, int direction) {
  return direction == XAXIDMA_DEVICE_TO_DMA ? instance->HasS2Mm != 0 : instance->HasMm2S != 0;
}

std::uint32_t at(const XAxiDma_BdRing& ring, std::uint32_t offset) {
  return static_cast<std::uint32_t>(ring.ChanBase) + offset;
}

std::uint32_t read(const XAxiDma_BdRing& ring, std::uint32_t offset) {
  return hal_read32(at(ring, offset));
}

void write(const XAxiDma_BdRing& ring, std::uint32_t offset, std::uint32_t word) {
  hal_write32(at(ring, offset), word);
}

void set_control(const XAxiDma_BdRing& ring, std::uint32_t mask, bool on) {
  const std::uint32_t control = read(ring, MM2S_DMACR);
  write(ring, MM2S_DMACR, on ? control | mask : control & ~mask);
}

XAxiDma_BdRing& first_ring(XAxiDma* instance) {
  return ring_of(instance, instance->HasMm2S ? XAXIDMA_DMA_TO_DEVICE : XAXIDMA_DEVICE_TO_DMA);
}

/// Calls `f` with the ring of each channel that is built.
template <class F>
void for_each_ring(XAxiDma* instance, F f) {
  for (const int direction : {XAXIDMA_DMA_TO_DEVICE, XAXIDMA_DEVICE_TO_DMA}) {
    if (has_channel(instance, direction)) f(ring_of(instance, direction));
  }
}

void initialise_ring(XAxiDma_BdRing& ring, const XAxiDma_Config& config, bool receives) {
  ring = {};
  ring.ChanBase = config.BaseAddr + (receives ? XAXIDMA_RX_OFFSET : XAXIDMA_TX_OFFSET);
  ring.IsRxChannel = receives ? 1 : 0;
  ring.RunState = AXIDMA_CHANNEL_HALTED;
  ring.HasDRE = receives ? config.HasS2MmDRE : config.HasMm2SDRE;
  ring.DataWidth = (receives ? config.S2MmDataWidth : config.Mm2SDataWidth) / 8;
  ring.MaxTransferLen = (1u << config.SgLengthWidth) - 1;
}

bool is_possible(const XAxiDma_BdRing& ring, UINTPTR address, u32 length) {
  return length > 0 && length <= ring.MaxTransferLen && address <= last_bus_address &&
         (ring.HasDRE || address % static_cast<UINTPTR>(ring.DataWidth) == 0);
}

#define MARKERVP_AXI_DMA(number)                                                         \
  {                                                                                      \
    number, MARKERVP_XPAR(AXIDMA_##number##_BASEADDR, 0), 0,                             \
        static_cast<int>(MARKERVP_XPAR(AXIDMA_##number##_INCLUDE_MM2S, 0)), 0,           \
        static_cast<int>(MARKERVP_XPAR(AXIDMA_##number##_M_AXI_MM2S_DATA_WIDTH, 32)),    \
        static_cast<int>(MARKERVP_XPAR(AXIDMA_##number##_INCLUDE_S2MM, 0)), 0,           \
        static_cast<int>(MARKERVP_XPAR(AXIDMA_##number##_M_AXI_S2MM_DATA_WIDTH, 32)),    \
        static_cast<int>(MARKERVP_XPAR(AXIDMA_##number##_INCLUDE_SG, 0)), 1, 1, 32,      \
        static_cast<int>(MARKERVP_XPAR(AXIDMA_##number##_SG_LENGTH_WIDTH, 14)),          \
        {MARKERVP_XPAR(XAXIDMA_##number##_INTERRUPTS, markervp_compat::no_interrupt),    \
         MARKERVP_XPAR(XAXIDMA_##number##_INTERRUPTS_1, markervp_compat::no_interrupt)}, \
        XPAR_XSCUGIC_0_BASEADDR,                                                         \
  }

}  // namespace

extern "C" {

XAxiDma_Config* XAxiDma_LookupConfig(UINTPTR DeviceId) {
  static XAxiDma_Config configs[] = MARKERVP_EACH_DEVICE(MARKERVP_AXI_DMA);
  static const unsigned count = markervp_compat::devices(MARKERVP_XPAR(XAXIDMA_NUM_INSTANCES, 0));
  for (unsigned n = 0; n < count; ++n) {
    if (DeviceId == n || DeviceId == configs[n].BaseAddr) return &configs[n];
  }
  return nullptr;
}

XAxiDma_Config* XAxiDma_LookupConfigBaseAddr(UINTPTR Baseaddr) {
  return XAxiDma_LookupConfig(Baseaddr);
}

int XAxiDma_CfgInitialize(XAxiDma* InstancePtr, XAxiDma_Config* Config) {
  InstancePtr->Initialized = 0;
  if (Config == nullptr) return XST_INVALID_PARAM;
  InstancePtr->RegBase = Config->BaseAddr;
  InstancePtr->HasMm2S = Config->HasMm2S;
  InstancePtr->HasS2Mm = Config->HasS2Mm;
  InstancePtr->HasSg = Config->HasSg;
  InstancePtr->TxNumChannels = InstancePtr->RxNumChannels = 1;
  initialise_ring(InstancePtr->TxBdRing, *Config, false);
  initialise_ring(InstancePtr->RxBdRing[0], *Config, true);
  XAxiDma_Reset(InstancePtr);
  for (unsigned polls = 0; !XAxiDma_ResetIsDone(InstancePtr); ++polls) {
    if (polls == reset_polls) return XST_DMA_ERROR;
  }
  InstancePtr->Initialized = 1;
  return XST_SUCCESS;
}

void XAxiDma_Reset(XAxiDma* InstancePtr) {
  write(first_ring(InstancePtr), MM2S_DMACR, dmacr::Reset);
  for_each_ring(InstancePtr, [](XAxiDma_BdRing& ring) {
    ring.RunState = AXIDMA_CHANNEL_HALTED;
    ring.BdaRestart = ring.HwHead;
  });
}

int XAxiDma_ResetIsDone(XAxiDma* InstancePtr) {
  return (read(first_ring(InstancePtr), MM2S_DMACR) & dmacr::Reset) == 0;
}

int XAxiDma_Selftest(XAxiDma* InstancePtr) {
  int result = XST_SUCCESS;
  for_each_ring(InstancePtr, [&](XAxiDma_BdRing& ring) {
    if ((read(ring, MM2S_DMACR) & dmacr::Reserved_1) == 0) result = XST_FAILURE;
  });
  return result;
}

u32 XAxiDma_SimpleTransfer(XAxiDma* InstancePtr, UINTPTR BuffAddr, u32 Length, int Direction) {
  const XAxiDma_BdRing& ring = ring_of(InstancePtr, Direction);
  if (!has_channel(InstancePtr, Direction) || !is_possible(ring, BuffAddr, Length)) {
    return XST_INVALID_PARAM;
  }
  if (InstancePtr->HasSg) return XST_FAILURE;
  if (!(read(ring, MM2S_DMASR) & (dmasr::Halted | dmasr::Idle))) {
    hal_warn("XAxiDma_SimpleTransfer while the channel is busy: nothing is transferred");
    return XST_FAILURE;
  }
  write(ring, MM2S_SA, static_cast<std::uint32_t>(BuffAddr));
  set_control(ring, dmacr::RS, true);
  write(ring, MM2S_LENGTH, Length);
  return XST_SUCCESS;
}

u32 XAxiDma_Busy(XAxiDma* InstancePtr, int Direction) {
  return (read(ring_of(InstancePtr, Direction), MM2S_DMASR) & dmasr::Idle) ? FALSE : TRUE;
}

int XAxiDma_Pause(XAxiDma* InstancePtr) {
  if (!InstancePtr->Initialized) return XST_NOT_SGDMA;
  for_each_ring(InstancePtr, [&](XAxiDma_BdRing& ring) {
    if (!InstancePtr->HasSg) set_control(ring, dmacr::RS, false);
    ring.RunState = AXIDMA_CHANNEL_HALTED;
  });
  return XST_SUCCESS;
}

int XAxiDma_Resume(XAxiDma* InstancePtr) {
  if (!InstancePtr->Initialized) return XST_NOT_SGDMA;
  int result = XST_SUCCESS;
  for_each_ring(InstancePtr, [&](XAxiDma_BdRing& ring) {
    if (!InstancePtr->HasSg) {
      set_control(ring, dmacr::RS, true);
      ring.RunState = AXIDMA_CHANNEL_NOT_HALTED;
    } else if (XAxiDma_BdRingStart(&ring) != XST_SUCCESS) {
      result = XST_DMA_ERROR;
    }
  });
  return result;
}

int XAxiDma_SelectKeyHole(XAxiDma* InstancePtr, int Direction, int Select) {
  if (!has_channel(InstancePtr, Direction)) return XST_INVALID_PARAM;
  set_control(ring_of(InstancePtr, Direction), dmacr::Keyhole, Select != 0);
  return XST_SUCCESS;
}

int XAxiDma_SelectCyclicMode(XAxiDma* InstancePtr, int Direction, int Select) {
  if (!has_channel(InstancePtr, Direction) || !InstancePtr->HasSg) return XST_INVALID_PARAM;
  XAxiDma_BdRing& ring = ring_of(InstancePtr, Direction);
  set_control(ring, dmacr::Cyclic_BD_Enable, Select != 0);
  ring.Cyclic = Select != 0 ? 1 : 0;
  return XST_SUCCESS;
}

void XAxiDma_IntrEnable(XAxiDma* InstancePtr, u32 Mask, int Direction) {
  set_control(ring_of(InstancePtr, Direction), Mask & XAXIDMA_IRQ_ALL_MASK, true);
}

void XAxiDma_IntrDisable(XAxiDma* InstancePtr, u32 Mask, int Direction) {
  set_control(ring_of(InstancePtr, Direction), Mask & XAXIDMA_IRQ_ALL_MASK, false);
}

u32 XAxiDma_IntrGetEnabled(XAxiDma* InstancePtr, int Direction) {
  return read(ring_of(InstancePtr, Direction), MM2S_DMACR) & XAXIDMA_IRQ_ALL_MASK;
}

u32 XAxiDma_IntrGetIrq(XAxiDma* InstancePtr, int Direction) {
  return read(ring_of(InstancePtr, Direction), MM2S_DMASR) & XAXIDMA_IRQ_ALL_MASK;
}

void XAxiDma_IntrAckIrq(XAxiDma* InstancePtr, u32 Mask, int Direction) {
  write(ring_of(InstancePtr, Direction), MM2S_DMASR, Mask & XAXIDMA_IRQ_ALL_MASK);
}

}  // extern "C"

// Descriptors and rings.

namespace {

constexpr std::uint32_t frame_bits = descriptor::StartOfFrame | descriptor::EndOfFrame;

void flush(XAxiDma_Bd* bd) {
  hal_cache_flush(bd, sizeof *bd);
}

std::uint32_t bus_address(const XAxiDma_Bd* bd) {
  return static_cast<std::uint32_t>(reinterpret_cast<UINTPTR>(bd));
}

XAxiDma_Bd* behind(const XAxiDma_BdRing& ring, XAxiDma_Bd* bd, int count) {
  for (int i = 0; i < count; ++i) bd = XAxiDma_BdRingNext(&ring, bd);
  return bd;
}

/// The engine takes it: no status, and frames as a stream needs them. XST_SUCCESS, or why not.
int hand_over(const XAxiDma_BdRing& ring, XAxiDma_Bd* bd) {
  if (XAxiDma_BdGetLength(bd, ring.MaxTransferLen) == 0) return XST_FAILURE;
  XAxiDma_BdWrite(bd, XAXIDMA_BD_STS_OFFSET,
                  XAxiDma_BdRead(bd, XAXIDMA_BD_STS_OFFSET) & ~descriptor::Cmplt);
  flush(bd);
  return XST_SUCCESS;
}

}  // namespace

extern "C" {

int XAxiDma_BdSetBufAddr(XAxiDma_Bd* BdPtr, UINTPTR Addr) {
  if (Addr > last_bus_address) return XST_INVALID_PARAM;
  XAxiDma_BdWrite(BdPtr, XAXIDMA_BD_BUFA_OFFSET, Addr);
  return XST_SUCCESS;
}

int XAxiDma_BdSetLength(XAxiDma_Bd* BdPtr, u32 LenBytes, u32 LengthMask) {
  if (LenBytes == 0 || LenBytes > LengthMask) return XST_INVALID_PARAM;
  const u32 control = XAxiDma_BdRead(BdPtr, XAXIDMA_BD_CTRL_LEN_OFFSET);
  XAxiDma_BdWrite(BdPtr, XAXIDMA_BD_CTRL_LEN_OFFSET, (control & frame_bits) | LenBytes);
  return XST_SUCCESS;
}

void XAxiDma_BdSetCtrl(XAxiDma_Bd* BdPtr, u32 Data) {
  const u32 control = XAxiDma_BdRead(BdPtr, XAXIDMA_BD_CTRL_LEN_OFFSET);
  XAxiDma_BdWrite(BdPtr, XAXIDMA_BD_CTRL_LEN_OFFSET, (control & ~frame_bits) | (Data & frame_bits));
}

int XAxiDma_BdSetAppWord(XAxiDma_Bd*, int, u32) {
  return XST_INVALID_PARAM;
}

u32 XAxiDma_BdGetAppWord(XAxiDma_Bd*, int, int* Valid) {
  *Valid = 0;
  return 0;
}

u32 XAxiDma_BdRingCreate(XAxiDma_BdRing* RingPtr, UINTPTR PhysAddr, UINTPTR VirtAddr, u32 Alignment,
                         int BdCount) {
  RingPtr->AllCnt = RingPtr->FreeCnt = RingPtr->PreCnt = RingPtr->HwCnt = RingPtr->PostCnt = 0;
  RingPtr->Cyclic = 0;
  if (BdCount <= 0 || Alignment < XAXIDMA_BD_MINIMUM_ALIGNMENT ||
      (Alignment & (Alignment - 1)) != 0 || PhysAddr % Alignment != 0 ||
      VirtAddr % Alignment != 0) {
    return XST_INVALID_PARAM;
  }
  RingPtr->Separation = (sizeof(XAxiDma_Bd) + Alignment - 1) & ~(UINTPTR{Alignment} - 1);
  RingPtr->Length = static_cast<u32>(RingPtr->Separation) * static_cast<u32>(BdCount);
  const UINTPTR last = VirtAddr + RingPtr->Length - RingPtr->Separation;
  if (VirtAddr != PhysAddr || last > last_bus_address) return XST_INVALID_PARAM;
  if (XAxiDma_BdRingHwIsStarted(RingPtr)) return XST_FAILURE;
  RingPtr->FirstBdPhysAddr = PhysAddr;
  RingPtr->FirstBdAddr = VirtAddr;
  RingPtr->LastBdAddr = last;
  std::memset(reinterpret_cast<void*>(VirtAddr), 0, RingPtr->Length);
  auto* const first = reinterpret_cast<XAxiDma_Bd*>(VirtAddr);
  XAxiDma_Bd* bd = first;
  for (int i = 0; i < BdCount; ++i) {
    XAxiDma_Bd* const next = XAxiDma_BdRingNext(RingPtr, bd);
    XAxiDma_BdWrite(bd, XAXIDMA_BD_NDESC_OFFSET, bus_address(next));
    flush(bd);
    bd = next;
  }
  RingPtr->RunState = AXIDMA_CHANNEL_HALTED;
  RingPtr->AllCnt = RingPtr->FreeCnt = BdCount;
  RingPtr->FreeHead = RingPtr->PreHead = RingPtr->HwHead = RingPtr->HwTail = RingPtr->PostHead =
      first;
  RingPtr->BdaRestart = RingPtr->CyclicBd = first;
  return XST_SUCCESS;
}

int XAxiDma_BdRingClone(XAxiDma_BdRing* RingPtr, XAxiDma_Bd* SrcBdPtr) {
  if (RingPtr->AllCnt == 0) return XST_DMA_SG_NO_LIST;
  if (RingPtr->RunState == AXIDMA_CHANNEL_NOT_HALTED) return XST_DEVICE_IS_STARTED;
  if (RingPtr->FreeCnt != RingPtr->AllCnt) return XST_DMA_SG_LIST_ERROR;
  auto* bd = reinterpret_cast<XAxiDma_Bd*>(RingPtr->FirstBdAddr);
  for (int i = 0; i < RingPtr->AllCnt; ++i, bd = XAxiDma_BdRingNext(RingPtr, bd)) {
    constexpr std::size_t links = XAXIDMA_BD_START_CLEAR;
    std::memcpy(reinterpret_cast<u8*>(bd) + links, reinterpret_cast<u8*>(SrcBdPtr) + links,
                sizeof *bd - links);
    XAxiDma_BdWrite(bd, XAXIDMA_BD_STS_OFFSET, 0);
    flush(bd);
  }
  return XST_SUCCESS;
}

int XAxiDma_BdRingAlloc(XAxiDma_BdRing* RingPtr, int NumBd, XAxiDma_Bd** BdSetPtr) {
  if (NumBd <= 0) return XST_INVALID_PARAM;
  if (RingPtr->FreeCnt < NumBd) {
    hal_warn(
        "XAxiDma_BdRingAlloc: the descriptor ring has no room for so many; give those that are "
        "done back with XAxiDma_BdRingFree, or create a longer ring");
    return XST_FAILURE;
  }
  *BdSetPtr = RingPtr->FreeHead;
  RingPtr->FreeHead = behind(*RingPtr, RingPtr->FreeHead, NumBd);
  RingPtr->FreeCnt -= NumBd;
  RingPtr->PreCnt += NumBd;
  return XST_SUCCESS;
}

int XAxiDma_BdRingUnAlloc(XAxiDma_BdRing* RingPtr, int NumBd, XAxiDma_Bd* BdSetPtr) {
  if (NumBd <= 0) return XST_INVALID_PARAM;
  if (RingPtr->PreCnt < NumBd || behind(*RingPtr, BdSetPtr, NumBd) != RingPtr->FreeHead) {
    return XST_FAILURE;
  }
  RingPtr->FreeHead = BdSetPtr;
  RingPtr->FreeCnt += NumBd;
  RingPtr->PreCnt -= NumBd;
  return XST_SUCCESS;
}

int XAxiDma_BdRingToHw(XAxiDma_BdRing* RingPtr, int NumBd, XAxiDma_Bd* BdSetPtr) {
  if (NumBd < 0) return XST_INVALID_PARAM;
  if (NumBd == 0) return XST_SUCCESS;
  if (RingPtr->PreCnt < NumBd || RingPtr->PreHead != BdSetPtr) return XST_DMA_SG_LIST_ERROR;
  XAxiDma_Bd* const last = behind(*RingPtr, BdSetPtr, NumBd - 1);
  const bool framed = (XAxiDma_BdGetCtrl(BdSetPtr) & descriptor::StartOfFrame) != 0 &&
                      (XAxiDma_BdGetCtrl(last) & descriptor::EndOfFrame) != 0;
  if (!RingPtr->IsRxChannel && !framed) return XST_FAILURE;
  XAxiDma_Bd* bd = BdSetPtr;
  for (int i = 0; i < NumBd; ++i, bd = XAxiDma_BdRingNext(RingPtr, bd)) {
    const int status = hand_over(*RingPtr, bd);
    if (status != XST_SUCCESS) return status;
  }
  RingPtr->PreHead = XAxiDma_BdRingNext(RingPtr, last);
  RingPtr->PreCnt -= NumBd;
  RingPtr->HwTail = last;
  RingPtr->HwCnt += NumBd;
  if (RingPtr->RunState == AXIDMA_CHANNEL_NOT_HALTED) {
    write(*RingPtr, MM2S_TAILDESC, bus_address(RingPtr->Cyclic ? RingPtr->CyclicBd : last));
  }
  return XST_SUCCESS;
}

int XAxiDma_BdRingFromHw(XAxiDma_BdRing* RingPtr, int BdLimit, XAxiDma_Bd** BdSetPtr) {
  *BdSetPtr = nullptr;
  const int limit = std::min(BdLimit, RingPtr->HwCnt);
  XAxiDma_Bd* bd = RingPtr->HwHead;
  int whole = 0;  // up to the end of the last whole packet
  for (int seen = 1; seen <= limit; ++seen, bd = XAxiDma_BdRingNext(RingPtr, bd)) {
    hal_cache_invalidate(bd, sizeof *bd);
    const u32 status = XAxiDma_BdRead(bd, XAXIDMA_BD_STS_OFFSET);
    if ((status & descriptor::Cmplt) == 0) break;
    const u32 frame = RingPtr->IsRxChannel ? status : XAxiDma_BdGetCtrl(bd);
    if ((frame & descriptor::EndOfFrame) != 0) whole = seen;
    if (RingPtr->Cyclic) {  // seen once: the next round shows when it is done again
      XAxiDma_BdWrite(bd, XAXIDMA_BD_STS_OFFSET, status & ~descriptor::Cmplt);
      flush(bd);
    }
  }
  if (whole == 0) return 0;
  *BdSetPtr = RingPtr->HwHead;
  RingPtr->HwHead = behind(*RingPtr, RingPtr->HwHead, whole);
  if (RingPtr->Cyclic) return whole;
  RingPtr->HwCnt -= whole;
  RingPtr->PostCnt += whole;
  return whole;
}

int XAxiDma_BdRingFree(XAxiDma_BdRing* RingPtr, int NumBd, XAxiDma_Bd* BdSetPtr) {
  if (NumBd < 0) return XST_INVALID_PARAM;
  if (NumBd == 0) return XST_SUCCESS;
  if (RingPtr->PostCnt < NumBd || RingPtr->PostHead != BdSetPtr) return XST_DMA_SG_LIST_ERROR;
  RingPtr->PostHead = behind(*RingPtr, RingPtr->PostHead, NumBd);
  RingPtr->PostCnt -= NumBd;
  RingPtr->FreeCnt += NumBd;
  return XST_SUCCESS;
}

int XAxiDma_UpdateBdRingCDesc(XAxiDma_BdRing* RingPtr) {
  if (RingPtr->AllCnt == 0) return XST_DMA_SG_NO_LIST;
  if (RingPtr->RunState == AXIDMA_CHANNEL_NOT_HALTED || XAxiDma_BdRingHwIsStarted(RingPtr)) {
    return XST_SUCCESS;
  }
  // What was done before the channel stopped is not done again.
  XAxiDma_Bd* first = RingPtr->HwHead;
  for (int i = 0; i < RingPtr->HwCnt; ++i, first = XAxiDma_BdRingNext(RingPtr, first)) {
    hal_cache_invalidate(first, sizeof *first);
    if (!XAxiDma_BdHwCompleted(first)) break;
  }
  RingPtr->BdaRestart = first;
  write(*RingPtr, MM2S_CURDESC, bus_address(first));
  return XST_SUCCESS;
}

int XAxiDma_StartBdRingHw(XAxiDma_BdRing* RingPtr) {
  if (!XAxiDma_BdRingHwIsStarted(RingPtr)) {
    set_control(*RingPtr, dmacr::RS, true);
    for (unsigned polls = 0; !XAxiDma_BdRingHwIsStarted(RingPtr); ++polls) {
      if (polls == reset_polls) return XST_DMA_ERROR;
    }
  }
  RingPtr->RunState = AXIDMA_CHANNEL_NOT_HALTED;
  if (RingPtr->HwCnt == 0) return XST_SUCCESS;
  hal_cache_invalidate(RingPtr->HwTail, sizeof *RingPtr->HwTail);
  if (RingPtr->Cyclic || !XAxiDma_BdHwCompleted(RingPtr->HwTail)) {
    write(*RingPtr, MM2S_TAILDESC,
          bus_address(RingPtr->Cyclic ? RingPtr->CyclicBd : RingPtr->HwTail));
  }
  return XST_SUCCESS;
}

int XAxiDma_BdRingStart(XAxiDma_BdRing* RingPtr) {
  const int status = XAxiDma_UpdateBdRingCDesc(RingPtr);
  return status == XST_SUCCESS ? XAxiDma_StartBdRingHw(RingPtr) : status;
}

int XAxiDma_BdRingSetCoalesce(XAxiDma_BdRing* RingPtr, u32 Counter, u32 Timer) {
  u32 control = read(*RingPtr, MM2S_DMACR);
  if (Counter != XAXIDMA_NO_CHANGE) {
    if (Counter == 0 || Counter > 0xFF) return XST_FAILURE;
    control = (control & ~dmacr::IRQThreshold) | Counter << dmacr::IRQThreshold_shift;
  }
  if (Timer != XAXIDMA_NO_CHANGE) {
    if (Timer > 0xFF) return XST_FAILURE;
    control = (control & ~dmacr::IRQDelay) | Timer << dmacr::IRQDelay_shift;
  }
  write(*RingPtr, MM2S_DMACR, control);
  return XST_SUCCESS;
}

void XAxiDma_BdRingGetCoalesce(XAxiDma_BdRing* RingPtr, u32* CounterPtr, u32* TimerPtr) {
  const u32 control = read(*RingPtr, MM2S_DMACR);
  *CounterPtr = (control & dmacr::IRQThreshold) >> dmacr::IRQThreshold_shift;
  *TimerPtr = (control & dmacr::IRQDelay) >> dmacr::IRQDelay_shift;
}

int XAxiDma_BdRingCheck(XAxiDma_BdRing* RingPtr) {
  if (RingPtr->AllCnt == 0) return XST_DMA_SG_NO_LIST;
  if (RingPtr->RunState == AXIDMA_CHANNEL_NOT_HALTED) return XST_IS_STARTED;
  const int counted = RingPtr->FreeCnt + RingPtr->PreCnt + RingPtr->HwCnt + RingPtr->PostCnt;
  if (counted != RingPtr->AllCnt) return XST_DMA_SG_LIST_ERROR;
  auto* bd = reinterpret_cast<XAxiDma_Bd*>(RingPtr->FirstBdAddr);
  for (int i = 0; i < RingPtr->AllCnt; ++i) {
    XAxiDma_Bd* const next = XAxiDma_BdRingNext(RingPtr, bd);
    if (XAxiDma_BdRead(bd, XAXIDMA_BD_NDESC_OFFSET) != bus_address(next)) {
      return XST_DMA_SG_LIST_ERROR;
    }
    bd = next;
  }
  return XST_SUCCESS;
}

void XAxiDma_DumpBd(XAxiDma_Bd* BdPtr) {
  const auto word = [&](u32 at) { return static_cast<unsigned>(XAxiDma_BdRead(BdPtr, at)); };
  xil_printf("descriptor %lx:\n next %x, buffer %x, control %x, status %x, ID %lx\n",
             reinterpret_cast<unsigned long>(BdPtr), word(descriptor::NXTDESC),
             word(descriptor::BUFFER_ADDRESS), word(descriptor::CONTROL), word(descriptor::STATUS),
             static_cast<unsigned long>(XAxiDma_BdGetId(BdPtr)));
}

void XAxiDma_BdRingDumpRegs(XAxiDma_BdRing* RingPtr) {
  const auto word = [&](u32 at) { return static_cast<unsigned>(read(*RingPtr, at)); };
  xil_printf("channel %lx:\n control %x, status %x, current descriptor %x, tail descriptor %x\n",
             static_cast<unsigned long>(RingPtr->ChanBase), word(MM2S_DMACR), word(MM2S_DMASR),
             word(MM2S_CURDESC), word(MM2S_TAILDESC));
}

}  // extern "C"
