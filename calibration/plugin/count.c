/*
 * Counts what a program executes between marks (marks.h). Options:
 *   out=FILE      one line for each measurement: instructions, accesses, misses of level 1 and 2
 *   cache=on      with the cache model (slower); without it the last three are 0
 *   blocks=FILE   the disassembly of blocks; each line of `out` continues with BLOCK=RUNS for those
 *                 that ran
 */
#include "marks.h"
#include "qemu_plugin_api.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/**
 * Data caches of a Zynq-7000 core (UG585 chapter 3): level 1 of 32 KiB with 4 ways, the shared
 * level 2 of 512 KiB with 8 ways, lines of 32 bytes, write back with allocation. The least recently
 * used line goes (the chip's level 1 chooses at random). No prefetch.
 */

enum { line_bytes = 32, l1_ways = 4, l1_sets = 256, l2_ways = 8, l2_sets = 2048 };

typedef struct cache_counts {
  uint64_t accesses, l1_misses, l2_misses;
} cache_counts;

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

/** One access of up to a line. */
static void cache_access(uint64_t address, cache_counts* counts) {
  const uint64_t number = address / line_bytes;
  ++counts->accesses;
  if (look_up(level1[number % l1_sets], l1_ways, number + 1)) return;
  ++counts->l1_misses;
  if (!look_up(level2[number % l2_sets], l2_ways, number + 1)) ++counts->l2_misses;
}

/** Nothing is in the caches. */
static void cache_flush(void) {
  memset(level1, 0, sizeof level1);
  memset(level2, 0, sizeof level2);
}

PLUGIN_EXPORT int qemu_plugin_version = PLUGIN_API_VERSION;

typedef struct block {
  uint64_t number, runs, instructions;
  char** text;
  bool used;
  struct block* next;
} block;

static FILE* out;
static const char* blocks_name;
static bool with_cache;
static bool inside;
static uint64_t instructions; /* of all blocks entered, to their ends */
static uint64_t start;
static cache_counts counts;
static block* blocks;

/* `after` is the number of instructions of the mark's block from the mark on. */
static void on_start(unsigned int vcpu, void* after) {
  (void)vcpu;
  start = instructions - (uintptr_t)after + 1;
  memset(&counts, 0, sizeof counts);
  inside = true;
}

static void on_stop(unsigned int vcpu, void* after) {
  (void)vcpu;
  inside = false;
  fprintf(out, "%llu %llu %llu %llu", (unsigned long long)(instructions - (uintptr_t)after - start),
          (unsigned long long)counts.accesses, (unsigned long long)counts.l1_misses,
          (unsigned long long)counts.l2_misses);
  for (block* b = blocks; b; b = b->next) {
    if (b->runs == 0) continue;
    fprintf(out, " %llu=%llu", (unsigned long long)b->number, (unsigned long long)b->runs);
    b->runs = 0;
    b->used = true;
  }
  fputc('\n', out);
}

static void on_flush(unsigned int vcpu, void* data) {
  (void)vcpu;
  (void)data;
  cache_flush();
}

static void on_access(unsigned int vcpu, qemu_plugin_meminfo_t info, uint64_t address, void* data) {
  (void)vcpu;
  (void)info;
  (void)data;
  static cache_counts outside;
  cache_access(address, inside ? &counts : &outside);
}

static void on_block(unsigned int vcpu, void* data) {
  (void)vcpu;
  if (inside) ++((block*)data)->runs;
}

static void remember(struct qemu_plugin_tb* tb, size_t length) {
  block* b = calloc(1, sizeof *b);
  b->number = blocks ? blocks->number + 1 : 0;
  b->instructions = length;
  b->text = calloc(length, sizeof *b->text);
  for (size_t i = 0; i < length; ++i) {
    b->text[i] = qemu_plugin_insn_disas(qemu_plugin_tb_get_insn(tb, i));
  }
  b->next = blocks;
  blocks = b;
  qemu_plugin_register_vcpu_tb_exec_cb(tb, on_block, QEMU_PLUGIN_CB_NO_REGS, b);
}

static void on_translation(qemu_plugin_id_t id, struct qemu_plugin_tb* tb) {
  (void)id;
  const size_t length = qemu_plugin_tb_n_insns(tb);
  qemu_plugin_register_vcpu_tb_exec_inline(tb, QEMU_PLUGIN_INLINE_ADD_U64, &instructions, length);
  if (blocks_name) remember(tb, length);
  for (size_t i = 0; i < length; ++i) {
    struct qemu_plugin_insn* insn = qemu_plugin_tb_get_insn(tb, i);
    uint32_t code = 0;
    if (qemu_plugin_insn_size(insn) == sizeof code) {
      memcpy(&code, qemu_plugin_insn_data(insn), sizeof code);
    }
    void* after = (void*)(uintptr_t)(length - i);
    if (code == MARK_START) {
      qemu_plugin_register_vcpu_insn_exec_cb(insn, on_start, QEMU_PLUGIN_CB_NO_REGS, after);
    } else if (code == MARK_STOP) {
      qemu_plugin_register_vcpu_insn_exec_cb(insn, on_stop, QEMU_PLUGIN_CB_NO_REGS, after);
    } else if (code == MARK_FLUSH) {
      qemu_plugin_register_vcpu_insn_exec_cb(insn, on_flush, QEMU_PLUGIN_CB_NO_REGS, NULL);
    }
    if (with_cache) {
      qemu_plugin_register_vcpu_mem_cb(insn, on_access, QEMU_PLUGIN_CB_NO_REGS, QEMU_PLUGIN_MEM_RW,
                                       NULL);
    }
  }
}

static void on_end(qemu_plugin_id_t id, void* data) {
  (void)id;
  (void)data;
  if (out) fclose(out);
  if (!blocks_name) return;
  FILE* file = fopen(blocks_name, "w");
  if (!file) return;
  for (const block* b = blocks; b; b = b->next) {
    if (!b->used) continue;
    fprintf(file, "block %llu\n", (unsigned long long)b->number);
    for (size_t i = 0; i < b->instructions; ++i) fprintf(file, "%s\n", b->text[i]);
  }
  fclose(file);
}

PLUGIN_EXPORT int qemu_plugin_install(qemu_plugin_id_t id, const qemu_info_t* info, int argc,
                                      char** argv) {
  (void)info;
  for (int i = 0; i < argc; ++i) {
    if (strncmp(argv[i], "out=", 4) == 0) {
      out = fopen(argv[i] + 4, "w");
    } else if (strncmp(argv[i], "blocks=", 7) == 0) {
      blocks_name = strdup(argv[i] + 7);
    } else if (strcmp(argv[i], "cache=on") == 0) {
      with_cache = true;
    } else {
      fprintf(stderr, "count: unknown option '%s'\n", argv[i]);
      return 1;
    }
  }
  if (!out) {
    fprintf(stderr, "count: give out=FILE, in a folder that may be written\n");
    return 1;
  }
  qemu_plugin_register_vcpu_tb_trans_cb(id, on_translation);
  qemu_plugin_register_atexit_cb(id, on_end, NULL);
  return 0;
}
