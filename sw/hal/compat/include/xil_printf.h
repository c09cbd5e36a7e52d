#ifndef XIL_PRINTF_H
#define XIL_PRINTF_H

/* As the vendor's, which programs rely on. */
#include <bspconfig.h>
#include <ctype.h>
#include <stdarg.h>
#include <string.h>
#include <xil_types.h>
#include <xparameters.h>

#ifdef __cplusplus
extern "C" {
#endif

/** The console's printf without floating point: %c %s %d %i %u %x %X %p %%, the modifier l,
 * a width, and the flags 0 and -. */
void xil_printf(const char8* ctrl1, ...) __attribute__((format(printf, 1, 2)));

void xil_vprintf(const char8* ctrl1, va_list args);

/** Writes a string as it is. */
void print(const char8* ptr);

void outbyte(char c);

/** The next byte that the console's UART receives; waits for it. */
char inbyte(void);

#ifdef __cplusplus
}
#endif

#endif
