/* What programs without annotations do, one thing a run: the device says which
 * (plain_program_test.cpp). */
#include <hal/hal.h>
#include <stdlib.h>

#define DEVICE 0x40000000u
#define REGISTER(type) (*(volatile type*)DEVICE)

static volatile int never;
static volatile int ticks;
static uint32_t variable = 0x12345678;
static uint32_t cleared[1000];

static void report(const void* pointer) {
  hal_write32(DEVICE, (uint32_t)(uintptr_t)pointer);
  hal_write32(DEVICE, (uint32_t)((uintptr_t)pointer >> 32));
}

static void where_data_lie(void) {
  uint32_t local = 3;
  uint32_t* const block = malloc(sizeof *block);
  cleared[999] = 1;
  *block = 2;
  report(&variable);
  report(&cleared[999]);
  report(block);
  report(&local);
  free(block);
}

static int use_heap(void) {
  unsigned char* blocks[64];
  for (int i = 0; i < 64; ++i) {
    blocks[i] = malloc((size_t)(i * 37));
    for (int k = 0; k < i * 37; ++k) blocks[i][k] = (unsigned char)i;
  }
  for (int i = 0; i < 64; i += 2) free(blocks[i]);
  unsigned char* const large = calloc(5000, 1);
  unsigned char* const aligned = aligned_alloc(4096, 100);
  int wrong = (uintptr_t)aligned % 4096 != 0;
  for (int i = 0; i < 5000; ++i) wrong += large[i] != 0;
  for (int i = 1; i < 64; i += 2) {
    blocks[i] = realloc(blocks[i], 4000);
    for (int k = 0; k < i * 37; ++k) wrong += blocks[i][k] != i;
    free(blocks[i]);
  }
  free(large);
  free(aligned);
  wrong += malloc((size_t)1 << 40) != NULL;
  /* All of it is one block again. */
  void* const most = malloc(100 << 10);
  wrong += most > (void*)blocks;
  free(most);
  return wrong;
}

static int registers_by_pointer(void) {
  int wrong = 0;
  REGISTER(uint32_t) = 0xCAFE0001;
  wrong += REGISTER(uint32_t) != 0x89ABCDEF;
  wrong += REGISTER(uint16_t) != 0xCDEF;
  wrong += REGISTER(int8_t) != -17;
  REGISTER(uint8_t) = 0x55;
  REGISTER(float) = 1.0f;
  REGISTER(uint32_t) |= 0x10;
  wrong += REGISTER(unsigned long) != 0x89ABCDEF;
  REGISTER(unsigned long) = 7;
  return wrong;
}

static void on_tick(void* context) {
  (void)context;
  hal_write32(DEVICE, 1);
  ++ticks;
}

/* Returns how many ticks came while it computed. */
static int compute(void) {
  unsigned sum = 0;
  hal_interrupt_connect(on_tick, NULL);
  hal_interrupt_enable(true);
  for (unsigned i = 0; i < 300000; ++i) sum += i * i;
  hal_interrupt_enable(false);
  return sum != 0 ? ticks : -1;
}

static int leave_interrupts_on(void) {
  hal_interrupt_connect(on_tick, NULL);
  hal_interrupt_enable(true);
  return 3;
}

static int deep(int depth) {
  volatile char room[1000];
  room[0] = (char)depth;
  return depth == 0 ? 0 : deep(depth - 1) + room[0];
}

/* Loops round what compilers make a table of jumps of; only the second one has a way out. */
static void switches_for_ever(void) {
  for (unsigned number = 0;; ++number) {
    switch (number % 6) {
      case 0:
        hal_write32(DEVICE, 10);
        break;
      case 1:
        hal_write32(DEVICE, 11);
        break;
      case 2:
        hal_write32(DEVICE, 12);
        break;
      case 3:
        hal_write32(DEVICE, 13);
        break;
      case 4:
        hal_write32(DEVICE, 14);
        break;
    }
  }
}

static int switches(void) {
  for (unsigned number = 0;; ++number) {
    switch (number % 6) {
      case 0:
        hal_write32(DEVICE, 10);
        break;
      case 1:
        hal_write32(DEVICE, 11);
        break;
      case 2:
        hal_write32(DEVICE, 12);
        break;
      case 3:
        if (never) return 0;
        break;
      case 4:
        hal_write32(DEVICE, 14);
        break;
    }
  }
}

static void second(void) {
  hal_write32(DEVICE, 21);
}

/* As programs do that know the boot code. */
static int start_second(void) {
  hal_write32(0xFFFFFFF0u, (uint32_t)(uintptr_t)&second);
  __asm__("sev");
  return 0;
}

int main(int argc, char** argv) {
  switch (hal_read32(DEVICE)) {
    case 0:
      for (;;) hal_write32(DEVICE, 1);
    case 1:
      for (;;)
        ;
    case 2:
      while (!never)
        ;
      return 0;
    case 3:
      for (;;) {
        while (!never)
          ;
        hal_write32(DEVICE, 2);
      }
    case 4:
      for (;;) hal_wait_for_interrupt();
    case 5:
      where_data_lie();
      return 0;
    case 6:
      return use_heap();
    case 7:
      return deep(1000000);
    case 8:
      return compute();
    case 9:
      return leave_interrupts_on();
    case 10:
      switches_for_ever();
      return 0;
    case 11:
      return switches();
    case 12:
      return start_second();
    case 13:
      return argc != 0 || argv != NULL;
    case 14:
      hal_interrupt_connect(on_tick, NULL);
      for (;;)
        ;
    default:
      return registers_by_pointer();
  }
}
