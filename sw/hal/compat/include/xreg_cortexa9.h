#ifndef XREG_CORTEXA9_H
#define XREG_CORTEXA9_H

/* Fields of the Cortex-A9's CPSR, and registers of its system coprocessor (mfcp(), mtcp() of
 * xpseudo_asm.h). */

#define XREG_CPSR_THUMB_MODE 0x20
#define XREG_CPSR_MODE_BITS 0x1F
#define XREG_CPSR_SYSTEM_MODE 0x1F
#define XREG_CPSR_UNDEFINED_MODE 0x1B
#define XREG_CPSR_DATA_ABORT_MODE 0x17
#define XREG_CPSR_SVC_MODE 0x13
#define XREG_CPSR_IRQ_MODE 0x12
#define XREG_CPSR_FIQ_MODE 0x11
#define XREG_CPSR_USER_MODE 0x10

#define XREG_CPSR_IRQ_ENABLE 0x80
#define XREG_CPSR_FIQ_ENABLE 0x40

#define XREG_CPSR_N_BIT 0x80000000
#define XREG_CPSR_Z_BIT 0x40000000
#define XREG_CPSR_C_BIT 0x20000000
#define XREG_CPSR_V_BIT 0x10000000

/* c0: what mfcp() reads. */
#define XREG_CP15_MAIN_ID 0x0000
#define XREG_CP15_MULTI_PROC_AFFINITY 0x0005

/* c7 and c8: caches and tables that are not modelled, so that mtcp() has nothing to do. */
#define XREG_CP15_INVAL_IC_POU_IS 0x7010
#define XREG_CP15_INVAL_BRANCH_ARRAY_IS 0x7016
#define XREG_CP15_INVAL_IC_POU 0x7050
#define XREG_CP15_INVAL_BRANCH_ARRAY 0x7056
#define XREG_CP15_INVAL_UTLB_UNLOCKED 0x8070

/* Registers that change how the processor works: the compiler refuses them. */
#ifdef __cplusplus
extern "C"
#endif
    int
    markervp_coprocessor_register(void) __attribute__((
        error("this register of the coprocessor is not modelled: leave the access out in this "
              "build. For caches call Xil_DCacheDisable() and the like, for sections of memory "
              "Xil_SetTlbAttributes(), for time XTime_GetTime()")));
#define XREG_CP15_SYS_CONTROL markervp_coprocessor_register()
#define XREG_CP15_AUX_CONTROL markervp_coprocessor_register()
#define XREG_CP15_CP_ACCESS_CONTROL markervp_coprocessor_register()
#define XREG_CP15_TTBR0 markervp_coprocessor_register()
#define XREG_CP15_TTBR1 markervp_coprocessor_register()
#define XREG_CP15_TTB_CONTROL markervp_coprocessor_register()
#define XREG_CP15_DOMAIN_ACCESS_CTRL markervp_coprocessor_register()
#define XREG_CP15_DATA_FAULT_STATUS markervp_coprocessor_register()
#define XREG_CP15_DATA_FAULT_ADDRESS markervp_coprocessor_register()
#define XREG_CP15_INST_FAULT_STATUS markervp_coprocessor_register()
#define XREG_CP15_INST_FAULT_ADDRESS markervp_coprocessor_register()
#define XREG_CP15_PERF_MONITOR_CTRL markervp_coprocessor_register()
#define XREG_CP15_COUNT_ENABLE_SET markervp_coprocessor_register()
#define XREG_CP15_PERF_CYCLE_COUNTER markervp_coprocessor_register()
#define XREG_CP15_USER_ENABLE markervp_coprocessor_register()
#define XREG_CP15_VEC_BASE_ADDR markervp_coprocessor_register()
#define XREG_CP15_POWER_CTRL markervp_coprocessor_register()

#endif
