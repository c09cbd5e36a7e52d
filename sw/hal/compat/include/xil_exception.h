#ifndef XIL_EXCEPTION_H
#define XIL_EXCEPTION_H

/* Of the exceptions only IRQ has a handler; the others end the program, as the HAL says. */

#include <bspconfig.h>
#include <hal/hal.h>
#include <xil_types.h>
#include <xparameters.h>
#include <xpseudo_asm.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef void (*Xil_ExceptionHandler)(void* data);
typedef void (*Xil_InterruptHandler)(void* data);

#define XIL_EXCEPTION_ID_FIRST 0U
#define XIL_EXCEPTION_ID_RESET 0U
#define XIL_EXCEPTION_ID_UNDEFINED_INT 1U
#define XIL_EXCEPTION_ID_SWI_INT 2U
#define XIL_EXCEPTION_ID_PREFETCH_ABORT_INT 3U
#define XIL_EXCEPTION_ID_DATA_ABORT_INT 4U
#define XIL_EXCEPTION_ID_IRQ_INT 5U
#define XIL_EXCEPTION_ID_FIQ_INT 6U
#define XIL_EXCEPTION_ID_LAST 6U
#define XIL_EXCEPTION_ID_INT XIL_EXCEPTION_ID_IRQ_INT
#define XIL_EXCEPTION_IRQ 0x80U
#define XIL_EXCEPTION_FIQ 0x40U
#define XIL_EXCEPTION_ALL 0xC0U

static inline void Xil_ExceptionInit(void) {}

void Xil_ExceptionRegisterHandler(u32 Exception_id, Xil_ExceptionHandler Handler, void* Data);
void Xil_ExceptionRemoveHandler(u32 Exception_id);
/** What was registered; NULL where nothing was, which is the vendor's loop without end. */
void Xil_GetExceptionRegisterHandler(u32 Exception_id, Xil_ExceptionHandler* Handler, void** Data);

static inline void Xil_ExceptionEnableMask(u32 Mask) {
  if (Mask & XIL_EXCEPTION_IRQ) (void)hal_interrupt_enable(true);
}

static inline void Xil_ExceptionDisableMask(u32 Mask) {
  if (Mask & XIL_EXCEPTION_IRQ) (void)hal_interrupt_enable(false);
}

static inline void Xil_ExceptionEnable(void) {
  Xil_ExceptionEnableMask(XIL_EXCEPTION_IRQ);
}

static inline void Xil_ExceptionDisable(void) {
  Xil_ExceptionDisableMask(XIL_EXCEPTION_IRQ);
}

#ifdef __cplusplus
}
#endif

#endif
