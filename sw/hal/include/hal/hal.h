#ifndef MARKERVP_HAL_H
#define MARKERVP_HAL_H

/*
 * The hardware abstraction layer: all that a PS program may ask of what runs it. Two back ends
 * implement it: the virtual platform (models/ps/cpu) and the chip (bare metal). Plain C, no
 * SystemC.
 *
 * Rules of the road:
 *  - memory that a DMA engine writes is observed only after hal_barrier() or a cache operation; on
 *    the chip, where DMA memory is cached unless built otherwise, only the cache operation will do;
 *  - on the platform handlers run inside HAL accesses, barriers, polls and
 *    hal_wait_for_interrupt(), on the chip between any two instructions. So what a handler shares
 *    with the program is volatile, and a look at it before a sleep is made with IRQ masked;
 *  - annotations (hal_work, hal_function_*) cost nothing on the chip; on the platform they are the
 * only source of CPU time.
 */

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Registers
 * --------------------------------------------------------------------------------------------------
 */

/** Reads a 32-bit device register. `address` is a bus address, a multiple of 4. A bus error is a
 * data abort. */
uint32_t hal_read32(uint32_t address);

/** Writes a 32-bit device register, strongly ordered: complete when the call returns. */
void hal_write32(uint32_t address, uint32_t value);

/** What a poll saw. */
typedef struct hal_poll_result {
  uint32_t value; /**< the last word read */
  uint32_t polls; /**< reads made, at least 1 unless `limit` was 0 */
  bool changed;   /**< false: `limit` reads all returned `previous` */
} hal_poll_result;

/**
 * Reads `address` until the word differs from `previous` or `limit` reads were made. Each round
 * costs the read itself plus `cycles` CPU cycles for the loop around it. On the chip a plain loop.
 */
hal_poll_result hal_poll_until_changed(uint32_t address, uint32_t previous, uint32_t cycles,
                                       uint32_t limit);

/* ---- Memory
 * ------------------------------------------------------------------------------------------------------
 */

/** Data synchronisation barrier: what other masters wrote before is visible after. */
void hal_barrier(void);

/** Writes dirty cache lines of [data, data + size) back to memory: before a device reads it.
 * Includes a barrier. */
void hal_cache_flush(const void* data, size_t size);

/** Drops cached lines of [data, data + size): before software reads what a device wrote. Includes a
 * barrier. */
void hal_cache_invalidate(void* data, size_t size);

#ifndef HAL_BARE_METAL
/** What can be done to all of the data caches at once, on the platform. */
typedef enum hal_cache_whole {
  HAL_CACHE_FLUSH,      /**< writes all dirty lines back, and drops all lines */
  HAL_CACHE_INVALIDATE, /**< drops all lines but the stack's, dirty ones too: data are lost */
  HAL_CACHE_DISABLE,    /**< flushes; from then on nothing is cached, and code is slower */
  HAL_CACHE_ENABLE      /**< begins anew with empty caches */
} hal_cache_whole;

/** Of the core's own level and the shared one. Includes a barrier. */
void hal_cache_all(hal_cache_whole operation);

/** Whether accesses of the program to [data, data + size) are cached: attributes of the MMU.
 * Flushes all caches. */
void hal_memory_cached(const void* data, size_t size, bool cached);
#endif

/** Memory that a DMA engine can reach. */
typedef struct hal_dma_buffer {
  void* data;           /**< for software; NULL when no memory was left */
  uint32_t bus_address; /**< for the DMA engine */
  size_t size;          /**< bytes, as asked for */
} hal_dma_buffer;

/** Takes `size` bytes of DMA memory, aligned to `alignment` (a power of two; at least a cache line
 * of 32 bytes is used). Never given back: all of it is free again when the program starts anew. */
hal_dma_buffer hal_dma_allocate(size_t size, size_t alignment);

/* ---- Interrupts
 * --------------------------------------------------------------------------------------------------
 */

typedef void (*hal_interrupt_handler)(void* context);

/** Sets the one handler of the IRQ exception (the dispatcher of the interrupt controller's driver).
 * NULL removes it. */
void hal_interrupt_connect(hal_interrupt_handler handler, void* context);

/** Unmasks (true) or masks (false) IRQ in the CPU. Masked after reset. Returns what it was. */
bool hal_interrupt_enable(bool enable);

#ifndef HAL_BARE_METAL
/** Calls `hook` after each handler of this core, when IRQ is unmasked again and before the program
 * resumes where it was interrupted. It may continue another context (swapcontext()) and return
 * later, when that one is continued. Platform only; NULL removes it. */
void hal_after_interrupt(void (*hook)(void));
#endif

/** Sleeps until an interrupt is pending at the CPU; its handler has run on return if IRQ is
 * unmasked. */
void hal_wait_for_interrupt(void);

/* ---- The second core
 * --------------------------------------------------------------------------------------------------
 */

/** The core that calls: 0, or 1 on the second one. Each has its own interrupt handler, IRQ mask,
 * CPU interface, private timer and watchdog. */
unsigned hal_cpu_number(void);

/**
 * Starts core `cpu`, which is 1, with `entry`, on a stack of its own and with IRQ masked: writes
 * the entry to 0xFFFFFFF0, where the boot code looks for it, and sends an event (UG585 6.1.10).
 * When `entry` returns, the core sleeps for good. Once in a run. Images and results belong to core
 * 0.
 */
void hal_cpu_start(unsigned cpu, void (*entry)(void));

/** Sleeps until an event is sent or an unmasked interrupt comes (WFE); returns at once if there was
 * one since the last call. Look again at what it waits for: it may return early. */
void hal_wait_for_event(void);

/** Sends an event to both cores, behind all that was written before (DSB, SEV). */
void hal_send_event(void);

/** Reads a word that the other core writes; what that did before hal_store_release() is seen behind
 * it (a load, then DMB). */
uint32_t hal_load_acquire(const volatile uint32_t* word);

/** Writes a word that the other core reads, behind all that was written before (DMB, then a store).
 */
void hal_store_release(volatile uint32_t* word, uint32_t value);

/** hal_load_acquire() that opens the core's exclusive monitor (LDREX). */
uint32_t hal_load_exclusive(const volatile uint32_t* word);

/** hal_store_release() if the word was not written since this core's hal_load_exclusive() (STREX).
 * False: nothing was stored; load the word again. */
bool hal_store_exclusive(volatile uint32_t* word, uint32_t value);

/** A spin lock between the cores. Not for a handler that may interrupt the holder. */
typedef struct hal_lock {
  volatile uint32_t taken; /**< 0 at first */
  const char* name;        /**< for messages; may be NULL */
} hal_lock;

/** Waits until the lock is free, asleep between events, and takes it. */
void hal_lock_acquire(hal_lock* lock);

/** Gives it back and sends an event. */
void hal_lock_release(hal_lock* lock);

/* ---- Console and test bench
 * -------------------------------------------------------------------------------------- */

/** Writes text to the console. */
void hal_console_write(const char* text, size_t length);

/** Tells of a mistake that a driver noticed in the program's call. The platform warns of it, with
 * the line of the call; the chip prints it. */
void hal_warn(const char* text);

/** One image for the program to work on, already in its memory (thesis 4.5.1.1: "preloaded at a
 * specific address"). */
typedef struct hal_frame {
  uint32_t index;        /**< 0, 1, 2 … in the order of the run */
  uint32_t width;        /**< pixels */
  uint32_t height;       /**< pixels */
  const uint8_t* pixels; /**< width × height grey levels, row by row; DMA memory, flushed */
  uint32_t bus_address;  /**< of `pixels` */
  double fx, fy;         /**< focal lengths of the camera in pixels */
  double cx, cy;         /**< principal point in pixels; the centre of pixel (0, 0) is (0.5, 0.5) */
  uint32_t lens_model;   /**< HAL_LENS_…: what `distortion` means */
  double distortion[12]; /**< in the model's order, then 0; 0 each of Brown–Conrady: a pinhole */
  uint32_t response;     /**< HAL_RESPONSE_…: what light the grey levels stand for */
  const uint16_t* light; /**< of 256 grey levels, 65535 the most; NULL unless HAL_RESPONSE_TABLE */
} hal_frame;

#define HAL_LENS_BROWN_CONRADY 0u /**< k1, k2, p1, p2, k3 */
#define HAL_LENS_RATIONAL 1u      /**< the same, k4, k5, k6, and of a thin prism s1, s2, s3, s4 */
#define HAL_LENS_EQUIDISTANT 2u   /**< a fisheye lens: k1, k2, k3, k4 of the angle */

#define HAL_RESPONSE_UNKNOWN 0u
#define HAL_RESPONSE_LINEAR 1u /**< twice the level is twice the light */
#define HAL_RESPONSE_TABLE 2u

/** The next image, when the camera has it; NULL: the run is over. Valid until the next call. */
const hal_frame* hal_frame_next(void);

/** Hands a result to the test bench; `kind` names its type (four characters, see HAL_KIND). Copied.
 * Takes no time. */
void hal_publish(uint32_t kind, const void* data, size_t size);

#define HAL_KIND(a, b, c, d) \
  ((uint32_t)(a) | (uint32_t)(b) << 8 | (uint32_t)(c) << 16 | (uint32_t)(d) << 24)

/** The value of the program's option number `option` (its place in hal_program.options). On the
 * chip: its default. */
double hal_option(uint32_t option);

/* ---- Where devices are
 * -------------------------------------------------------------------------------------------------
 */

/**
 * A value of xparameters.h, which the program includes: HAL_XPAR(AXI_GPIO_0_BASEADDR) is
 * XPAR_AXI_GPIO_0_BASEADDR on the chip. On the platform it is what the design has as it is
 * configured, and the constant where the design has nothing of that name. Takes no time.
 */
#define HAL_XPAR(name) hal_xpar(#name, XPAR_##name)

/** The same with a constant from elsewhere: hal_xpar("FRAME_COUNTER_BASEADDR", 0x41220000). */
#ifdef HAL_BARE_METAL
#define hal_xpar(name, built_in) ((uint32_t)(built_in))
#else
uint32_t hal_xpar(const char* name, uint32_t built_in);
#endif

/* ---- Annotations: vanish on the chip
 * ------------------------------------------------------------------------------ */

#ifdef HAL_BARE_METAL
#define hal_work(item, count) ((void)0)
#define hal_function_enter(function) ((void)0)
#define hal_function_leave() ((void)0)
#define hal_shared_read(data, size) ((void)(data), (void)(size))
#define hal_shared_write(data, size) ((void)(data), (void)(size))
#else
/** The program did `count` units of work number `item` (its place in hal_program.work): time
 * passes. */
void hal_work(uint32_t item, uint64_t count);
/** The program is now inside its function number `function` (its place in hal_program.functions).
 * They nest. */
void hal_function_enter(uint32_t function);
void hal_function_leave(void);
/** Declares that the program reads, or writes, `size` bytes that both cores use. The platform warns
 * if nothing orders this against a declared access of the other core: no lock, no word that one
 * releases and the other acquires, no event, no software interrupt. Takes no time. */
void hal_shared_read(const volatile void* data, size_t size);
void hal_shared_write(volatile void* data, size_t size);
#endif

/* ---- The program
 * -------------------------------------------------------------------------------------------------
 */

/** An option that a user of the program may set, and sweeps may vary: below `sw` in the
 * configuration, by its name. */
typedef struct hal_option_info {
  const char* name;
  const char* unit; /**< "px", "m" … or ""; or the names of its values: "none|grid", then the value
                       is the place of one of them, from 0 */
  double default_value, minimum, maximum;
  const char* documentation; /**< one line with its source */
} hal_option_info;

/** What a program says of itself. Every program defines one, named `hal_program_info`. */
typedef struct hal_program {
  uint32_t abi;            /**< HAL_ABI */
  const char* name;        /**< "hybrid" */
  int (*entry)(void);      /**< returns 0 when all went well */
  const char* const* work; /**< names of the units of work, as in the cost table */
  uint32_t work_count;
  const char* const* functions; /**< names of annotated functions, as in traces and reports */
  uint32_t function_count;
  const hal_option_info* options;
  uint32_t option_count;
} hal_program;

#define HAL_ABI 2u

#if defined(__GNUC__) && !defined(HAL_BARE_METAL)
#define HAL_EXPORT __attribute__((visibility("default")))
#else
#define HAL_EXPORT
#endif

extern HAL_EXPORT const hal_program hal_program_info;

#ifdef __cplusplus
}
#endif

#endif
