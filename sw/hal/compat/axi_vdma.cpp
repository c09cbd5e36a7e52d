// xaxivdma.h, direct register mode.
#include <initializer_list>

#include <axi_vdma_registers.h>
#include <hal/hal.h>
#include <xaxivdma.h>
#include <xil_printf.h>

#include "device_tables.h"

namespace {

using namespace axi_vdma;

constexpr unsigned reset_polls = 500;
constexpr u32 most_lines = 0x1FFF, most_bytes = 0xFFFF;
constexpr unsigned delay_shift = 24, read_store_shift = 16, write_store_shift = 24;
constexpr u32 fsync_shift = 5, fsync_mask = 3u << fsync_shift;
constexpr u32 stream_errors =
    vdmasr::SOFEarlyErr | vdmasr::EOLEarlyErr | vdmasr::SOFLateErr | vdmasr::EOLLateErr;

u32 read(const XAxiVdma_Channel& channel, u32 offset) {
  return XAxiVdma_ReadReg(channel.ChanBase, offset);
}

void write(const XAxiVdma_Channel& channel, u32 offset, u32 word) {
  XAxiVdma_WriteReg(channel.ChanBase, offset, word);
}

void change_control(const XAxiVdma_Channel& channel, u32 clear, u32 set) {
  write(channel, XAXIVDMA_CR_OFFSET, (read(channel, XAXIVDMA_CR_OFFSET) & ~clear) | set);
}

bool runs(const XAxiVdma_Channel& channel) {
  return (read(channel, XAXIVDMA_SR_OFFSET) & vdmasr::Halted) == 0 &&
         (read(channel, XAXIVDMA_CR_OFFSET) & vdmacr::RS) != 0;
}

XAxiVdma_Channel& channel_of(XAxiVdma* instance, u16 direction) {
  return direction == XAXIVDMA_READ ? instance->ReadChannel : instance->WriteChannel;
}

void set_up(XAxiVdma* instance, const XAxiVdma_Config& config, u16 direction) {
  const bool reads = direction == XAXIVDMA_READ;
  XAxiVdma_Channel& channel = channel_of(instance, direction);
  channel = {};
  channel.IsRead = reads;
  channel.InstanceBase = instance->BaseAddr;
  channel.ChanBase = instance->BaseAddr + (reads ? XAXIVDMA_TX_OFFSET : XAXIVDMA_RX_OFFSET);
  channel.StartAddrBase =
      instance->BaseAddr + (reads ? XAXIVDMA_MM2S_ADDR_OFFSET : XAXIVDMA_S2MM_ADDR_OFFSET);
  channel.HasDRE = reads ? config.HasMm2SDRE : config.HasS2MmDRE;
  channel.WordLength = (reads ? config.Mm2SWordLen : config.S2MmWordLen) / 8;
  channel.StreamWidth = (reads ? config.Mm2SStreamWidth : config.S2MmStreamWidth) / 8;
  channel.GenLock = reads ? config.Mm2SGenLock : config.S2MmGenLock;
  channel.NumFrames = channel.AllCnt = config.MaxFrameStoreNum;
  channel.IsValid = reads ? config.HasMm2S : config.HasS2Mm;
}

bool reset_channels(XAxiVdma* instance) {
  for (const u16 direction : {u16{XAXIVDMA_READ}, u16{XAXIVDMA_WRITE}}) {
    if (!channel_of(instance, direction).IsValid) continue;
    XAxiVdma_Reset(instance, direction);
    for (unsigned polls = 0; XAxiVdma_ResetNotDone(instance, direction); ++polls)
      if (polls == reset_polls) return false;
  }
  return true;
}

/// To the next multiple, and at least one.
int aligned(int bytes, int to) {
  return to <= 1 ? bytes : bytes < to ? to : (bytes + to - 1) / to * to;
}

void park(const XAxiVdma_Channel& channel, u32 frame) {
  const unsigned shift = channel.IsRead ? mm2s.park_shift : s2mm.park_shift;
  const u32 others = XAxiVdma_ReadReg(channel.InstanceBase, PARK_PTR_REG) & ~(park_mask << shift);
  XAxiVdma_WriteReg(channel.InstanceBase, PARK_PTR_REG, others | (frame & park_mask) << shift);
}

bool is_possible(const XAxiVdma_DmaSetup& setup) {
  const auto fits = [](int value, u32 most) {
    return value > 0 && static_cast<u32>(value) <= most;
  };
  return fits(setup.VertSizeInput, most_lines) && fits(setup.HoriSizeInput, most_bytes) &&
         fits(setup.Stride, most_bytes) && setup.FrameDelay >= 0 &&
         setup.FrameDelay < XAXIVDMA_MAX_FRAMESTORE;
}

int set_frame_count(const XAxiVdma_Channel& channel, u32 frames, u32 delay) {
  change_control(channel,
                 vdmacr::count_mask << vdmacr::IRQFrameCount_shift |
                     vdmacr::count_mask << vdmacr::IRQDelayCount_shift,
                 frames << vdmacr::IRQFrameCount_shift | delay << vdmacr::IRQDelayCount_shift);
  return XST_SUCCESS;
}

int start_frame(XAxiVdma* instance, XAxiVdma_DmaSetup* setup, u16 direction) {
  int status = XAxiVdma_DmaConfig(instance, direction, setup);
  if (status == XST_SUCCESS)
    status = XAxiVdma_DmaSetBufferAddr(instance, direction, setup->FrameStoreStartAddr);
  return status == XST_SUCCESS ? XAxiVdma_DmaStart(instance, direction) : status;
}

void handle(XAxiVdma_Channel& channel) {
  if (!channel.IsValid || channel.CompletionCallBack == nullptr) return;
  const u32 pending =
      read(channel, XAXIVDMA_SR_OFFSET) & read(channel, XAXIVDMA_CR_OFFSET) & XAXIVDMA_IXR_ALL_MASK;
  write(channel, XAXIVDMA_SR_OFFSET, pending);
  if (pending == 0 || (pending & XAXIVDMA_IXR_ERROR_MASK) != 0) {
    channel.ErrCallBack(channel.ErrRef, pending & XAXIVDMA_IXR_ERROR_MASK);
  } else {
    channel.CompletionCallBack(channel.CompletionRef, pending);
  }
}

#define MARKERVP_VDMA_OPTION(number, name, otherwise) \
  static_cast<int>(MARKERVP_XPAR(AXIVDMA_##number##_##name, otherwise))

#define MARKERVP_AXI_VDMA(number)                                                         \
  {                                                                                       \
    number, MARKERVP_XPAR(AXIVDMA_##number##_BASEADDR, 0),                                \
        static_cast<u16>(MARKERVP_XPAR(AXIVDMA_##number##_NUM_FSTORES, 3)),               \
        MARKERVP_VDMA_OPTION(number, INCLUDE_MM2S, 0),                                    \
        MARKERVP_VDMA_OPTION(number, INCLUDE_MM2S_DRE, 0),                                \
        MARKERVP_VDMA_OPTION(number, M_AXI_MM2S_DATA_WIDTH, 64),                          \
        MARKERVP_VDMA_OPTION(number, INCLUDE_S2MM, 0),                                    \
        MARKERVP_VDMA_OPTION(number, INCLUDE_S2MM_DRE, 0),                                \
        MARKERVP_VDMA_OPTION(number, M_AXI_S2MM_DATA_WIDTH, 64), 0, 1,                    \
        MARKERVP_VDMA_OPTION(number, USE_FSYNC, 1), 1,                                    \
        MARKERVP_VDMA_OPTION(number, MM2S_LINEBUFFER_DEPTH, 512),                         \
        MARKERVP_VDMA_OPTION(number, S2MM_LINEBUFFER_DEPTH, 512),                         \
        MARKERVP_VDMA_OPTION(number, MM2S_GENLOCK_MODE, 0),                               \
        MARKERVP_VDMA_OPTION(number, S2MM_GENLOCK_MODE, 0),                               \
        MARKERVP_VDMA_OPTION(number, INCLUDE_INTERNAL_GENLOCK, 1), 1,                     \
        MARKERVP_VDMA_OPTION(number, M_AXIS_MM2S_TDATA_WIDTH, 32),                        \
        MARKERVP_VDMA_OPTION(number, S_AXIS_S2MM_TDATA_WIDTH, 32), 32, 0,                 \
        {MARKERVP_XPAR(XAXIVDMA_##number##_INTERRUPTS, markervp_compat::no_interrupt),    \
         MARKERVP_XPAR(XAXIVDMA_##number##_INTERRUPTS_1, markervp_compat::no_interrupt)}, \
        XPAR_XSCUGIC_0_BASEADDR,                                                          \
  }

}  // namespace

extern "C" {

XAxiVdma_Config* XAxiVdma_LookupConfig(UINTPTR DeviceId) {
  static XAxiVdma_Config configs[] = MARKERVP_EACH_DEVICE(MARKERVP_AXI_VDMA);
  static const unsigned count = markervp_compat::devices(MARKERVP_XPAR(XAXIVDMA_NUM_INSTANCES, 0));
  for (unsigned n = 0; n < count; ++n) {
    if (DeviceId == n || DeviceId == configs[n].BaseAddress) return &configs[n];
  }
  return nullptr;
}

int XAxiVdma_CfgInitialize(XAxiVdma* InstancePtr, XAxiVdma_Config* CfgPtr, UINTPTR EffectiveAddr) {
  Xil_AssertNonvoid(InstancePtr && CfgPtr);
  *InstancePtr = {};
  InstancePtr->BaseAddr = EffectiveAddr;
  InstancePtr->MaxNumFrames = CfgPtr->MaxFrameStoreNum;
  InstancePtr->HasMm2S = CfgPtr->HasMm2S;
  InstancePtr->HasS2Mm = CfgPtr->HasS2Mm;
  InstancePtr->UseFsync = CfgPtr->UseFsync;
  InstancePtr->InternalGenLock = CfgPtr->InternalGenLock;
  InstancePtr->AddrWidth = CfgPtr->AddrWidth;
  set_up(InstancePtr, *CfgPtr, XAXIVDMA_READ);
  set_up(InstancePtr, *CfgPtr, XAXIVDMA_WRITE);
  if (!reset_channels(InstancePtr)) return XST_FAILURE;
  InstancePtr->IsReady = XIL_COMPONENT_IS_READY;
  return XST_SUCCESS;
}

int XAxiVdma_Selftest(XAxiVdma* InstancePtr) {
  return reset_channels(InstancePtr) ? XST_SUCCESS : XST_FAILURE;
}

void XAxiVdma_Reset(XAxiVdma* InstancePtr, u16 Direction) {
  const XAxiVdma_Channel& channel = channel_of(InstancePtr, Direction);
  if (channel.IsValid) write(channel, XAXIVDMA_CR_OFFSET, vdmacr::Reset);
}

int XAxiVdma_ResetNotDone(XAxiVdma* InstancePtr, u16 Direction) {
  const XAxiVdma_Channel& channel = channel_of(InstancePtr, Direction);
  return channel.IsValid && (read(channel, XAXIVDMA_CR_OFFSET) & vdmacr::Reset) != 0;
}

// Without scatter-gather a channel is never busy with descriptors: it runs or not.
int XAxiVdma_IsBusy(XAxiVdma* InstancePtr, u16 Direction) {
  const XAxiVdma_Channel& channel = channel_of(InstancePtr, Direction);
  return channel.IsValid && runs(channel);
}

u32 XAxiVdma_CurrFrameStore(XAxiVdma* InstancePtr, u16 Direction) {
  const u32 park = XAxiVdma_ReadReg(InstancePtr->BaseAddr, PARK_PTR_REG);
  return park >> (Direction == XAXIVDMA_READ ? read_store_shift : write_store_shift) & park_mask;
}

u32 XAxiVdma_GetVersion(XAxiVdma* InstancePtr) {
  return XAxiVdma_ReadReg(InstancePtr->BaseAddr, VDMA_VERSION);
}

u32 XAxiVdma_GetStatus(XAxiVdma* InstancePtr, u16 Direction) {
  return read(channel_of(InstancePtr, Direction), XAXIVDMA_SR_OFFSET);
}

/// Builds without the debug registers, as Vivado's usual ones, have neither threshold nor count.
int XAxiVdma_SetLineBufThreshold(XAxiVdma*, int, u16) {
  return XST_NO_FEATURE;
}

int XAxiVdma_SetFrmStore(XAxiVdma* InstancePtr, u8 FrmStoreNum, u16) {
  return FrmStoreNum > InstancePtr->MaxNumFrames ? XST_FAILURE : XST_NO_FEATURE;
}

void XAxiVdma_GetFrmStore(XAxiVdma* InstancePtr, u8* FrmStoreNum, u16) {
  *FrmStoreNum = static_cast<u8>(InstancePtr->MaxNumFrames);
}

int XAxiVdma_StartParking(XAxiVdma* InstancePtr, int FrameIndex, u16 Direction) {
  if (FrameIndex < 0 || static_cast<u32>(FrameIndex) > park_mask) return XST_INVALID_PARAM;
  const XAxiVdma_Channel& channel = channel_of(InstancePtr, Direction);
  park(channel, static_cast<u32>(FrameIndex));
  if (!channel.IsValid) return XST_SUCCESS;
  if (!runs(channel)) return XST_FAILURE;
  change_control(channel, vdmacr::Circular_Park, 0);
  return XST_SUCCESS;
}

void XAxiVdma_StopParking(XAxiVdma* InstancePtr, u16 Direction) {
  const XAxiVdma_Channel& channel = channel_of(InstancePtr, Direction);
  if (channel.IsValid && runs(channel)) change_control(channel, 0, vdmacr::Circular_Park);
}

void XAxiVdma_StartFrmCntEnable(XAxiVdma* InstancePtr, u16 Direction) {
  const XAxiVdma_Channel& channel = channel_of(InstancePtr, Direction);
  if (channel.IsValid) change_control(channel, 0, vdmacr::FrameCntEn);
}

void XAxiVdma_IntrEnable(XAxiVdma* InstancePtr, u32 IntrType, u16 Direction) {
  const XAxiVdma_Channel& channel = channel_of(InstancePtr, Direction);
  if (channel.IsValid) change_control(channel, 0, IntrType & XAXIVDMA_IXR_ALL_MASK);
}

void XAxiVdma_IntrDisable(XAxiVdma* InstancePtr, u32 IntrType, u16 Direction) {
  const XAxiVdma_Channel& channel = channel_of(InstancePtr, Direction);
  if (channel.IsValid) change_control(channel, IntrType & XAXIVDMA_IXR_ALL_MASK, 0);
}

u32 XAxiVdma_IntrGetPending(XAxiVdma* InstancePtr, u16 Direction) {
  const XAxiVdma_Channel& channel = channel_of(InstancePtr, Direction);
  return channel.IsValid ? read(channel, XAXIVDMA_SR_OFFSET) & XAXIVDMA_IXR_ALL_MASK : 0;
}

void XAxiVdma_IntrClear(XAxiVdma* InstancePtr, u32 IntrType, u16 Direction) {
  const XAxiVdma_Channel& channel = channel_of(InstancePtr, Direction);
  if (channel.IsValid) write(channel, XAXIVDMA_SR_OFFSET, IntrType & XAXIVDMA_IXR_ALL_MASK);
}

int XAxiVdma_MaskS2MMErrIntr(XAxiVdma* InstancePtr, u32 ErrorMask, u16 Direction) {
  if (Direction != XAXIVDMA_WRITE) return XST_INVALID_PARAM;
  if (!InstancePtr->WriteChannel.IsValid) return XST_DEVICE_NOT_FOUND;
  XAxiVdma_WriteReg(InstancePtr->BaseAddr, S2MM_VDMA_IRQ_MASK, ErrorMask & 0xF);
  return XST_SUCCESS;
}

XAxiVdma_Channel* XAxiVdma_GetChannel(XAxiVdma* InstancePtr, u16 Direction) {
  return &channel_of(InstancePtr, Direction);
}

int XAxiVdma_FsyncSrcSelect(XAxiVdma* InstancePtr, u32 Source, u16 Direction) {
  const XAxiVdma_Channel& channel = channel_of(InstancePtr, Direction);
  const int other = Direction == XAXIVDMA_WRITE ? 3 : 2;
  if (InstancePtr->UseFsync != 1 && InstancePtr->UseFsync != other) return XST_FAILURE;
  change_control(channel, fsync_mask, Source << fsync_shift & fsync_mask);
  return XST_SUCCESS;
}

int XAxiVdma_GenLockSourceSelect(XAxiVdma* InstancePtr, u32 Source, u16 Direction) {
  if (!InstancePtr->InternalGenLock) return XST_FAILURE;
  const bool is_internal = Source == XAXIVDMA_INTERNAL_GENLOCK;
  change_control(channel_of(InstancePtr, Direction), vdmacr::GenlockSrc,
                 is_internal ? vdmacr::GenlockSrc : 0);
  return XST_SUCCESS;
}

int XAxiVdma_GetDmaChannelErrors(XAxiVdma* InstancePtr, u16 Direction) {
  const XAxiVdma_Channel& channel = channel_of(InstancePtr, Direction);
  if (!channel.IsValid) return 0;
  return static_cast<int>(read(channel, XAXIVDMA_SR_OFFSET) &
                          (XAXIVDMA_SR_ERR_ALL_MASK | vdmasr::EOLLateErr));
}

int XAxiVdma_ClearDmaChannelErrors(XAxiVdma* InstancePtr, u16 Direction, u32 ErrorMask) {
  const XAxiVdma_Channel& channel = channel_of(InstancePtr, Direction);
  if (!channel.IsValid) return XST_DEVICE_NOT_FOUND;
  write(channel, XAXIVDMA_SR_OFFSET, ErrorMask & stream_errors);
  return XST_SUCCESS;
}

int XAxiVdma_StartWriteFrame(XAxiVdma* InstancePtr, XAxiVdma_DmaSetup* DmaConfigPtr) {
  return start_frame(InstancePtr, DmaConfigPtr, XAXIVDMA_WRITE);
}

int XAxiVdma_StartReadFrame(XAxiVdma* InstancePtr, XAxiVdma_DmaSetup* DmaConfigPtr) {
  return start_frame(InstancePtr, DmaConfigPtr, XAXIVDMA_READ);
}

// Without realignment lines are whole words, of the stream where it is read.
int XAxiVdma_DmaConfig(XAxiVdma* InstancePtr, u16 Direction, XAxiVdma_DmaSetup* DmaConfigPtr) {
  XAxiVdma_Channel& channel = channel_of(InstancePtr, Direction);
  if (!channel.IsValid) return XST_DEVICE_NOT_FOUND;
  XAxiVdma_DmaSetup& setup = *DmaConfigPtr;
  if (!channel.HasDRE) {
    const int word = channel.IsRead && setup.HoriSizeInput >= channel.WordLength
                         ? channel.StreamWidth
                         : channel.WordLength;
    setup.HoriSizeInput = aligned(setup.HoriSizeInput, word);
    setup.Stride = aligned(setup.Stride, channel.WordLength);
  }
  u32 control = setup.EnableCircularBuf ? vdmacr::Circular_Park : 0;
  if (!setup.EnableCircularBuf) {
    if (static_cast<u32>(setup.FixedFrameStoreAddr) > park_mask) return XST_INVALID_PARAM;
    park(channel, static_cast<u32>(setup.FixedFrameStoreAddr));
  }
  if (setup.EnableSync && channel.GenLock != XAXIVDMA_GENLOCK_MASTER) control |= vdmacr::GenlockEn;
  if (setup.EnableFrameCounter) control |= vdmacr::FrameCntEn;
  change_control(channel, vdmacr::Circular_Park | vdmacr::GenlockEn | vdmacr::FrameCntEn, control);
  if (!is_possible(setup)) return XST_INVALID_PARAM;
  channel.Vsize = static_cast<u32>(setup.VertSizeInput);
  channel.Hsize = static_cast<u32>(setup.HoriSizeInput);
  XAxiVdma_WriteReg(channel.StartAddrBase, XAXIVDMA_HSIZE_OFFSET, channel.Hsize);
  XAxiVdma_WriteReg(
      channel.StartAddrBase, XAXIVDMA_STRD_FRMDLY_OFFSET,
      static_cast<u32>(setup.FrameDelay) << delay_shift | static_cast<u32>(setup.Stride));
  return XST_SUCCESS;
}

int XAxiVdma_DmaSetBufferAddr(XAxiVdma* InstancePtr, u16 Direction, UINTPTR* BufferAddrSet) {
  const XAxiVdma_Channel& channel = channel_of(InstancePtr, Direction);
  if (!channel.IsValid) return XST_DEVICE_NOT_FOUND;
  for (int i = 0; i < channel.NumFrames; ++i) {
    if (!channel.HasDRE && BufferAddrSet[i] % static_cast<UINTPTR>(channel.WordLength) != 0)
      return XST_INVALID_PARAM;
  }
  for (int i = 0; i < channel.NumFrames; ++i) {
    XAxiVdma_WriteReg(channel.StartAddrBase, XAXIVDMA_START_ADDR_OFFSET + 4 * static_cast<u32>(i),
                      static_cast<u32>(BufferAddrSet[i]));
  }
  return XST_SUCCESS;
}

int XAxiVdma_DmaStart(XAxiVdma* InstancePtr, u16 Direction) {
  const XAxiVdma_Channel& channel = channel_of(InstancePtr, Direction);
  if (!channel.IsValid) return XST_DEVICE_NOT_FOUND;
  if (!runs(channel)) change_control(channel, 0, vdmacr::RS);
  if (!runs(channel)) return XST_DMA_ERROR;
  XAxiVdma_WriteReg(channel.StartAddrBase, XAXIVDMA_VSIZE_OFFSET, channel.Vsize);
  return XST_SUCCESS;
}

void XAxiVdma_DmaStop(XAxiVdma* InstancePtr, u16 Direction) {
  const XAxiVdma_Channel& channel = channel_of(InstancePtr, Direction);
  if (channel.IsValid && runs(channel)) change_control(channel, vdmacr::RS, 0);
}

void XAxiVdma_DmaRegisterDump(XAxiVdma* InstancePtr, u16 Direction) {
  const XAxiVdma_Channel& channel = channel_of(InstancePtr, Direction);
  if (!channel.IsValid) return;
  const auto word = [](u32 value) { return static_cast<unsigned>(value); };
  const auto buffers = [&](u32 offset) {
    return word(XAxiVdma_ReadReg(channel.StartAddrBase, offset));
  };
  xil_printf("%s: VDMACR %x, VDMASR %x, VSIZE %x, HSIZE %x, FRMDLY_STRIDE %x\r\n",
             channel.IsRead ? "MM2S" : "S2MM", word(read(channel, XAXIVDMA_CR_OFFSET)),
             word(read(channel, XAXIVDMA_SR_OFFSET)), buffers(XAXIVDMA_VSIZE_OFFSET),
             buffers(XAXIVDMA_HSIZE_OFFSET), buffers(XAXIVDMA_STRD_FRMDLY_OFFSET));
}

int XAxiVdma_SetFrameCounter(XAxiVdma* InstancePtr, XAxiVdma_FrameCounter* FrameCounterCfgPtr) {
  const XAxiVdma_FrameCounter& counts = *FrameCounterCfgPtr;
  if (counts.ReadFrameCount == 0 || counts.WriteFrameCount == 0) return XST_INVALID_PARAM;
  if (InstancePtr->ReadChannel.IsValid)
    set_frame_count(InstancePtr->ReadChannel, counts.ReadFrameCount, counts.ReadDelayTimerCount);
  if (InstancePtr->WriteChannel.IsValid)
    set_frame_count(InstancePtr->WriteChannel, counts.WriteFrameCount, counts.WriteDelayTimerCount);
  return XST_SUCCESS;
}

void XAxiVdma_GetFrameCounter(XAxiVdma* InstancePtr, XAxiVdma_FrameCounter* FrameCounterCfgPtr) {
  const auto count = [](const XAxiVdma_Channel& channel, unsigned shift) {
    return static_cast<u8>(
        channel.IsValid ? read(channel, XAXIVDMA_SR_OFFSET) >> shift & vdmacr::count_mask : 0);
  };
  const XAxiVdma_Channel &reads = InstancePtr->ReadChannel, &writes = InstancePtr->WriteChannel;
  *FrameCounterCfgPtr = {
      count(reads, vdmacr::IRQFrameCount_shift), count(reads, vdmacr::IRQDelayCount_shift),
      count(writes, vdmacr::IRQFrameCount_shift), count(writes, vdmacr::IRQDelayCount_shift)};
}

void XAxiVdma_ReadIntrHandler(void* InstancePtr) {
  handle(static_cast<XAxiVdma*>(InstancePtr)->ReadChannel);
}

void XAxiVdma_WriteIntrHandler(void* InstancePtr) {
  handle(static_cast<XAxiVdma*>(InstancePtr)->WriteChannel);
}

int XAxiVdma_SetCallBack(XAxiVdma* InstancePtr, u32 HandlerType, void* CallBackFunc,
                         void* CallBackRef, u16 Direction) {
  XAxiVdma_Channel& channel = channel_of(InstancePtr, Direction);
  if (HandlerType == XAXIVDMA_HANDLER_GENERAL) {
    channel.CompletionCallBack = reinterpret_cast<XAxiVdma_CallBack>(CallBackFunc);
    channel.CompletionRef = CallBackRef;
  } else if (HandlerType == XAXIVDMA_HANDLER_ERROR) {
    channel.ErrCallBack = reinterpret_cast<XAxiVdma_ErrorCallBack>(CallBackFunc);
    channel.ErrRef = CallBackRef;
  } else {
    return XST_INVALID_PARAM;
  }
  return XST_SUCCESS;
}

}  // extern "C"
