#ifndef FREERTOS_CONFIG_H
#define FREERTOS_CONFIG_H

/* A tick of 1 ms, pre-emption, and what the example uses of the kernel. */

#ifdef __cplusplus
extern "C" {
#endif
void vAssertCalled(const char* file, int line);
#ifdef __cplusplus
}
#endif

#define configUSE_PREEMPTION 1
#define configUSE_TIME_SLICING 1
#define configTICK_RATE_HZ ((TickType_t)1000)
#define configTICK_TYPE_WIDTH_IN_BITS TICK_TYPE_WIDTH_32_BITS
#define configMAX_PRIORITIES 8
#define configMINIMAL_STACK_SIZE ((unsigned short)200)
#define configTOTAL_HEAP_SIZE (128 * 1024)
#define configMAX_TASK_NAME_LEN 16
#define configCHECK_FOR_STACK_OVERFLOW 0
#define configUSE_IDLE_HOOK 0
#define configUSE_TICK_HOOK 0
#define configUSE_MUTEXES 1
#define configUSE_TIMERS 1
#define configTIMER_TASK_PRIORITY 6
#define configTIMER_QUEUE_LENGTH 8
#define configTIMER_TASK_STACK_DEPTH 400
#define INCLUDE_vTaskDelay 1
#define INCLUDE_xTaskDelayUntil 1
#define INCLUDE_vTaskDelete 1

#define configASSERT(holds) \
  if (!(holds)) vAssertCalled(__FILE__, __LINE__)

#endif
