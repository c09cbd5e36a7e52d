#include "cache_model.h"

#include <string.h>

/* Line numbers + 1, the most recently used first; 0 is empty. */
static uint64_t level1[l1_sets][l1_ways];
static uint64_t level2[l2_sets][l2_ways];

static bool look_up(uint64_t* set, int ways, uint64_t line) {
  int way = 0;
  while (way < ways - 1 && set[way] != line) ++way;
  const bool hit = set[way] == line;
  memmove(set + 1, set, (size_t)way * sizeof *set);
  set[0] = line;
  return hit;
}

void cache_access(uint64_t address, cache_counts* counts) {
  const uint64_t number = address / line_bytes;
  ++counts->accesses;
  if (look_up(level1[number % l1_sets], l1_ways, number + 1)) return;
  ++counts->l1_misses;
  if (!look_up(level2[number % l2_sets], l2_ways, number + 1)) ++counts->l2_misses;
}

void cache_flush(void) {
  memset(level1, 0, sizeof level1);
  memset(level2, 0, sizeof level2);
}
