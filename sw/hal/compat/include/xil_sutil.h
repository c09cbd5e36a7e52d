#ifndef XIL_SUTIL_H
#define XIL_SUTIL_H

/* Where releases from 2024.2 on keep the waits of xil_util.h. */

#include <xil_util.h>

#endif
