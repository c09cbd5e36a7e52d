#ifndef PORTMACRO_H
#define PORTMACRO_H

/*
 * The port of FreeRTOS (V11) to programs of markervp: tasks are user contexts, and the tick comes
 * from the private timer through the interrupt controller, as in the vendor's port for the
 * Zynq-7000. Addresses have 64 bits here.
 */

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef uintptr_t StackType_t;
typedef long BaseType_t;
typedef unsigned long UBaseType_t;
typedef uint32_t TickType_t;

#define portCHAR char
#define portFLOAT float
#define portDOUBLE double
#define portLONG long
#define portSHORT short
#define portSTACK_TYPE StackType_t
#define portBASE_TYPE BaseType_t
#define portPOINTER_SIZE_TYPE uintptr_t
#define portMAX_DELAY ((TickType_t)0xFFFFFFFFU)
#define portTICK_TYPE_IS_ATOMIC 1
#define portTICK_PERIOD_MS ((TickType_t)1000 / configTICK_RATE_HZ)
#define portSTACK_GROWTH (-1)
#define portBYTE_ALIGNMENT 16
#define portNOP() \
  do {            \
  } while (0)
#define portMEMORY_BARRIER() __asm__ volatile("" ::: "memory")
#define portTASK_FUNCTION_PROTO(function, parameters) void function(void* parameters)
#define portTASK_FUNCTION(function, parameters) void function(void* parameters)

/** Continues the task that the kernel chooses; in a critical section, too. Not for handlers. */
void vPortYield(void);
/** The same once the handler that calls it has returned. */
void vPortYieldFromISR(void);
void vPortEnterCritical(void);
/** Gives back what a deleted task has beside its block of the kernel. */
void vPortCleanUpTask(void* block);
void vPortExitCritical(void);
void vPortDisableInterrupts(void);
void vPortEnableInterrupts(void);

#define portCLEAN_UP_TCB(block) vPortCleanUpTask(block)
#define portYIELD() vPortYield()
#define portYIELD_FROM_ISR(woken)   \
  do {                              \
    if (woken) vPortYieldFromISR(); \
  } while (0)
#define portEND_SWITCHING_ISR(woken) portYIELD_FROM_ISR(woken)
#define portENTER_CRITICAL() vPortEnterCritical()
#define portEXIT_CRITICAL() vPortExitCritical()
#define portDISABLE_INTERRUPTS() vPortDisableInterrupts()
#define portENABLE_INTERRUPTS() vPortEnableInterrupts()
/* Handlers do not interrupt each other. */
#define portSET_INTERRUPT_MASK_FROM_ISR() 0
#define portCLEAR_INTERRUPT_MASK_FROM_ISR(mask) ((void)(mask))

/* As the vendor's port has them: a handler takes its reference. */
typedef void (*XInterruptHandlerOfPort)(void* reference);
BaseType_t xPortInstallInterruptHandler(uint32_t id, XInterruptHandlerOfPort handler,
                                        void* reference);
void vPortEnableInterrupt(uint32_t id);
void vPortDisableInterrupt(uint32_t id);

#ifdef __cplusplus
}
#endif

#endif
