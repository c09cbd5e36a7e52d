#ifndef XAXIDMA_BD_H
#define XAXIDMA_BD_H

/* A buffer descriptor of the AXI DMA. Those in a ring are reached by the pointers that the ring
 * gives. */

#include <string.h>
#include <xaxidma_hw.h>
#include <xdebug.h>
#include <xil_cache.h>
#include <xil_types.h>
#include <xstatus.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Sixteen words, of which the engine reads eight. */
typedef u32 XAxiDma_Bd[XAXIDMA_BD_NUM_WORDS];

#define XAxiDma_BdRead(BaseAddress, Offset) \
  (*(volatile u32*)((UINTPTR)(BaseAddress) + (u32)(Offset)))
#define XAxiDma_BdWrite(BaseAddress, Offset, Data) \
  (*(volatile u32*)((UINTPTR)(BaseAddress) + (u32)(Offset)) = (u32)(Data))

/** All but the link to the next one becomes 0. */
static inline void XAxiDma_BdClear(XAxiDma_Bd* BdPtr) {
  memset((u8*)BdPtr + XAXIDMA_BD_START_CLEAR, 0, sizeof *BdPtr - XAXIDMA_BD_START_CLEAR);
}

/** The buffer's bus address; XST_INVALID_PARAM if it has none. */
int XAxiDma_BdSetBufAddr(XAxiDma_Bd* BdPtr, UINTPTR Addr);
/** XST_INVALID_PARAM for 0 and more than `LengthMask`, the ring's MaxTransferLen. */
int XAxiDma_BdSetLength(XAxiDma_Bd* BdPtr, u32 LenBytes, u32 LengthMask);
/** Frame bits: XAXIDMA_BD_CTRL_…. */
void XAxiDma_BdSetCtrl(XAxiDma_Bd* BdPtr, u32 Data);
/** Prints the descriptor. */
void XAxiDma_DumpBd(XAxiDma_Bd* BdPtr);
/** The engine is built without control and status streams: XST_INVALID_PARAM. */
int XAxiDma_BdSetAppWord(XAxiDma_Bd* BdPtr, int Offset, u32 Word);
u32 XAxiDma_BdGetAppWord(XAxiDma_Bd* BdPtr, int Offset, int* Valid);

static inline u32 XAxiDma_BdGetBufAddr(XAxiDma_Bd* BdPtr) {
  return XAxiDma_BdRead(BdPtr, XAXIDMA_BD_BUFA_OFFSET);
}
static inline u32 XAxiDma_BdGetCtrl(XAxiDma_Bd* BdPtr) {
  return XAxiDma_BdRead(BdPtr, XAXIDMA_BD_CTRL_LEN_OFFSET) & XAXIDMA_BD_CTRL_ALL_MASK;
}
static inline u32 XAxiDma_BdGetSts(XAxiDma_Bd* BdPtr) {
  return XAxiDma_BdRead(BdPtr, XAXIDMA_BD_STS_OFFSET) & XAXIDMA_BD_STS_ALL_MASK;
}
static inline u32 XAxiDma_BdGetLength(XAxiDma_Bd* BdPtr, u32 LengthMask) {
  return XAxiDma_BdRead(BdPtr, XAXIDMA_BD_CTRL_LEN_OFFSET) & LengthMask;
}
/** Bytes that were moved. */
static inline u32 XAxiDma_BdGetActualLength(XAxiDma_Bd* BdPtr, u32 LengthMask) {
  return XAxiDma_BdRead(BdPtr, XAXIDMA_BD_STS_OFFSET) & LengthMask;
}
static inline u32 XAxiDma_BdHwCompleted(XAxiDma_Bd* BdPtr) {
  return XAxiDma_BdRead(BdPtr, XAXIDMA_BD_STS_OFFSET) & XAXIDMA_BD_STS_COMPLETE_MASK;
}
static inline void XAxiDma_SetBdId_(XAxiDma_Bd* BdPtr, UINTPTR Id) {
  memcpy((u8*)BdPtr + XAXIDMA_BD_ID_OFFSET, &Id, sizeof Id);
}
/** A number or pointer of the program's own. */
#define XAxiDma_BdSetId(BdPtr, Id) XAxiDma_SetBdId_((BdPtr), (UINTPTR)(Id))
static inline UINTPTR XAxiDma_BdGetId(XAxiDma_Bd* BdPtr) {
  UINTPTR id = 0;
  memcpy(&id, (u8*)BdPtr + XAXIDMA_BD_ID_OFFSET, sizeof id);
  return id;
}

/* Of the multichannel mode and of micro mode, which the platform's engine has not. */
#define MARKERVP_ONE_CHANNEL \
  MARKERVP_NOT_OFFERED("the platform's AXI DMA has no multichannel mode: one channel a direction")
void XAxiDma_BdSetTId(XAxiDma_Bd* BdPtr, u32 TId) MARKERVP_ONE_CHANNEL;
u32 XAxiDma_BdGetTId(XAxiDma_Bd* BdPtr) MARKERVP_ONE_CHANNEL;
void XAxiDma_BdSetTDest(XAxiDma_Bd* BdPtr, u32 TDest) MARKERVP_ONE_CHANNEL;
u32 XAxiDma_BdGetTDest(XAxiDma_Bd* BdPtr) MARKERVP_ONE_CHANNEL;
void XAxiDma_BdSetTUser(XAxiDma_Bd* BdPtr, u32 TUser) MARKERVP_ONE_CHANNEL;
u32 XAxiDma_BdGetTUser(XAxiDma_Bd* BdPtr) MARKERVP_ONE_CHANNEL;
void XAxiDma_BdSetARCache(XAxiDma_Bd* BdPtr, u32 ARCache) MARKERVP_ONE_CHANNEL;
u32 XAxiDma_BdGetARCache(XAxiDma_Bd* BdPtr) MARKERVP_ONE_CHANNEL;
void XAxiDma_BdSetARUser(XAxiDma_Bd* BdPtr, u32 ARUser) MARKERVP_ONE_CHANNEL;
u32 XAxiDma_BdGetARUser(XAxiDma_Bd* BdPtr) MARKERVP_ONE_CHANNEL;
void XAxiDma_BdSetStride(XAxiDma_Bd* BdPtr, u32 Stride) MARKERVP_ONE_CHANNEL;
u32 XAxiDma_BdGetStride(XAxiDma_Bd* BdPtr) MARKERVP_ONE_CHANNEL;
void XAxiDma_BdSetVSize(XAxiDma_Bd* BdPtr, u32 VSize) MARKERVP_ONE_CHANNEL;
u32 XAxiDma_BdGetVSize(XAxiDma_Bd* BdPtr) MARKERVP_ONE_CHANNEL;
int XAxiDma_BdSetBufAddrMicroMode(XAxiDma_Bd* BdPtr, UINTPTR Addr)
    MARKERVP_NOT_OFFERED("the platform's AXI DMA has no micro mode: use XAxiDma_BdSetBufAddr");

#ifdef __cplusplus
}
#endif

#endif
