/* What goes wrong in Linux applications, a mistake a word of the command line. */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <fts.h>
#include <ftw.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>
#include <wordexp.h>

enum { DATA = 0, TRI = 1, NO_REGISTER = 100 };

static void* map_at(off_t offset, int how) {
  const int file = open("/dev/mem", O_RDWR | O_SYNC);
  if (file < 0) exit(10);
  void* got = mmap(NULL, 4096, PROT_READ | PROT_WRITE, how, file, offset);
  if (got == MAP_FAILED) exit(11);
  return got;
}

static volatile uint32_t* gpio(void) {
  return map_at(0x41200000, MAP_SHARED);
}

static void unmapped(void) {
  *(volatile uint32_t*)map_at(0x50000000, MAP_SHARED) = 1;
}

static void no_register(void) {
  gpio()[NO_REGISTER] = 1;
}

static void unaligned(void) {
  *(volatile uint32_t*)((volatile char*)gpio() + 2) = 1;
}

static void wide(void) {
  volatile unsigned long* registers = (volatile unsigned long*)gpio();
  registers[0] = 1;
}

static void vector(void) {
  typedef int words __attribute__((vector_size(16)));
  volatile words* const registers = (volatile words*)gpio();
  volatile words copy = *registers;
  if (copy[0] == 7) puts("seven");
}

static void atomic(void) {
  __atomic_fetch_add(gpio(), 1, __ATOMIC_SEQ_CST);
}

static void copying(void) {
  volatile uint32_t* const registers = gpio();
  void *from = (void*)registers, *to = (void*)(registers + 2);
  size_t count = 1;
  __asm__ volatile("rep movsl" : "+S"(from), "+D"(to), "+c"(count) : : "memory");
}

static void private_map(void) {
  map_at(0x41200000, MAP_PRIVATE);
}

static void null_pointer(void) {
  *(volatile int*)8 = 1;
}

static void read_only(void) {
  const int file = open("/dev/mem", O_RDONLY);
  volatile uint32_t* registers = mmap(NULL, 4096, PROT_READ, MAP_SHARED, file, 0x41200000);
  registers[DATA] = 1;
}

static void aborts(void) {
  abort();
}

static void endless(void) {
  volatile uint32_t* const registers = gpio();
  while ((registers[DATA] & 0x80) == 0) continue;
}

static void computing(void) {
  volatile unsigned spins = 0;
  gpio()[TRI] = 0;
  while (1) ++spins;
}

static void sleeping(void) {
  sleep(1000);
}

static void waiting(void) {
  uint32_t count = 0;
  const int file = open("/dev/uio0", O_RDWR);
  if (read(file, &count, sizeof count) != sizeof count) exit(12);
}

static void masked(void) {
  uint32_t off = 0;
  const int file = open("/dev/uio0", O_RDWR);
  if (write(file, &off, sizeof off) != sizeof off) exit(12);
  if (read(file, &off, sizeof off) != sizeof off) exit(13);
}

static void no_interrupt(void) {
  uint32_t count = 0;
  const int file = open("/dev/uio2", O_RDWR);
  struct pollfd wanted = {file, POLLIN, 0};
  if (poll(&wanted, 1, -1) != 1) exit(12);
  if (read(file, &count, sizeof count) != -1 || errno != EIO) exit(13);
  if (write(file, &count, sizeof count) != -1 || errno != EIO) exit(14);
}

/* A buffer that the program has as a constant, and the board's tree would reserve. */
static void constant_address(void) {
  volatile uint32_t* const dma = map_at(0x40400000, MAP_SHARED);
  gpio()[DATA] = 0x10;
  dma[0] = 1;
  dma[6] = 0x18000000;
  dma[10] = 128;
  usleep(100);
}

static void* touch(void* registers) {
  ((volatile uint32_t*)registers)[DATA] = 1;
  return NULL;
}

static void threads(void) {
  volatile uint32_t* const registers = gpio();
  pthread_t other;
  registers[TRI] = 0;
  if (pthread_create(&other, NULL, touch, (void*)registers) != 0) exit(12);
  pthread_join(other, NULL);
}

static void forks(void) {
  volatile uint32_t* const registers = gpio();
  registers[TRI] = 0;
  if (fork() == 0) {
    registers[DATA] = 1;
    _exit(0);
  }
  registers[DATA] = 2;
  wait(NULL);
  registers[DATA] = 3;
}

static void starts(void) {
  if (system("exec 3<> /dev/uio0") != 0) exit(7);
}

static void becomes(void) {
  execl("/bin/sleep", "sleep", "100", (char*)NULL);
}

static void stream(void) {
  if (fopen("/dev/uio0", "r+") == NULL) exit(12);
}

static void unflushed(void) {
  const int file = open("/dev/udmabuf0", O_RDWR);
  volatile uint32_t* words = mmap(NULL, 4096, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  volatile uint32_t* dma = map_at(0x40400000, MAP_SHARED);
  char text[32] = "";
  FILE* address = fopen("/sys/class/u-dma-buf/udmabuf0/phys_addr", "r");
  if (!address || !fgets(text, sizeof text, address)) exit(12);
  words[0] = 5;
  gpio()[DATA] = 0x10; /* the image store takes words */
  dma[0] = 1;
  dma[6] = (uint32_t)strtoul(text, NULL, 0);
  dma[10] = 128;
  usleep(100);
}

/* The interrupt that a level keeps up is there again as soon as it is unmasked. */
static void uncleared(void) {
  uint32_t count = 0, on = 1;
  const int file = open("/dev/uio0", O_RDWR);
  volatile uint32_t* dma = map_at(0x40400000, MAP_SHARED);
  map_at(0x18000000, MAP_SHARED);
  gpio()[DATA] = 0x10;
  dma[0] = 0x1001;
  dma[6] = 0x18000000;
  dma[10] = 128;
  for (int i = 0; i < 2; ++i) {
    if (read(file, &count, sizeof count) != sizeof count) exit(12);
    if (write(file, &on, sizeof on) != sizeof on) exit(13);
  }
  if (count != 2) exit(14);
}

static void beyond(void) {
  volatile uint32_t* dma = map_at(0x40400000, MAP_SHARED);
  gpio()[DATA] = 0x10;
  dma[0] = 1;
  dma[6] = 0x80000000;
  dma[10] = 128;
  usleep(100);
}

static void no_device(void) {
  if (open("/dev/uio9", O_RDWR) >= 0 || errno != ENOENT) exit(1);
}

static void beyond_a_map(void) {
  const int file = open("/dev/uio0", O_RDWR);
  if (mmap(NULL, 0x20000, PROT_READ, MAP_SHARED, file, 0) != MAP_FAILED || errno != EINVAL) exit(1);
  if (mmap(NULL, 4096, PROT_READ, MAP_SHARED, file, 4096) != MAP_FAILED || errno != EINVAL) exit(1);
}

/* Waits for a signal in a child, too: nothing of it may be left. */
static void two_processes(void) {
  volatile uint32_t* const registers = gpio();
  if (fork() == 0) {
    while (1) pause();
  }
  puts("two");
  while (1) registers[DATA] = 1;
}

static void leaves_a_copy(void) {
  gpio()[TRI] = 0;
  if (fork() == 0) {
    while (1) pause();
  }
}

static volatile sig_atomic_t has_heard;

static void hear(int number) { has_heard = number; }

/* It ends as it is asked for its place. */
static void leaves_a_copy_late(void) {
  signal(SIGXCPU, hear);
  leaves_a_copy();
  while (!has_heard) continue;
}

/* Only a sanitizer sees it. */
static void beyond_an_array(void) {
  volatile char* const bytes = malloc(8);
  gpio()[TRI] = 0;
  bytes[8] = 1;
  free((void*)bytes);
}

static void leaks(void) {
  while (open("/dev/uio0", O_RDWR) >= 0) continue;
}

static int visit(const char* path, const struct stat* status, int flag, struct FTW* where) {
  return path == NULL && status == NULL && flag == 0 && where == NULL;
}

static void walks(void) {
  nftw("/sys/class/uio", visit, 8, 0);
}

static void walks_by_fts(void) {
  char* const paths[] = {(char*)"/dev/uio0", NULL};
  fts_open(paths, FTS_PHYSICAL, NULL);
}

static void expands(void) {
  wordexp_t words;
  wordexp("one /sys/class/uio/uio*", &words, 0);
}

static void reopens(void) {
  if (freopen("/dev/uio0", "r+", stdin) == NULL) exit(12);
}

int main(int count, char** words) {
  const struct {
    const char* name;
    void (*make)(void);
  } mistakes[] = {{"unmapped", unmapped},
                  {"no_register", no_register},
                  {"unaligned", unaligned},
                  {"wide", wide},
                  {"vector", vector},
                  {"atomic", atomic},
                  {"copying", copying},
                  {"private_map", private_map},
                  {"null_pointer", null_pointer},
                  {"read_only", read_only},
                  {"aborts", aborts},
                  {"endless", endless},
                  {"computing", computing},
                  {"sleeping", sleeping},
                  {"waiting", waiting},
                  {"masked", masked},
                  {"no_interrupt", no_interrupt},
                  {"constant_address", constant_address},
                  {"threads", threads},
                  {"forks", forks},
                  {"starts", starts},
                  {"becomes", becomes},
                  {"stream", stream},
                  {"walks", walks},
                  {"walks_by_fts", walks_by_fts},
                  {"expands", expands},
                  {"reopens", reopens},
                  {"unflushed", unflushed},
                  {"uncleared", uncleared},
                  {"beyond", beyond},
                  {"no_device", no_device},
                  {"beyond_a_map", beyond_a_map},
                  {"two_processes", two_processes},
                  {"leaks", leaks},
                  {"beyond_an_array", beyond_an_array},
                  {"leaves_a_copy", leaves_a_copy},
                  {"leaves_a_copy_late", leaves_a_copy_late}};
  for (unsigned i = 0; i < sizeof mistakes / sizeof *mistakes; ++i) {
    if (count == 2 && strcmp(words[1], mistakes[i].name) == 0) {
      mistakes[i].make();
      return 0;
    }
  }
  return 1;
}
