#ifndef PLATFORM_CONFIG_H
#define PLATFORM_CONFIG_H

/* What the vendor's tools write beside platform.c, and leave out of a repository. */

#define STDOUT_IS_PS7_UART
#define UART_DEVICE_ID 0

#endif
