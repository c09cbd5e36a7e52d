#ifndef XIL_MISC_PSRESET_API_H
#define XIL_MISC_PSRESET_API_H

/* The lock of the SLCR (UG585 appendix B). */

#include <xil_io.h>
#include <xil_types.h>
#include <xparameters.h>

#define XSLCR_BASEADDR 0xF8000000U
#define XSLCR_LOCK_ADDR (XSLCR_BASEADDR + 0x4U)
#define XSLCR_LOCK_CODE 0x0000767BU
#define XSLCR_UNLOCK_ADDR (XSLCR_BASEADDR + 0x8U)
#define XSLCR_UNLOCK_CODE 0x0000DF0DU

#endif
