/* The port of FreeRTOS to programs of markervp: see portmacro.h. */
#define _GNU_SOURCE
#include <FreeRTOS.h>
#include <task.h>

#include <hal/hal.h>
#include <xil_exception.h>
#include <xil_printf.h>
#include <xparameters.h>
#include <xscugic.h>
#include <xscutimer.h>

#include <stdlib.h>
#include <ucontext.h>

/* Native code, and the HAL below it, takes more stack than the words that a program asks for. */
enum { context_bytes = 256 * 1024, private_timer_id = 29 };

/* A task that does not run. The kernel's stack of the task holds nothing but its address. */
typedef struct context {
  ucontext_t place;
  TaskFunction_t function;
  void* parameters;
  UBaseType_t nesting; /* of critical sections */
  void* stack;
} context;

extern void* volatile pxCurrentTCB;

XScuGic xInterruptController; /* by its name in the vendor's port */
static XScuTimer tick_timer;
static ucontext_t main_place;
static UBaseType_t nesting;
static volatile BaseType_t yields, started;
static int controller_is_ready;

/* A block of the kernel begins with the top of the task's stack. */
static context* context_of(void* block) {
  return **(context***)block;
}

static context* current(void) {
  return context_of(pxCurrentTCB);
}

static void begin_task(void) {
  context* const self = current();
  nesting = 0;
  hal_interrupt_enable(true);
  self->function(self->parameters);
  configASSERT(0); /* a task must not return */
  vTaskDelete(NULL);
}

StackType_t* pxPortInitialiseStack(StackType_t* top, TaskFunction_t function, void* parameters) {
  context* const made = malloc(sizeof *made);
  if (made == NULL) abort();
  made->stack = malloc(context_bytes);
  if (made->stack == NULL) abort();
  made->function = function;
  made->parameters = parameters;
  made->nesting = 0;
  getcontext(&made->place);
  made->place.uc_stack.ss_sp = made->stack;
  made->place.uc_stack.ss_size = context_bytes;
  made->place.uc_link = NULL;
  makecontext(&made->place, begin_task, 0);
  *top = (StackType_t)made;
  return top;
}

void vPortCleanUpTask(void* block) {
  context* const gone = context_of(block);
  free(gone->stack);
  free(gone);
}

/* Each task comes back here with what it left. */
static void switch_task(void) {
  context* const from = current();
  yields = 0;
  vTaskSwitchContext();
  context* const to = current();
  if (from == to) return;
  from->nesting = nesting;
  swapcontext(&from->place, &to->place);
  nesting = from->nesting;
}

void vPortYield(void) {
  hal_interrupt_enable(false);
  switch_task();
  if (nesting == 0) hal_interrupt_enable(true);
}

void vPortYieldFromISR(void) {
  yields = 1;
}

/* Behind a handler, before the interrupted task continues: so it is pre-empted between any two of
 * its statements. */
static void after_interrupt(void) {
  if (yields && started && nesting == 0) vPortYield();
}

void vPortDisableInterrupts(void) {
  hal_interrupt_enable(false);
}

void vPortEnableInterrupts(void) {
  hal_interrupt_enable(true);
}

void vPortEnterCritical(void) {
  hal_interrupt_enable(false);
  ++nesting;
}

void vPortExitCritical(void) {
  configASSERT(nesting != 0);
  if (--nesting == 0 && started) hal_interrupt_enable(true);
}

static void on_tick(void* reference) {
  XScuTimer_ClearInterruptStatus((XScuTimer*)reference);
  if (xTaskIncrementTick() != pdFALSE) yields = 1;
}

static BaseType_t prepare_controller(void) {
  if (controller_is_ready) return pdPASS;
  XScuGic_Config* const config = XScuGic_LookupConfig(0);
  if (config == NULL ||
      XScuGic_CfgInitialize(&xInterruptController, config, config->CpuBaseAddress) != XST_SUCCESS) {
    return pdFAIL;
  }
  Xil_ExceptionRegisterHandler(XIL_EXCEPTION_ID_INT, (Xil_ExceptionHandler)XScuGic_InterruptHandler,
                               &xInterruptController);
  controller_is_ready = 1;
  return pdPASS;
}

BaseType_t xPortInstallInterruptHandler(uint32_t id, XInterruptHandlerOfPort handler,
                                        void* reference) {
  if (prepare_controller() != pdPASS) return pdFAIL;
  return XScuGic_Connect(&xInterruptController, id, (Xil_InterruptHandler)handler, reference) ==
                 XST_SUCCESS
             ? pdPASS
             : pdFAIL;
}

void vPortEnableInterrupt(uint32_t id) {
  if (prepare_controller() == pdPASS) XScuGic_Enable(&xInterruptController, id);
}

void vPortDisableInterrupt(uint32_t id) {
  if (prepare_controller() == pdPASS) XScuGic_Disable(&xInterruptController, id);
}

/* As the vendor's: the load value is the whole number of counts, so a period has one more. */
static BaseType_t start_tick(void) {
  XScuTimer_Config* const config = XScuTimer_LookupConfig(0);
  if (config == NULL ||
      XScuTimer_CfgInitialize(&tick_timer, config, config->BaseAddr) != XST_SUCCESS) {
    return pdFAIL;
  }
  XScuTimer_EnableAutoReload(&tick_timer);
  XScuTimer_LoadTimer(&tick_timer, XPAR_CPU_CORTEXA9_0_CPU_CLK_FREQ_HZ / 2 / configTICK_RATE_HZ);
  if (xPortInstallInterruptHandler(private_timer_id, on_tick, &tick_timer) != pdPASS) return pdFAIL;
  vPortEnableInterrupt(private_timer_id);
  XScuTimer_EnableInterrupt(&tick_timer);
  XScuTimer_Start(&tick_timer);
  return pdPASS;
}

BaseType_t xPortStartScheduler(void) {
  if (start_tick() != pdPASS) return pdFAIL;
  hal_after_interrupt(after_interrupt);
  started = 1;
  swapcontext(&main_place, &current()->place);
  return pdPASS; /* vTaskEndScheduler() */
}

void vPortEndScheduler(void) {
  hal_interrupt_enable(false);
  started = 0;
  XScuTimer_Stop(&tick_timer);
  hal_after_interrupt(NULL);
  setcontext(&main_place);
}

/* As the vendor's port has it. */
__attribute__((weak)) void vApplicationAssert(const char* pcFile, uint32_t ulLine) {
  xil_printf("FreeRTOS: an assertion of %s does not hold, line %u\r\n", pcFile, (unsigned)ulLine);
  exit(1);
}
