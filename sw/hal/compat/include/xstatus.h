#ifndef XSTATUS_H
#define XSTATUS_H

#include <xil_types.h>

typedef s32 XStatus;

#define XST_SUCCESS 0L
#define XST_FAILURE 1L
#define XST_DEVICE_NOT_FOUND 2L
#define XST_INVALID_PARAM 15L

#endif
