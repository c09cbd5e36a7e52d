/* Three tasks: one wakes every 5 ms and measures its periods, one receives what it sends, and one
 * of the lowest priority never waits. */
#include "FreeRTOS.h"
#include "queue.h"
#include "task.h"
#include "xil_printf.h"
#include "xtime_l.h"

enum { PERIOD_MS = 5, PERIODS = 20 };

static QueueHandle_t queue;
static volatile unsigned received, spins;

void vAssertCalled(const char* file, int line) {
  xil_printf("%s:%d: the kernel's check failed\r\n", file, line);
  __builtin_trap();
}

static unsigned since_us(XTime before) {
  XTime now;
  XTime_GetTime(&now);
  return (unsigned)((now - before) * 1000000U / COUNTS_PER_SECOND);
}

static void periodic(void* parameters) {
  (void)parameters;
  TickType_t wake = xTaskGetTickCount();
  unsigned longest = 0;
  XTime before;
  vTaskDelayUntil(&wake, pdMS_TO_TICKS(PERIOD_MS));
  XTime_GetTime(&before);
  for (unsigned i = 0; i < PERIODS; ++i) {
    vTaskDelayUntil(&wake, pdMS_TO_TICKS(PERIOD_MS));
    const unsigned period = since_us(before);
    XTime_GetTime(&before);
    if (period > longest) longest = period;
    xQueueSend(queue, &i, 0);
  }
  vTaskDelay(1);
  xil_printf("longest of %d periods: %u us, received %u, the lowest task %s\r\n", PERIODS, longest,
             received, spins != 0 ? "ran" : "starved");
  vTaskEndScheduler();
}

static void receiver(void* parameters) {
  unsigned number;
  (void)parameters;
  for (;;) {
    if (xQueueReceive(queue, &number, portMAX_DELAY) == pdPASS) ++received;
  }
}

static void spinner(void* parameters) {
  (void)parameters;
  for (;;) ++spins;
}

int main(void) {
  queue = xQueueCreate(4, sizeof(unsigned));
  xTaskCreate(periodic, "periodic", configMINIMAL_STACK_SIZE, NULL, 3, NULL);
  xTaskCreate(receiver, "receiver", configMINIMAL_STACK_SIZE, NULL, 2, NULL);
  xTaskCreate(spinner, "spinner", configMINIMAL_STACK_SIZE, NULL, 1, NULL);
  vTaskStartScheduler();
  return received == PERIODS ? 0 : 1;
}
