#ifndef XIICPS_HW_H
#define XIICPS_HW_H

/* Registers of the processing system's I2C controllers (UG585 appendix B.22). */

#include <xil_io.h>
#include <xil_types.h>

#define XIICPS_CR_OFFSET 0x00U
#define XIICPS_SR_OFFSET 0x04U
#define XIICPS_ADDR_OFFSET 0x08U
#define XIICPS_DATA_OFFSET 0x0CU
#define XIICPS_ISR_OFFSET 0x10U
#define XIICPS_TRANS_SIZE_OFFSET 0x14U
#define XIICPS_SLV_PAUSE_OFFSET 0x18U
#define XIICPS_TIME_OUT_OFFSET 0x1CU
#define XIICPS_IMR_OFFSET 0x20U
#define XIICPS_IER_OFFSET 0x24U
#define XIICPS_IDR_OFFSET 0x28U

#define XIICPS_CR_DIV_A_MASK 0x0000C000U
#define XIICPS_CR_DIV_A_SHIFT 14U
#define XIICPS_DIV_A_MAX 4U
#define XIICPS_CR_DIV_B_MASK 0x00003F00U
#define XIICPS_CR_DIV_B_SHIFT 8U
#define XIICPS_CR_CLR_FIFO_MASK 0x00000040U
#define XIICPS_CR_SLVMON_MASK 0x00000020U
#define XIICPS_CR_HOLD_MASK 0x00000010U
#define XIICPS_CR_ACKEN_MASK 0x00000008U
#define XIICPS_CR_NEA_MASK 0x00000004U
#define XIICPS_CR_MS_MASK 0x00000002U
#define XIICPS_CR_RD_WR_MASK 0x00000001U
#define XIICPS_CR_RESET_VALUE 0U

#define XIICPS_SR_BA_MASK 0x00000100U
#define XIICPS_SR_RXOVF_MASK 0x00000080U
#define XIICPS_SR_TXDV_MASK 0x00000040U
#define XIICPS_SR_RXDV_MASK 0x00000020U
#define XIICPS_SR_RXRW_MASK 0x00000008U

#define XIICPS_ADDR_MASK 0x000003FF
#define XIICPS_DATA_MASK 0x000000FF

#define XIICPS_IXR_ARB_LOST_MASK 0x00000200U
#define XIICPS_IXR_RX_UNF_MASK 0x00000080U
#define XIICPS_IXR_TX_OVR_MASK 0x00000040U
#define XIICPS_IXR_RX_OVR_MASK 0x00000020U
#define XIICPS_IXR_SLV_RDY_MASK 0x00000010U
#define XIICPS_IXR_TO_MASK 0x00000008U
#define XIICPS_IXR_NACK_MASK 0x00000004U
#define XIICPS_IXR_DATA_MASK 0x00000002U
#define XIICPS_IXR_COMP_MASK 0x00000001U
#define XIICPS_IXR_DEFAULT_MASK 0x000002FFU
#define XIICPS_IXR_ALL_INTR_MASK 0x000002FFU

#define XIICPS_FIFO_DEPTH 16
#define XIICPS_DATA_INTR_DEPTH 14
#define XIICPS_TO_RESET_VALUE 0x000000FFU

#define XIicPs_In32 Xil_In32
#define XIicPs_Out32 Xil_Out32
#define XIicPs_ReadReg(BaseAddress, RegOffset) Xil_In32((BaseAddress) + (u32)(RegOffset))
#define XIicPs_WriteReg(BaseAddress, RegOffset, RegisterValue) \
  Xil_Out32((BaseAddress) + (u32)(RegOffset), (u32)(RegisterValue))
#define XIicPs_ReadIER(BaseAddress) XIicPs_ReadReg((BaseAddress), XIICPS_IER_OFFSET)
#define XIicPs_EnableInterrupts(BaseAddress, IntrMask) \
  XIicPs_WriteReg((BaseAddress), XIICPS_IER_OFFSET, (IntrMask))
#define XIicPs_DisableInterrupts(BaseAddress, IntrMask) \
  XIicPs_WriteReg((BaseAddress), XIICPS_IDR_OFFSET, (IntrMask))
#define XIicPs_DisableAllInterrupts(BaseAddress) \
  XIicPs_DisableInterrupts((BaseAddress), XIICPS_IXR_ALL_INTR_MASK)

/* Fields, and the looks of a poll in later releases. */
#define XIICPS_TRANS_SIZE_MASK 0x0000003F
#define XIICPS_SLV_PAUSE_MASK 0x0000000F
#define XIICPS_TIME_OUT_MASK 0x000000FFU
#define XIICPS_POLL_DEFAULT_TIMEOUT_VAL 1000U

#ifdef __cplusplus
extern "C" {
#endif

/** All registers as after a reset, the FIFO empty. */
void XIicPs_ResetHw(UINTPTR BaseAddress);

#ifdef __cplusplus
}
#endif

#endif
