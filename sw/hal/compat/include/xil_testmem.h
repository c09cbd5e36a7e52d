#ifndef XIL_TESTMEM_H
#define XIL_TESTMEM_H

/* Writes patterns to memory and reads them back: 0, or -1 at the first difference. The code is the
 * program's, so that it takes the time of its accesses. */

#include <bspconfig.h>
#include <xil_types.h>
#include <xparameters.h>

#define XIL_TESTMEM_INIT_VALUE 1U
#define XIL_TESTMEM_ALLMEMTESTS 0x00U
#define XIL_TESTMEM_INCREMENT 0x01U
#define XIL_TESTMEM_WALKONES 0x02U
#define XIL_TESTMEM_WALKZEROS 0x03U
#define XIL_TESTMEM_INVERSEADDR 0x04U
#define XIL_TESTMEM_FIXEDPATTERN 0x05U
#define XIL_TESTMEM_MAXTEST XIL_TESTMEM_FIXEDPATTERN

/* Xil_TestMem32(Addr, Words, Pattern, Subtest) and its like. Pattern 0: that of `fixed`. */
#define MARKERVP_TEST_MEMORY(bits, fixed)                                                       \
  static inline u##bits markervp_test_word##bits(u##bits* at, unsigned long n, u##bits pattern, \
                                                 u8 subtest) {                                  \
    const u##bits one = (u##bits)((u##bits)1 << (n % bits));                                    \
    if (subtest == XIL_TESTMEM_INCREMENT) return (u##bits)(XIL_TESTMEM_INIT_VALUE + n);         \
    if (subtest == XIL_TESTMEM_WALKONES) return one;                                            \
    if (subtest == XIL_TESTMEM_WALKZEROS) return (u##bits) ~one;                                \
    if (subtest == XIL_TESTMEM_INVERSEADDR) return (u##bits) ~(UINTPTR)(at + n);                \
    return pattern == 0 ? (u##bits)fixed : pattern;                                             \
  }                                                                                             \
  static inline s32 Xil_TestMem##bits(u##bits* Addr, unsigned long Words, u##bits Pattern,      \
                                      u8 Subtest) {                                             \
    volatile u##bits* memory = Addr;                                                            \
    const u8 first = Subtest == XIL_TESTMEM_ALLMEMTESTS ? XIL_TESTMEM_INCREMENT : Subtest;      \
    const u8 last = Subtest == XIL_TESTMEM_ALLMEMTESTS ? XIL_TESTMEM_MAXTEST : Subtest;         \
    if (Words == 0 || Subtest > XIL_TESTMEM_MAXTEST) return -1;                                 \
    for (u8 test = first; test <= last; ++test) {                                               \
      for (unsigned long n = 0; n < Words; ++n)                                                 \
        memory[n] = markervp_test_word##bits(Addr, n, Pattern, test);                           \
      for (unsigned long n = 0; n < Words; ++n)                                                 \
        if (memory[n] != markervp_test_word##bits(Addr, n, Pattern, test)) return -1;           \
    }                                                                                           \
    return 0;                                                                                   \
  }

MARKERVP_TEST_MEMORY(32, 0xDEADBEEFU)
MARKERVP_TEST_MEMORY(16, 0xDEADU)
MARKERVP_TEST_MEMORY(8, 0xA5U)

#endif
