#ifndef XSCUGIC_HW_H
#define XSCUGIC_HW_H

/* The interrupt controller: offsets of registers, and access without an instance (UG585 chapter 7).
 */

#include <bspconfig.h>
#include <xil_assert.h>
#include <xil_exception.h>
#include <xil_io.h>
#include <xil_types.h>

#ifdef __cplusplus
extern "C" {
#endif

#define XSCUGIC_MAX_NUM_INTR_INPUTS 96U
#define XSCUGIC_SPI_INT_ID_START 0x20U
#define XSCUGIC_MAX_INTR_PRIO_VAL 248U
#define XSCUGIC_INTR_PRIO_MASK 0x000000F8U
#define XSCUGIC_PRIORITY_MASK 0x000000FFU
#define XSCUGIC_INT_CFG_MASK 0x00000003U
#define XSCUGIC_SPI_CPU0_MASK 0x01U
#define XSCUGIC_SPI_CPU1_MASK 0x02U
#define XSCUGIC_SFI_SELFTRIG_MASK 0x02010000U
#define XSCUGIC_SFI_TRIG_TRGFILT_MASK 0x03000000U
#define XSCUGIC_SFI_TRIG_CPU_MASK 0x00FF0000U
#define XSCUGIC_SFI_TRIG_INTID_MASK 0x0000000FU

#define XSCUGIC_CONTROL_OFFSET 0x00U
#define XSCUGIC_CPU_PRIOR_OFFSET 0x04U
#define XSCUGIC_BIN_PT_OFFSET 0x08U
#define XSCUGIC_INT_ACK_OFFSET 0x0CU
#define XSCUGIC_EOI_OFFSET 0x10U
#define XSCUGIC_RUN_PRIOR_OFFSET 0x14U
#define XSCUGIC_HI_PEND_OFFSET 0x18U
#define XSCUGIC_ALIAS_BIN_PT_OFFSET 0x1CU
#define XSCUGIC_ACK_INTID_MASK 0x000003FFU
#define XSCUGIC_CPUID_MASK 0x00000C00U
#define XSCUGIC_EOI_INTID_MASK 0x000003FFU
#define XSCUGIC_PEND_INTID_MASK 0x000003FFU
#define XSCUGIC_RUN_PRIORITY_MASK 0x000000FFU
#define XSCUGIC_CNTR_EN_S_MASK 0x00000001U
#define XSCUGIC_CNTR_EN_NS_MASK 0x00000002U
#define XSCUGIC_CNTR_ACKCTL_MASK 0x00000004U
#define XSCUGIC_CNTR_FIQEN_MASK 0x00000008U
#define XSCUGIC_CNTR_SBPR_MASK 0x00000010U

#define XSCUGIC_DIST_EN_OFFSET 0x000U
#define XSCUGIC_IC_TYPE_OFFSET 0x004U
#define XSCUGIC_DIST_IDENT_OFFSET 0x008U
#define XSCUGIC_SECURITY_OFFSET 0x080U
#define XSCUGIC_ENABLE_SET_OFFSET 0x100U
#define XSCUGIC_DISABLE_OFFSET 0x180U
#define XSCUGIC_PENDING_SET_OFFSET 0x200U
#define XSCUGIC_PENDING_CLR_OFFSET 0x280U
#define XSCUGIC_ACTIVE_OFFSET 0x300U
#define XSCUGIC_PRIORITY_OFFSET 0x400U
#define XSCUGIC_SPI_TARGET_OFFSET 0x800U
#define XSCUGIC_INT_CFG_OFFSET 0xC00U
#define XSCUGIC_PPI_STAT_OFFSET 0xD00U
#define XSCUGIC_SPI_STAT_OFFSET 0xD04U
#define XSCUGIC_SFI_TRIG_OFFSET 0xF00U
#define XSCUGIC_PERPHID_OFFSET 0xFD0U
#define XSCUGIC_PCELLID_OFFSET 0xFF0U
#define XSCUGIC_EN_INT_MASK 0x00000001U

#define XSCUGIC_INT_CFG_OFFSET_CALC(InterruptID) \
  ((u32)XSCUGIC_INT_CFG_OFFSET + (((InterruptID) / 16U) * 4U))
#define XSCUGIC_PRIORITY_OFFSET_CALC(InterruptID) \
  ((u32)XSCUGIC_PRIORITY_OFFSET + (((InterruptID) / 4U) * 4U))
#define XSCUGIC_SPI_TARGET_OFFSET_CALC(InterruptID) \
  ((u32)XSCUGIC_SPI_TARGET_OFFSET + (((InterruptID) / 4U) * 4U))
#define XSCUGIC_EN_DIS_OFFSET_CALC(Register, InterruptID) \
  ((Register) + (((InterruptID) / 32U) * 4U))

#define XScuGic_ReadReg(BaseAddress, RegOffset) Xil_In32((BaseAddress) + (RegOffset))
#define XScuGic_WriteReg(BaseAddress, RegOffset, Data) \
  Xil_Out32((BaseAddress) + (RegOffset), (u32)(Data))
#define XScuGic_EnableIntr(DistBaseAddress, Int_Id)                                 \
  XScuGic_WriteReg((DistBaseAddress),                                               \
                   XSCUGIC_EN_DIS_OFFSET_CALC(XSCUGIC_ENABLE_SET_OFFSET, (Int_Id)), \
                   0x00000001U << ((Int_Id) % 32U))
#define XScuGic_DisableIntr(DistBaseAddress, Int_Id)                             \
  XScuGic_WriteReg((DistBaseAddress),                                            \
                   XSCUGIC_EN_DIS_OFFSET_CALC(XSCUGIC_DISABLE_OFFSET, (Int_Id)), \
                   0x00000001U << ((Int_Id) % 32U))

/** As XScuGic_LookupConfig and XScuGic_CfgInitialize, for handlers without an instance. */
s32 XScuGic_DeviceInitialize(u32 DeviceId);
/** For Xil_ExceptionRegisterHandler with the device's number as data: serves one interrupt. */
void XScuGic_DeviceInterruptHandler(void* DeviceId);
void XScuGic_RegisterHandler(UINTPTR BaseAddress, s32 InterruptID, Xil_InterruptHandler Handler,
                             void* CallBackRef);
void XScuGic_SetPriTrigTypeByDistAddr(UINTPTR DistBaseAddress, u32 Int_Id, u8 Priority, u8 Trigger);
void XScuGic_GetPriTrigTypeByDistAddr(UINTPTR DistBaseAddress, u32 Int_Id, u8* Priority,
                                      u8* Trigger);
void XScuGic_InterruptMapFromCpuByDistAddr(UINTPTR DistBaseAddress, u8 Cpu_Id, u32 Int_Id);
void XScuGic_InterruptUnmapFromCpuByDistAddr(UINTPTR DistBaseAddress, u8 Cpu_Id, u32 Int_Id);
void XScuGic_UnmapAllInterruptsFromCpuByDistAddr(UINTPTR DistBaseAddress, u8 Cpu_Id);

#ifdef __cplusplus
}
#endif

/* Fields of the distributor and the CPU interface. */
#define XSCUGIC_LSPI_MASK 0x0000F800U
#define XSCUGIC_DOMAIN_MASK 0x00000400U
#define XSCUGIC_CPU_NUM_MASK 0x000000E0U
#define XSCUGIC_NUM_INT_MASK 0x0000001FU
#define XSCUGIC_REV_MASK 0x00FFF000U
#define XSCUGIC_IMPL_MASK 0x00000FFFU
#define XSCUGIC_INT_NS_MASK 0x00000001U
#define XSCUGIC_INT_EN_MASK 0x00000001U
#define XSCUGIC_INT_CLR_MASK 0x00000001U
#define XSCUGIC_PEND_SET_MASK 0x00000001U
#define XSCUGIC_PEND_CLR_MASK 0x00000001U
#define XSCUGIC_ACTIVE_MASK 0x00000001U
#define XSCUGIC_PRIORITY_MAX 0x000000FFU
#define XSCUGIC_PPI_C15_MASK 0x00008000U
#define XSCUGIC_PPI_C14_MASK 0x00004000U
#define XSCUGIC_PPI_C13_MASK 0x00002000U
#define XSCUGIC_PPI_C12_MASK 0x00001000U
#define XSCUGIC_PPI_C11_MASK 0x00000800U
#define XSCUGIC_PPI_C10_MASK 0x00000400U
#define XSCUGIC_PPI_C09_MASK 0x00000200U
#define XSCUGIC_PPI_C08_MASK 0x00000100U
#define XSCUGIC_PPI_C07_MASK 0x00000080U
#define XSCUGIC_PPI_C06_MASK 0x00000040U
#define XSCUGIC_PPI_C05_MASK 0x00000020U
#define XSCUGIC_PPI_C04_MASK 0x00000010U
#define XSCUGIC_PPI_C03_MASK 0x00000008U
#define XSCUGIC_PPI_C02_MASK 0x00000004U
#define XSCUGIC_PPI_C01_MASK 0x00000002U
#define XSCUGIC_PPI_C00_MASK 0x00000001U
#define XSCUGIC_SPI_N_MASK 0x00000001U
#define XSCUGIC_SFI_TRIG_SATT_MASK 0x00008000U
#define XSCUGIC_BIN_PT_MASK 0x00000007U

#endif
