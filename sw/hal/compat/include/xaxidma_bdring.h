#ifndef XAXIDMA_BDRING_H
#define XAXIDMA_BDRING_H

/* A ring of buffer descriptors. One goes round free, allocated, with the hardware, done by it, and
 * free again. */

#include <stdlib.h>
#include <xaxidma_bd.h>
#include <xil_types.h>
#include <xstatus.h>

#ifdef __cplusplus
extern "C" {
#endif

#define AXIDMA_CHANNEL_NOT_HALTED 1
#define AXIDMA_CHANNEL_HALTED 2

#define XAXIDMA_NO_CHANGE 0xFFFFFFFFU
#define XAXIDMA_ALL_BDS 0x0FFFFFFF

typedef struct {
  UINTPTR ChanBase; /**< of the channel's registers */
  int IsRxChannel;
  volatile int RunState;
  int HasStsCntrlStrm;
  int HasDRE;
  int DataWidth; /**< of memory, bytes */
  int Addr_ext;
  u32 MaxTransferLen;

  UINTPTR FirstBdPhysAddr;
  UINTPTR FirstBdAddr;
  UINTPTR LastBdAddr;
  u32 Length; /**< of all descriptors, bytes */
  UINTPTR Separation;
  XAxiDma_Bd* FreeHead; /**< next to be allocated */
  XAxiDma_Bd* PreHead;  /**< oldest that was allocated and not handed over */
  XAxiDma_Bd* HwHead;   /**< oldest with the hardware */
  XAxiDma_Bd* HwTail;   /**< newest with the hardware */
  XAxiDma_Bd* PostHead; /**< oldest that the hardware has done */
  XAxiDma_Bd* BdaRestart;
  XAxiDma_Bd* CyclicBd;
  int FreeCnt;
  int PreCnt;
  int HwCnt;
  int PostCnt;
  int AllCnt;
  int RingIndex;
  int Cyclic;
} XAxiDma_BdRing;

/** How many descriptors `Bytes` have room for, and how many bytes `NumBd` need. */
#define XAxiDma_BdRingCntCalc(Alignment, Bytes) \
  (u32)((Bytes) / ((sizeof(XAxiDma_Bd) + ((Alignment)-1)) & ~((Alignment)-1)))
#define XAxiDma_BdRingMemCalc(Alignment, NumBd) \
  ((u32)((sizeof(XAxiDma_Bd) + ((Alignment)-1)) & ~((Alignment)-1)) * (NumBd))

#define XAxiDma_BdRingGetCnt(RingPtr) ((RingPtr)->AllCnt)
#define XAxiDma_BdRingGetFreeCnt(RingPtr) ((RingPtr)->FreeCnt)
#define XAxiDma_BdRingNext(RingPtr, BdPtr)     \
  (((UINTPTR)(BdPtr) >= (RingPtr)->LastBdAddr) \
       ? (XAxiDma_Bd*)(RingPtr)->FirstBdAddr   \
       : (XAxiDma_Bd*)((UINTPTR)(BdPtr) + (RingPtr)->Separation))
#define XAxiDma_BdRingPrev(RingPtr, BdPtr)      \
  (((UINTPTR)(BdPtr) <= (RingPtr)->FirstBdAddr) \
       ? (XAxiDma_Bd*)(RingPtr)->LastBdAddr     \
       : (XAxiDma_Bd*)((UINTPTR)(BdPtr) - (RingPtr)->Separation))

#define XAxiDma_BdRingGetSr(RingPtr) XAxiDma_ReadReg((RingPtr)->ChanBase, XAXIDMA_SR_OFFSET)
#define XAxiDma_BdRingGetCurrBd(RingPtr) \
  ((XAxiDma_Bd*)(UINTPTR)XAxiDma_ReadReg((RingPtr)->ChanBase, XAXIDMA_CDESC_OFFSET))
#define XAxiDma_BdRingHwIsStarted(RingPtr) \
  ((XAxiDma_ReadReg((RingPtr)->ChanBase, XAXIDMA_SR_OFFSET) & XAXIDMA_HALTED_MASK) ? FALSE : TRUE)
#define XAxiDma_BdRingBusy(RingPtr)      \
  (XAxiDma_BdRingHwIsStarted(RingPtr) && \
   ((XAxiDma_ReadReg((RingPtr)->ChanBase, XAXIDMA_SR_OFFSET) & XAXIDMA_IDLE_MASK) == 0))
#define XAxiDma_BdRingGetError(RingPtr) \
  (XAxiDma_ReadReg((RingPtr)->ChanBase, XAXIDMA_SR_OFFSET) & XAXIDMA_ERR_ALL_MASK)
#define XAxiDma_BdRingIntEnable(RingPtr, Mask) \
  XAxiDma_WriteReg(                            \
      (RingPtr)->ChanBase, XAXIDMA_CR_OFFSET,  \
      XAxiDma_ReadReg((RingPtr)->ChanBase, XAXIDMA_CR_OFFSET) | ((Mask)&XAXIDMA_IRQ_ALL_MASK))
#define XAxiDma_BdRingIntDisable(RingPtr, Mask) \
  XAxiDma_WriteReg(                             \
      (RingPtr)->ChanBase, XAXIDMA_CR_OFFSET,   \
      XAxiDma_ReadReg((RingPtr)->ChanBase, XAXIDMA_CR_OFFSET) & ~((Mask)&XAXIDMA_IRQ_ALL_MASK))
#define XAxiDma_BdRingIntGetEnabled(RingPtr) \
  (XAxiDma_ReadReg((RingPtr)->ChanBase, XAXIDMA_CR_OFFSET) & XAXIDMA_IRQ_ALL_MASK)
#define XAxiDma_BdRingGetIrq(RingPtr) \
  (XAxiDma_ReadReg((RingPtr)->ChanBase, XAXIDMA_SR_OFFSET) & XAXIDMA_IRQ_ALL_MASK)
#define XAxiDma_BdRingAckIrq(RingPtr, Mask) \
  XAxiDma_WriteReg((RingPtr)->ChanBase, XAXIDMA_SR_OFFSET, (Mask)&XAXIDMA_IRQ_ALL_MASK)

/** Where the ring resumes when it is started again. */
#define XAxiDma_BdRingSnapShotCurrBd(RingPtr) \
  ((void)((RingPtr)->BdaRestart = XAxiDma_BdRingGetCurrBd(RingPtr)))
/** The software's part of cyclic mode: descriptors stay with the hardware when they are taken from
 * it. The hardware's part is XAxiDma_SelectCyclicMode. */
#define XAxiDma_BdRingEnableCyclicDMA(RingPtr) ((void)((RingPtr)->Cyclic = 1))

/** Makes a ring of `BdCount` descriptors in memory that both addresses name. XST_INVALID_PARAM if
 * that is not aligned, has no bus address or wraps; XST_FAILURE if the channel is not stopped.
 * Without a ring the other functions say XST_DMA_SG_NO_LIST. */
u32 XAxiDma_BdRingCreate(XAxiDma_BdRing* RingPtr, UINTPTR PhysAddr, UINTPTR VirtAddr, u32 Alignment,
                         int BdCount);
/** Copies a descriptor to all of a ring of which none is in use. */
int XAxiDma_BdRingClone(XAxiDma_BdRing* RingPtr, XAxiDma_Bd* SrcBdPtr);
/** Takes `NumBd` free ones, one behind the other. XST_FAILURE if there are fewer. */
int XAxiDma_BdRingAlloc(XAxiDma_BdRing* RingPtr, int NumBd, XAxiDma_Bd** BdSetPtr);
/** Gives back those that were allocated last. XST_FAILURE if they were not. */
int XAxiDma_BdRingUnAlloc(XAxiDma_BdRing* RingPtr, int NumBd, XAxiDma_Bd* BdSetPtr);
/** Hands over the oldest that were allocated; starts them if the channel runs.
 * XST_DMA_SG_LIST_ERROR if they are not those, XST_FAILURE if one has no length or a packet to a
 * stream does not begin with TXSOF or end with TXEOF. */
int XAxiDma_BdRingToHw(XAxiDma_BdRing* RingPtr, int NumBd, XAxiDma_Bd* BdSetPtr);
/** The oldest that the hardware has done, at most `BdLimit`, whole packets only. Returns how many.
 * In cyclic mode they are its own again at once. */
int XAxiDma_BdRingFromHw(XAxiDma_BdRing* RingPtr, int BdLimit, XAxiDma_Bd** BdSetPtr);
/** Frees the oldest that BdRingFromHw gave. XST_DMA_SG_LIST_ERROR if they are not those. */
int XAxiDma_BdRingFree(XAxiDma_BdRing* RingPtr, int NumBd, XAxiDma_Bd* BdSetPtr);
/** Lets the channel run, and what it was handed begin. XST_DMA_ERROR if it does not. */
int XAxiDma_BdRingStart(XAxiDma_BdRing* RingPtr);
int XAxiDma_StartBdRingHw(XAxiDma_BdRing* RingPtr);
int XAxiDma_UpdateBdRingCDesc(XAxiDma_BdRing* RingPtr);
/** Packets (1 to 255) an interrupt, and counts of the delay timer (0: none); XAXIDMA_NO_CHANGE
 * keeps one. XST_FAILURE if one is out of range. */
int XAxiDma_BdRingSetCoalesce(XAxiDma_BdRing* RingPtr, u32 Counter, u32 Timer);
void XAxiDma_BdRingGetCoalesce(XAxiDma_BdRing* RingPtr, u32* CounterPtr, u32* TimerPtr);
/** XST_SUCCESS if ring and counts agree, XST_IS_STARTED if the channel runs. */
int XAxiDma_BdRingCheck(XAxiDma_BdRing* RingPtr);
/** Prints the channel's registers. */
void XAxiDma_BdRingDumpRegs(XAxiDma_BdRing* RingPtr);

#ifdef __cplusplus
}
#endif

#endif
