#ifndef XIL_ASSERT_H
#define XIL_ASSERT_H

/* Checks of arguments: one that fails says where, and ends the program as a failure. */

#include <string.h>
#include <xil_types.h>

#ifdef __cplusplus
extern "C" {
#endif

#define XIL_ASSERT_NONE 0U
#define XIL_ASSERT_OCCURRED 1U

/** Set when a check failed. */
extern u32 Xil_AssertStatus;
/** 0: a failed check leaves its function instead of the program. */
extern s32 Xil_AssertWait;

typedef void (*Xil_AssertCallback)(const char8* File, s32 Line);

/** Called when a check fails, before anything else. */
void Xil_AssertSetCallback(Xil_AssertCallback Routine);
void Xil_Assert(const char8* File, s32 Line);

/** For vectors that have nothing to do. */
void XNullHandler(void* NullParameter);

#ifndef NDEBUG

/* A block, as the vendor's: drivers write it with and without a semicolon. */
#define Xil_AssertVoid(Expression)            \
  {                                           \
    Xil_AssertStatus = XIL_ASSERT_NONE;       \
    if (!(Expression)) {                      \
      Xil_Assert(__FILE__, __LINE__);         \
      Xil_AssertStatus = XIL_ASSERT_OCCURRED; \
      return;                                 \
    }                                         \
  }

#define Xil_AssertNonvoid(Expression)         \
  {                                           \
    Xil_AssertStatus = XIL_ASSERT_NONE;       \
    if (!(Expression)) {                      \
      Xil_Assert(__FILE__, __LINE__);         \
      Xil_AssertStatus = XIL_ASSERT_OCCURRED; \
      return 0;                               \
    }                                         \
  }

#define Xil_AssertVoidAlways() Xil_AssertVoid(0)
#define Xil_AssertNonvoidAlways() Xil_AssertNonvoid(0)

#else

#define Xil_AssertVoid(Expression) \
  {}
#define Xil_AssertNonvoid(Expression) \
  {}
#define Xil_AssertVoidAlways() ((void)0)
#define Xil_AssertNonvoidAlways() ((void)0)

#endif

#ifdef __cplusplus
}
#endif

#endif
