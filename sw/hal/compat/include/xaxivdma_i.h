#ifndef XAXIVDMA_I_H_
#define XAXIVDMA_I_H_

/* The inner parts of the vendor's driver: programs include it beside xaxivdma.h, and use nothing of
 * it. */

#include <xaxivdma.h>

#endif
