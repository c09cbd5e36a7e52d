#ifndef XAXIVDMA_H_
#define XAXIVDMA_H_

/* AXI VDMA in direct register mode (PG020). */

#include <xil_assert.h>
#include <xil_io.h>
#include <xil_types.h>
#include <xparameters.h>
#include <xstatus.h>

#ifdef __cplusplus
extern "C" {
#endif

#define XAXIVDMA_WRITE 1
#define XAXIVDMA_READ 2
#define XAXIVDMA_MAX_FRAMESTORE 32

#define XAXIVDMA_CHAN_FSYNC 0
#define XAXIVDMA_CHAN_OTHER_FSYNC 1
#define XAXIVDMA_S2MM_TUSER_FSYNC 2
#define XAXIVDMA_EXTERNAL_GENLOCK 0
#define XAXIVDMA_INTERNAL_GENLOCK 1
#define XAXIVDMA_GENLOCK_MASTER 0
#define XAXIVDMA_GENLOCK_SLAVE 1
#define XAXIVDMA_DYN_GENLOCK_MASTER 2
#define XAXIVDMA_DYN_GENLOCK_SLAVE 3
#define XAXIVDMA_HANDLER_GENERAL 1
#define XAXIVDMA_HANDLER_ERROR 2

#define XAXIVDMA_TX_OFFSET 0x00000000
#define XAXIVDMA_RX_OFFSET 0x00000030
#define XAXIVDMA_PARKPTR_OFFSET 0x00000028
#define XAXIVDMA_CR_OFFSET 0x00000000
#define XAXIVDMA_SR_OFFSET 0x00000004
#define XAXIVDMA_MM2S_ADDR_OFFSET 0x00000050
#define XAXIVDMA_S2MM_ADDR_OFFSET 0x000000A0
#define XAXIVDMA_VSIZE_OFFSET 0x00000000
#define XAXIVDMA_HSIZE_OFFSET 0x00000004
#define XAXIVDMA_STRD_FRMDLY_OFFSET 0x00000008
#define XAXIVDMA_START_ADDR_OFFSET 0x0000000C
#define XAXIVDMA_CR_RUNSTOP_MASK 0x00000001
#define XAXIVDMA_CR_TAIL_EN_MASK 0x00000002
#define XAXIVDMA_CR_RESET_MASK 0x00000004
#define XAXIVDMA_SR_HALTED_MASK 0x00000001
#define XAXIVDMA_SR_IDLE_MASK 0x00000002
#define XAXIVDMA_SR_ERR_ALL_MASK 0x00000FF0
#define XAXIVDMA_IXR_FRMCNT_MASK 0x00001000
#define XAXIVDMA_IXR_DELAYCNT_MASK 0x00002000
#define XAXIVDMA_IXR_ERROR_MASK 0x00004000
#define XAXIVDMA_SR_ERR_INTERNAL_MASK 0x00000010
#define XAXIVDMA_SR_ERR_SLAVE_MASK 0x00000020
#define XAXIVDMA_SR_ERR_DECODE_MASK 0x00000040
#define XAXIVDMA_SR_ERR_FSZ_LESS_MASK 0x00000080
#define XAXIVDMA_SR_ERR_LSZ_LESS_MASK 0x00000100
#define XAXIVDMA_SR_ERR_FSZ_MORE_MASK 0x00000800
#define XAXIVDMA_SR_ERR_LSZ_MORE_MASK 0x00008000
#define XAXIVDMA_IXR_COMPLETION_MASK 0x00003000
#define XAXIVDMA_IXR_ALL_MASK 0x00007000
#define XAxiVdma_ReadReg(BaseAddress, RegOffset) Xil_In32((BaseAddress) + (RegOffset))
#define XAxiVdma_WriteReg(BaseAddress, RegOffset, Data) \
  Xil_Out32((BaseAddress) + (RegOffset), (Data))

typedef void (*XAxiVdma_CallBack)(void* CallBackRef, u32 InterruptTypes);
typedef void (*XAxiVdma_ErrorCallBack)(void* CallBackRef, u32 ErrorMask);

typedef struct {
  u16 DeviceId;
  UINTPTR BaseAddress;
  u16 MaxFrameStoreNum;
  int HasMm2S;
  int HasMm2SDRE;
  int Mm2SWordLen;
  int HasS2Mm;
  int HasS2MmDRE;
  int S2MmWordLen;
  int HasSG;
  int EnableVIDParamRead;
  int UseFsync;
  int FlushonFsync;
  int Mm2SBufDepth;
  int S2MmBufDepth;
  int Mm2SGenLock;
  int S2MmGenLock;
  int InternalGenLock;
  int S2MmSOF;
  int Mm2SStreamWidth;
  int S2MmStreamWidth;
  int AddrWidth;
  u8 HasVFlip;
  u32 IntrId[2];
  UINTPTR IntrParent;
} XAxiVdma_Config;

typedef struct {
  int VertSizeInput;
  int HoriSizeInput;
  int Stride;
  int FrameDelay;
  int EnableCircularBuf;
  int EnableSync;
  int PointNum;
  int EnableFrameCounter;
  UINTPTR FrameStoreStartAddr[XAXIVDMA_MAX_FRAMESTORE];
  int FixedFrameStoreAddr;
  int GenLockRepeat;
  u8 EnableVFlip;
} XAxiVdma_DmaSetup;

typedef struct {
  u8 ReadFrameCount;
  u8 ReadDelayTimerCount;
  u8 WriteFrameCount;
  u8 WriteDelayTimerCount;
} XAxiVdma_FrameCounter;

typedef struct {
  UINTPTR ChanBase;
  UINTPTR InstanceBase;
  UINTPTR StartAddrBase;
  int HasSG;
  int IsRead;
  int HasDRE;
  int WordLength;
  int StreamWidth;
  int GenLock;
  int IsValid;
  int NumFrames;
  int AllCnt;
  u32 Vsize;
  u32 Hsize;
  XAxiVdma_CallBack CompletionCallBack;
  void* CompletionRef;
  XAxiVdma_ErrorCallBack ErrCallBack;
  void* ErrRef;
} XAxiVdma_Channel;

typedef struct {
  UINTPTR BaseAddr;
  int HasSG;
  int IsReady;
  int MaxNumFrames;
  int HasMm2S;
  int HasMm2SDRE;
  int HasS2Mm;
  int HasS2MmDRE;
  int EnableVIDParamRead;
  int UseFsync;
  int InternalGenLock;
  XAxiVdma_Channel ReadChannel;
  XAxiVdma_Channel WriteChannel;
  int AddrWidth;
} XAxiVdma;

XAxiVdma_Config* XAxiVdma_LookupConfig(UINTPTR DeviceId);
int XAxiVdma_CfgInitialize(XAxiVdma* InstancePtr, XAxiVdma_Config* CfgPtr, UINTPTR EffectiveAddr);
int XAxiVdma_Selftest(XAxiVdma* InstancePtr);
void XAxiVdma_Reset(XAxiVdma* InstancePtr, u16 Direction);
int XAxiVdma_ResetNotDone(XAxiVdma* InstancePtr, u16 Direction);
int XAxiVdma_IsBusy(XAxiVdma* InstancePtr, u16 Direction);
u32 XAxiVdma_CurrFrameStore(XAxiVdma* InstancePtr, u16 Direction);
u32 XAxiVdma_GetVersion(XAxiVdma* InstancePtr);
u32 XAxiVdma_GetStatus(XAxiVdma* InstancePtr, u16 Direction);
int XAxiVdma_SetLineBufThreshold(XAxiVdma* InstancePtr, int LineBufThreshold, u16 Direction);
int XAxiVdma_StartParking(XAxiVdma* InstancePtr, int FrameIndex, u16 Direction);
void XAxiVdma_StopParking(XAxiVdma* InstancePtr, u16 Direction);
void XAxiVdma_StartFrmCntEnable(XAxiVdma* InstancePtr, u16 Direction);
void XAxiVdma_IntrEnable(XAxiVdma* InstancePtr, u32 IntrType, u16 Direction);
void XAxiVdma_IntrDisable(XAxiVdma* InstancePtr, u32 IntrType, u16 Direction);
u32 XAxiVdma_IntrGetPending(XAxiVdma* InstancePtr, u16 Direction);
void XAxiVdma_IntrClear(XAxiVdma* InstancePtr, u32 IntrType, u16 Direction);
XAxiVdma_Channel* XAxiVdma_GetChannel(XAxiVdma* InstancePtr, u16 Direction);
int XAxiVdma_SetFrmStore(XAxiVdma* InstancePtr, u8 FrmStoreNum, u16 Direction);
void XAxiVdma_GetFrmStore(XAxiVdma* InstancePtr, u8* FrmStoreNum, u16 Direction);
int XAxiVdma_FsyncSrcSelect(XAxiVdma* InstancePtr, u32 Source, u16 Direction);
int XAxiVdma_GenLockSourceSelect(XAxiVdma* InstancePtr, u32 Source, u16 Direction);
int XAxiVdma_GetDmaChannelErrors(XAxiVdma* InstancePtr, u16 Direction);
int XAxiVdma_ClearDmaChannelErrors(XAxiVdma* InstancePtr, u16 Direction, u32 ErrorMask);
int XAxiVdma_MaskS2MMErrIntr(XAxiVdma* InstancePtr, u32 ErrorMask, u16 Direction);
int XAxiVdma_StartWriteFrame(XAxiVdma* InstancePtr, XAxiVdma_DmaSetup* DmaConfigPtr);
int XAxiVdma_StartReadFrame(XAxiVdma* InstancePtr, XAxiVdma_DmaSetup* DmaConfigPtr);
int XAxiVdma_DmaConfig(XAxiVdma* InstancePtr, u16 Direction, XAxiVdma_DmaSetup* DmaConfigPtr);
int XAxiVdma_DmaSetBufferAddr(XAxiVdma* InstancePtr, u16 Direction, UINTPTR* BufferAddrSet);
int XAxiVdma_DmaStart(XAxiVdma* InstancePtr, u16 Direction);
void XAxiVdma_DmaStop(XAxiVdma* InstancePtr, u16 Direction);
void XAxiVdma_DmaRegisterDump(XAxiVdma* InstancePtr, u16 Direction);
int XAxiVdma_SetFrameCounter(XAxiVdma* InstancePtr, XAxiVdma_FrameCounter* FrameCounterCfgPtr);
void XAxiVdma_GetFrameCounter(XAxiVdma* InstancePtr, XAxiVdma_FrameCounter* FrameCounterCfgPtr);
void XAxiVdma_ReadIntrHandler(void* InstancePtr);
void XAxiVdma_WriteIntrHandler(void* InstancePtr);
int XAxiVdma_SetCallBack(XAxiVdma* InstancePtr, u32 HandlerType, void* CallBackFunc,
                         void* CallBackRef, u16 Direction);

#ifdef __cplusplus
}
#endif

#endif
