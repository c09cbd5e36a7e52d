#ifndef XIL_TESTIO_H
#define XIL_TESTIO_H

/* Writes a value to a register `Len` times and reads it back. 0; -1 at the first difference. */

#include <xil_io.h>
#include <xil_types.h>

#ifdef __cplusplus
extern "C" {
#endif

#define XIL_TESTIO_DEFAULT 0
#define XIL_TESTIO_SWAP_BE 1
#define XIL_TESTIO_SWAP_LE 2

s32 Xil_TestIO8(u8* Addr, s32 Length, u8 Value);
s32 Xil_TestIO16(u16* Addr, s32 Length, u16 Value, s32 Kind, s32 Swap);
s32 Xil_TestIO32(u32* Addr, s32 Length, u32 Value, s32 Kind, s32 Swap);

#ifdef __cplusplus
}
#endif

#endif
