#ifndef SLEEP_H
#define SLEEP_H

/* Waits by looking at the global timer; interrupts are served meanwhile. Declared as POSIX does. */

#include <xil_io.h>

#ifdef __cplusplus
extern "C" {
#endif

int usleep(unsigned int useconds);
unsigned int sleep(unsigned int seconds);
void msleep(unsigned long mseconds);

#ifdef __cplusplus
}
#endif

#define usleep_A9 usleep
#define sleep_A9 sleep

#endif
