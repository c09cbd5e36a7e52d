#ifndef XIL_HAL_H
#define XIL_HAL_H

/* The whole of the processor's part of a board support package. */

#include <xil_assert.h>
#include <xil_cache.h>
#include <xil_exception.h>
#include <xil_io.h>
#include <xil_types.h>

#endif
