#ifndef XGPIOPS_HW_H
#define XGPIOPS_HW_H

/* Registers of the processing system's GPIO (UG585 appendix B.19), by their bank. */

#include <xil_io.h>
#include <xil_types.h>

#define XGPIOPS_DATA_LSW_OFFSET 0x00000000U
#define XGPIOPS_DATA_MSW_OFFSET 0x00000004U
#define XGPIOPS_DATA_OFFSET 0x00000040U
#define XGPIOPS_DATA_RO_OFFSET 0x00000060U
#define XGPIOPS_DIRM_OFFSET 0x00000204U
#define XGPIOPS_OUTEN_OFFSET 0x00000208U
#define XGPIOPS_INTMASK_OFFSET 0x0000020CU
#define XGPIOPS_INTEN_OFFSET 0x00000210U
#define XGPIOPS_INTDIS_OFFSET 0x00000214U
#define XGPIOPS_INTSTS_OFFSET 0x00000218U
#define XGPIOPS_INTTYPE_OFFSET 0x0000021CU
#define XGPIOPS_INTPOL_OFFSET 0x00000220U
#define XGPIOPS_INTANY_OFFSET 0x00000224U

/* From one bank to the next: of the masked data, the data, and the rest. */
#define XGPIOPS_DATA_MASK_OFFSET 0x00000008U
#define XGPIOPS_DATA_BANK_OFFSET 0x00000004U
#define XGPIOPS_REG_MASK_OFFSET 0x00000040U

#define XGpioPs_ReadReg(BaseAddr, RegOffset) Xil_In32((BaseAddr) + (u32)(RegOffset))
#define XGpioPs_WriteReg(BaseAddr, RegOffset, Data) \
  Xil_Out32((BaseAddr) + (u32)(RegOffset), (u32)(Data))

/* Bypass mode, and the types of interrupts after reset. */
#define XGPIOPS_BYPM_MASK_OFFSET 0x00000040U
#define XGPIOPS_INTTYPE_BANK0_RESET 0xFFFFFFFFU
#define XGPIOPS_INTTYPE_BANK1_RESET 0x003FFFFFU
#define XGPIOPS_INTTYPE_BANK2_RESET 0xFFFFFFFFU
#define XGPIOPS_INTTYPE_BANK3_RESET 0xFFFFFFFFU

#ifdef __cplusplus
extern "C" {
#endif

/** All registers of all banks as after a reset: no output, no interrupt. */
void XGpioPs_ResetHw(UINTPTR BaseAddress);

#ifdef __cplusplus
}
#endif

#endif
