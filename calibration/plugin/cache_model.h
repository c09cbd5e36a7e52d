#pragma once

#include <stdbool.h>
#include <stdint.h>

/**
 * Data caches of a Zynq-7000 core (UG585 chapter 3): level 1 of 32 KiB with 4 ways, the shared
 * level 2 of 512 KiB with 8 ways, lines of 32 bytes, write back with allocation. The least recently
 * used line goes (the chip's level 1 chooses at random). No prefetch.
 */

enum { line_bytes = 32, l1_ways = 4, l1_sets = 256, l2_ways = 8, l2_sets = 2048 };

typedef struct cache_counts {
  uint64_t accesses, l1_misses, l2_misses;
} cache_counts;

/** One access of up to a line. */
void cache_access(uint64_t address, cache_counts* counts);

/** Nothing is in the caches. */
void cache_flush(void);
