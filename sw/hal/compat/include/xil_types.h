#ifndef XIL_TYPES_H
#define XIL_TYPES_H

/* The integer types that bare-metal Zynq code is written with. */

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef uint8_t u8;
typedef uint16_t u16;
typedef uint32_t u32;
typedef uint64_t u64;
typedef int8_t s8;
typedef int16_t s16;
typedef int32_t s32;
typedef int64_t s64;
typedef char char8;
typedef long LONG;
typedef unsigned long ULONG;

/** Wide enough for a pointer: 32 bits on the chip, 64 on the virtual platform. */
typedef uintptr_t UINTPTR;
typedef intptr_t INTPTR;

typedef void (*XInterruptHandler)(void* InstancePtr);
typedef void (*XExceptionHandler)(void* InstancePtr);

#ifndef TRUE
#define TRUE 1U
#endif
#ifndef FALSE
#define FALSE 0U
#endif

#ifndef NULL
#define NULL 0
#endif

#define XIL_COMPONENT_IS_READY 0x11111111U
#define XIL_COMPONENT_IS_STARTED 0x22222222U

#define ULONG64_HI_MASK 0xFFFFFFFF00000000U
#define ULONG64_LO_MASK (~ULONG64_HI_MASK)
#define UPPER_32_BITS(n) ((u32)(((u64)(n)) >> 32))
#define LOWER_32_BITS(n) ((u32)(n))
/* Addresses have 32 bits on the chip: the upper half of one is 0. */
#define LEFT_SHIFT_BY_32_BITS(n) ((u64)0U)

#ifndef INLINE
#define INLINE __inline
#endif

#endif
