#ifndef XBASIC_TYPES_H
#define XBASIC_TYPES_H

/* Names of types and values that programs had before xil_types.h. */

#include <xil_assert.h>
#include <xil_types.h>
#include <xstatus.h>

typedef u8 Xuint8;
typedef char Xint8;
typedef u16 Xuint16;
typedef s16 Xint16;
typedef u32 Xuint32;
typedef s32 Xint32;
typedef float Xfloat32;
typedef double Xfloat64;
typedef unsigned long Xboolean;

typedef struct {
  u32 Upper;
  u32 Lower;
} Xuint64;

#define XTRUE 1
#define XFALSE 0
#define XNULL NULL
#define XUINT64_MSW(x) ((x).Upper)
#define XUINT64_LSW(x) ((x).Lower)
#define XCOMPONENT_IS_READY XIL_COMPONENT_IS_READY
#define XCOMPONENT_IS_STARTED XIL_COMPONENT_IS_STARTED
#define XASSERT_VOID Xil_AssertVoid
#define XASSERT_NONVOID Xil_AssertNonvoid
#define XASSERT_VOID_ALWAYS Xil_AssertVoidAlways
#define XASSERT_NONVOID_ALWAYS Xil_AssertNonvoidAlways

#endif
