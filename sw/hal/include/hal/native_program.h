#ifndef MARKERVP_NATIVE_PROGRAM_H
#define MARKERVP_NATIVE_PROGRAM_H

/*
 * What a native program and the platform that loads it agree on, besides <hal/hal.h>. Programs do
 * not include it: markervp_add_program adds what it declares. Symbols are looked up by name.
 */

#include <hal/hal.h>

#ifdef __cplusplus
extern "C" {
#endif

/** The program's heap, `markervp_heap`: begins behind its static data, as on the chip. */
typedef struct markervp_heap_area {
  unsigned char* first; /**< a multiple of 4096 */
  unsigned char* top;   /**< [first, top) was handed out at least once */
  unsigned char* end;   /**< one past the last byte that may be */
  void (*release)(void* block);
} markervp_heap_area;
extern HAL_EXPORT markervp_heap_area markervp_heap;

/** Bytes of the heap while the constructors of static objects run. */
#define MARKERVP_HEAP_AT_LOAD (64u << 20)

/** How the basic blocks of a program are charged, `markervp_charge`. A program whose work is
 * counted by hal_work() has none. Call number n (from 1) of `stubs` takes n from `left`, and calls
 * markervp_charge_spent() where nothing is left. */
typedef struct markervp_charge_area {
  volatile int64_t* left;
  const unsigned char* stubs; /**< NULL: not on this host; __sanitizer_cov_trace_pc() does it */
  uint32_t stub_count;
  uint32_t stub_bytes; /**< from one to the next */
} markervp_charge_area;
extern HAL_EXPORT const markervp_charge_area markervp_charge;

void markervp_charge_spent(void);

#ifdef __cplusplus
}
#endif

/** Between static data and heap: the host's kernel asks for so much room behind a large file that
 * it maps at given addresses, for huge pages. */
#define MARKERVP_HEAP_GAP 0x00210000u

#endif
