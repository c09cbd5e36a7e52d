#ifndef XBRAM_HW_H
#define XBRAM_HW_H

/* Block RAM behind an AXI BRAM controller (PG078): memory like any other, reached word by word. Of
 * the controller's registers, which only one with ECC has, none is here. */

#include <xil_io.h>
#include <xil_types.h>

#define XBram_In32 Xil_In32
#define XBram_Out32 Xil_Out32
#define XBram_In16 Xil_In16
#define XBram_Out16 Xil_Out16
#define XBram_In8 Xil_In8
#define XBram_Out8 Xil_Out8

#define XBram_ReadReg(BaseAddress, RegOffset) Xil_In32((BaseAddress) + (u32)(RegOffset))
#define XBram_WriteReg(BaseAddress, RegOffset, Data) \
  Xil_Out32((BaseAddress) + (u32)(RegOffset), (u32)(Data))

#endif
