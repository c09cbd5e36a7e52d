/* What a Linux application may do, a case a word of the command line. Ends with 0 if all is right.
 */
#define _GNU_SOURCE
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/mman.h>
#include <sys/select.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#define OCM 0xFFFC0000
#define DMA 0x40400000
#define CLASS "/sys/class/u-dma-buf/udmabuf0/"

#define EXPECT(condition)                                           \
  do {                                                              \
    if (condition) break;                                           \
    printf("%s:%d: not so: %s\n", "works.c", __LINE__, #condition); \
    exit(1);                                                        \
  } while (0)

static int open_file(const char* path, int flags) {
  const int file = open(path, flags);
  if (file < 0) perror(path);
  EXPECT(file >= 0);
  return file;
}

static volatile uint32_t* map(int file, size_t size, off_t offset) {
  void* got = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED, file, offset);
  EXPECT(got != MAP_FAILED);
  return got;
}

static uint64_t now_us(void) {
  struct timespec now;
  EXPECT(clock_gettime(CLOCK_MONOTONIC, &now) == 0);
  return (uint64_t)now.tv_sec * 1000000 + (uint64_t)now.tv_nsec / 1000;
}

/* Each kind of access that compilers make of volatile variables; the same must come of registers as
 * of memory. */
struct words {
  uint32_t word;
  int32_t number;
  union {
    uint16_t half[2];
    uint8_t byte[4];
    int8_t small[4];
  } part;
  float real;
};

static uint64_t exercise(volatile struct words* w) {
  uint64_t sum = 0;
#define NOTE(value) sum = sum * 31 + (uint64_t)(value)
  w->word = 0x12345678;
  NOTE(w->word);
  w->word |= 0x80000001;
  NOTE(w->word);
  w->word &= ~0x10u;
  NOTE(w->word);
  w->word ^= 0xFFFF;
  NOTE(w->word);
  w->word += 77;
  w->word -= 5;
  NOTE(w->word);
  ++w->word;
  NOTE(w->word--);
  w->word <<= 3;
  w->word >>= 1;
  NOTE(w->word);
  w->word = ~w->word;
  w->word = -w->word;
  NOTE(w->word);
  NOTE(w->word * 3);
  if (w->word == 5) NOTE(1);
  if (w->word & 4) NOTE(2);
  if (w->word > sum) NOTE(3);
  w->number = -2;
  NOTE(w->number);
  NOTE((int64_t)w->number);
  NOTE(w->number < 0);
  w->part.half[0] = 0xA5A5;
  w->part.half[1] = 0x8001;
  NOTE(w->part.half[0]);
  NOTE((int16_t)w->part.half[1]);
  w->part.half[1] += 3;
  NOTE(w->part.half[1]);
  w->part.byte[3] = 0x81;
  NOTE(w->part.byte[3]);
  NOTE(w->part.small[3]);
  w->part.byte[1] |= 0x0F;
  w->part.byte[2] = w->word > 7;
  NOTE(w->part.byte[1]);
  NOTE(w->part.byte[2]);
  w->real = 1.5f;
  NOTE(w->real * 4);
  w->real += 2.0f;
  NOTE(w->real);
  w->word = (uint32_t)sum;
  NOTE(w->word ? w->number : 9);
  return sum;
}

static int accesses(void) {
  static struct words memory;
  volatile struct words* registers =
      (volatile struct words*)map(open_file("/dev/mem", O_RDWR | O_SYNC), 4096, OCM);
  EXPECT((uintptr_t)registers >> 31 == 0); /* programs for 32 bits keep it in an int */
  const uint64_t expected = exercise(&memory), got = exercise(registers);
  EXPECT(got == expected);
  EXPECT(registers->word == memory.word && registers->part.half[0] == memory.part.half[0]);
  return 0;
}

/* Of the C library, whose own instructions are as wide as the computer has them. */
static int copies(volatile uint32_t* registers) {
  void* (*volatile copy)(void*, const void*, size_t) = memcpy;
  void* (*volatile move)(void*, const void*, size_t) = memmove;
  void* (*volatile fill)(void*, int, size_t) = memset;
  uint32_t from[40], to[41] = {0};
  for (uint32_t i = 0; i < 40; ++i) from[i] = 0x01020304 * i;
  EXPECT(copy((void*)registers, from, sizeof from) == (void*)registers);
  for (int i = 0; i < 40; ++i) EXPECT(registers[i] == from[i]);
  EXPECT(copy((char*)to + 1, (void*)registers, 157) == (char*)to + 1);
  EXPECT(memcmp((char*)to + 1, from, 157) == 0 && ((char*)to)[158] == 0);
  move((void*)(registers + 1), (void*)registers, 12);
  EXPECT(registers[1] == from[0] && registers[2] == from[1] && registers[3] == from[2]);
  move((void*)registers, (void*)(registers + 1), 12);
  EXPECT(registers[0] == from[0] && registers[1] == from[1] && registers[2] == from[2]);
  fill((void*)registers, 0xA5, 16);
  EXPECT(registers[3] == 0xA5A5A5A5 && registers[4] == from[4]);
  return 0;
}

/* The ways to copy that need no wide accesses. */
static int strings(void) {
  volatile uint32_t* registers = map(open_file("/dev/mem", O_RDWR), 4096, OCM + 0x1000);
  uint32_t from[8], to[8];
  for (int i = 0; i < 8; ++i) from[i] = 0x01010101u * (uint32_t)i + 0xA0000000;
  const void* source = from;
  void* target = (void*)registers;
  size_t count = 8;
  __asm__ volatile("rep movsl" : "+S"(source), "+D"(target), "+c"(count) : : "memory");
  source = (const void*)registers;
  target = to;
  count = 8;
  __asm__ volatile("rep movsl" : "+S"(source), "+D"(target), "+c"(count) : : "memory");
  EXPECT(memcmp(from, to, sizeof to) == 0);
  target = (void*)registers;
  count = 8;
  __asm__ volatile("rep stosl" : "+D"(target), "+c"(count) : "a"(7) : "memory");
  for (int i = 0; i < 8; ++i) EXPECT(registers[i] == 7);
  return copies(registers);
}

static void write_text(const char* path, const char* text) {
  const int file = open_file(path, O_WRONLY);
  EXPECT(write(file, text, strlen(text)) == (ssize_t)strlen(text));
  EXPECT(close(file) == 0);
}

static unsigned long number_in(const char* path) {
  char text[64] = "";
  FILE* file = fopen(path, "r");
  EXPECT(file && fgets(text, sizeof text, file));
  fclose(file);
  return strtoul(text, NULL, 0);
}

/* The first of a file, up to a zero. */
static const char* text_in(const char* path) {
  static char text[64];
  FILE* file = fopen(path, "r");
  EXPECT(file != NULL);
  text[fread(text, 1, sizeof text - 1, file)] = '\0';
  fclose(file);
  return text;
}

/* The same as programs look for it in the device tree. */
static int device_tree(void) {
  const char* const dma = "/sys/firmware/devicetree/base/amba_pl/dma@40400000";
  char path[128], text[256] = "";
  EXPECT(strcmp(text_in("/proc/device-tree/compatible"), "xlnx,zynq-7000") == 0);
  EXPECT(realpath("/proc/device-tree/amba_pl/dma@40400000", path) && strcmp(path, dma) == 0);
  EXPECT(realpath("/sys/class/uio/uio1/device/of_node", path) && strcmp(path, dma) == 0);
  EXPECT(chdir(dma) == 0);
  const int file = open_file("compatible", O_RDONLY);
  const char expected[] = "xlnx,axi-dma-7.1\0xlnx,axi-dma-1.00.a\0generic-uio";
  EXPECT(read(file, text, sizeof text) == sizeof expected);
  EXPECT(memcmp(text, expected, sizeof expected) == 0);
  close(file);
  const int reg = open_file("reg", O_RDONLY);
  EXPECT(read(reg, text, sizeof text) == 8 && memcmp(text, "\x40\x40\0\0\0\1\0\0", 8) == 0);
  close(reg);
  EXPECT(strcmp(text_in("../gpio@41230000/linux,uio-name"), "my-buttons") == 0);
  EXPECT(access("/proc/device-tree/nothing", F_OK) == -1 && errno == ENOENT);
  return chdir("/");
}

/* What is there to be found, as programs look for it. */
static int tree(void) {
  DIR* folder = opendir("/sys/class/uio");
  EXPECT(folder != NULL);
  unsigned found = 0;
  for (struct dirent* entry; (entry = readdir(folder));) found += entry->d_name[0] != '.';
  closedir(folder);
  EXPECT(found == 3);
  struct stat status;
  EXPECT(stat("/dev/uio2", &status) == 0 && access("/dev/mem", R_OK | W_OK) == 0);
  EXPECT(open("/dev/uio3", O_RDWR) == -1 && errno == ENOENT);
  EXPECT(open("/dev/udmabuf1", O_RDWR) == -1 && errno == ENOENT);
  char text[64] = "";
  const int name = open_file("/sys/class/uio/uio1/name", O_RDONLY);
  EXPECT(read(name, text, sizeof text) > 0 && strcmp(text, "dma\n") == 0);
  close(name);
  EXPECT(strcmp(text_in("/sys/class/uio/uio2/name"), "my-buttons\n") == 0);
  EXPECT(strcmp(text_in("/sys/class/uio/uio1/maps/map0/name"), "dma@40400000\n") == 0);
  EXPECT(strcmp(text_in("/sys/class/uio/uio1/maps/map0/addr"), "0x40400000\n") == 0);
  EXPECT(number_in("/sys/class/uio/uio1/maps/map0/addr") == DMA);
  EXPECT(number_in("/sys/class/uio/uio1/maps/map0/size") == 0x10000);
  EXPECT(number_in("/sys/class/uio/uio1/maps/map0/offset") == 0);
  EXPECT(number_in(CLASS "size") == 1 << 20);
  EXPECT(number_in(CLASS "sync_mode") == 1);
  write_text(CLASS "sync_offset", "4096");
  EXPECT(number_in("/sys/class/udmabuf/udmabuf0/sync_offset") == 4096);
  const int wrong = open_file(CLASS "sync_size", O_WRONLY);
  EXPECT(write(wrong, "9999999", 7) == -1 && errno == EINVAL);
  EXPECT(write(wrong, "soon", 4) == -1 && errno == EINVAL);
  close(wrong);
  EXPECT(open(CLASS "phys_addr", O_WRONLY) == -1 && errno == EACCES);
  const int uio = open_file("/dev/uio1", O_RDWR);
  EXPECT(read(uio, text, 8) == -1 && errno == EINVAL);
  EXPECT(write(uio, text, 1) == -1 && errno == EINVAL);
  return 0;
}

enum { MM2S = 0, S2MM = 0x30 / 4, CONTROL = 0, STATUS = 1, ADDRESS = 6, LENGTH = 10 };
enum { HALF = 1 << 19, BYTES = 8192 };

struct loop {
  int uio;
  volatile uint32_t* dma;
  uint8_t* buffer;
  uint32_t address;
};

static struct loop begin(int buffer_flags, int uio_flags) {
  struct loop l;
  l.uio = open_file("/dev/uio1", O_RDWR | uio_flags);
  l.dma = map(l.uio, 0x10000, 0);
  const int file = open_file("/dev/udmabuf0", O_RDWR | buffer_flags);
  l.buffer = (uint8_t*)map(file, 2 * HALF, 0);
  close(file); /* the mapping stays */
  l.address = (uint32_t)number_in(CLASS "phys_addr");
  return l;
}

static void start(const struct loop* l) {
  for (int i = 0; i < BYTES; ++i) l->buffer[i] = (uint8_t)(i * 7);
}

static void copy(const struct loop* l) {
  volatile uint32_t *from = l->dma + MM2S, *to = l->dma + S2MM;
  to[CONTROL] = 0x1001;
  to[ADDRESS] = l->address + HALF;
  to[LENGTH] = BYTES;
  from[CONTROL] = 1;
  from[ADDRESS] = l->address;
  from[LENGTH] = BYTES;
}

static void acknowledge(const struct loop* l) {
  EXPECT(l->dma[S2MM + STATUS] & 0x1000);
  l->dma[S2MM + STATUS] = 0x1000;
}

static void unmask(const struct loop* l) {
  const uint32_t on = 1;
  EXPECT(write(l->uio, &on, sizeof on) == sizeof on);
}

static uint32_t await(const struct loop* l) {
  uint32_t count = 0;
  EXPECT(read(l->uio, &count, sizeof count) == sizeof count);
  return count;
}

static void compare(const struct loop* l) {
  EXPECT(memcmp(l->buffer, l->buffer + HALF, BYTES) == 0);
  memset(l->buffer + HALF, 0, BYTES);
}

static void synchronise(const char* attribute, const char* offset, const char* direction) {
  write_text(CLASS "sync_offset", offset);
  write_text(CLASS "sync_size", "8192");
  write_text(CLASS "sync_direction", direction);
  write_text(attribute, "1");
}

/* A cached buffer, whose caches are maintained. */
static int cached_loop(void) {
  const struct loop l = begin(0, 0);
  start(&l);
  synchronise(CLASS "sync_for_device", "0", "1");
  synchronise(CLASS "sync_for_device", "0x80000", "2");
  for (uint32_t i = 1; i <= 3; ++i) {
    copy(&l);
    EXPECT(await(&l) == i);
    acknowledge(&l);
    unmask(&l);
    synchronise(CLASS "sync_for_cpu", "0x80000", "2");
    EXPECT(memcmp(l.buffer, l.buffer + HALF, BYTES) == 0);
  }
  return 0;
}

/* The same by the long form of the attributes, through a stream. */
static int stream_loop(void) {
  const struct loop l = begin(0, 0);
  start(&l);
  FILE* file = fopen(CLASS "sync_for_device", "w");
  EXPECT(file != NULL);
  EXPECT(fprintf(file, "0x%08X%08X", 0, BYTES | 1 << 2 | 1) > 0 && fflush(file) == 0);
  EXPECT(fprintf(file, "0x%08X%08X", HALF, BYTES | 2 << 2 | 1) > 0 && fclose(file) == 0);
  copy(&l);
  EXPECT(await(&l) == 1);
  file = fopen(CLASS "sync_for_cpu", "w");
  EXPECT(file && fprintf(file, "0x%08X%08X", HALF, BYTES | 2 << 2 | 1) > 0 && fclose(file) == 0);
  compare(&l);
  return 0;
}

/* An uncached one needs none; each way to wait. */
static int waiting(void) {
  const struct loop l = begin(O_SYNC, O_NONBLOCK);
  uint32_t count = 0;
  EXPECT(read(l.uio, &count, sizeof count) == -1 && errno == EAGAIN);
  start(&l);

  struct pollfd wanted = {l.uio, POLLIN, 0};
  const uint64_t before = now_us();
  EXPECT(poll(&wanted, 1, 2) == 0);
  EXPECT(now_us() - before >= 2000 && now_us() - before < 2200);
  copy(&l);
  EXPECT(poll(&wanted, 1, -1) == 1 && wanted.revents == POLLIN);
  EXPECT(now_us() - before < 2400);
  EXPECT(poll(&wanted, 1, 0) == 1 && await(&l) == 1 && poll(&wanted, 1, 0) == 0);
  acknowledge(&l);
  unmask(&l);
  compare(&l);

  copy(&l);
  fd_set files;
  FD_ZERO(&files);
  FD_SET(l.uio, &files);
  struct timeval limit = {1, 0};
  EXPECT(select(l.uio + 1, &files, NULL, NULL, &limit) == 1 && FD_ISSET(l.uio, &files));
  const int other = dup(l.uio);
  EXPECT(other >= 0 && close(l.uio) == 0);
  struct loop again = l;
  again.uio = other;
  EXPECT(await(&again) == 2);
  acknowledge(&again);
  unmask(&again);
  compare(&again);

  const int many = epoll_create1(0);
  struct epoll_event event = {.events = EPOLLIN, .data = {.u32 = 5}};
  EXPECT(epoll_ctl(many, EPOLL_CTL_ADD, other, &event) == 0);
  EXPECT(epoll_wait(many, &event, 1, 1) == 0);
  copy(&again);
  EXPECT(epoll_wait(many, &event, 1, 1000) == 1 && event.data.u32 == 5);
  EXPECT(await(&again) == 3);

  /* Masked: the second interrupt does not come before it is unmasked. */
  acknowledge(&again);
  copy(&again);
  EXPECT(epoll_wait(many, &event, 1, 5) == 0);
  unmask(&again);
  EXPECT(epoll_wait(many, &event, 1, 5) == 1 && await(&again) == 4);
  const uint32_t off = 0;
  acknowledge(&again);
  unmask(&again);
  EXPECT(write(other, &off, sizeof off) == sizeof off);
  copy(&again);
  EXPECT(epoll_wait(many, &event, 1, 5) == 0);
  compare(&again);
  return 0;
}

/* A copy takes an interrupt; what comes behind is the other's, with the same descriptor. */
static int copied(void) {
  const struct loop l = begin(O_SYNC, O_NONBLOCK);
  start(&l);
  struct pollfd wanted = {l.uio, POLLIN, 0};
  for (uint32_t i = 1; i <= 5; i += 2) {
    copy(&l);
    EXPECT(poll(&wanted, 1, 5) == 1);
    const pid_t child = fork();
    if (child == 0) {
      EXPECT(await(&l) == i);
      acknowledge(&l);
      unmask(&l);
      _exit(0);
    }
    int status = 0;
    EXPECT(waitpid(child, &status, 0) == child && status == 0);
    EXPECT(poll(&wanted, 1, 1) == 0);
    copy(&l);
    EXPECT(poll(&wanted, 1, 5) == 1 && await(&l) == i + 1);
    acknowledge(&l);
    unmask(&l);
  }
  compare(&l);
  return 0;
}

/* The DDR through /dev/mem is what the engine reads. */
static int memory(void) {
  const struct loop l = begin(O_SYNC, 0);
  volatile uint32_t* words = map(open_file("/dev/mem", O_RDWR | O_SYNC), BYTES, l.address);
  for (uint32_t i = 0; i < BYTES / 4; ++i) words[i] = i * i;
  copy(&l);
  EXPECT(await(&l) == 1);
  EXPECT(memcmp(l.buffer, l.buffer + HALF, BYTES) == 0);
  EXPECT(munmap((void*)words, BYTES) == 0);
  volatile uint32_t* part = map(open_file("/dev/mem", O_RDWR), 8192, OCM);
  part[1024] = 5;
  EXPECT(munmap((void*)part, 4096) == 0);
  EXPECT(part[1024] == 5);
  return 0;
}

static int times(void) {
  uint64_t before = now_us();
  usleep(300);
  EXPECT(now_us() - before >= 300 && now_us() - before < 320);
  const struct timespec ms = {0, 1000000};
  before = now_us();
  EXPECT(nanosleep(&ms, NULL) == 0);
  EXPECT(now_us() - before >= 1000 && now_us() - before < 1020);
  const struct timespec wrong = {0, -1};
  EXPECT(nanosleep(&wrong, NULL) == -1 && errno == EINVAL);
  struct timespec until;
  clock_gettime(CLOCK_MONOTONIC, &until);
  until.tv_nsec += 2000000;
  before = now_us();
  EXPECT(clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, NULL) == 0);
  EXPECT(now_us() - before >= 1990 && now_us() - before < 2020);
  EXPECT(sleep(1) == 0 && time(NULL) == 1);
  EXPECT(poll(NULL, 0, 3) == 0);
  printf("%llu us\n", (unsigned long long)now_us());
  return 0;
}

static volatile uint32_t* in_handler;

static void on_user(int number) {
  (void)number;
  in_handler[0] = in_handler[0] + 1;
}

static void on_fault(int number) {
  (void)number;
  _exit(5);
}

/* Handlers and masks of its own; an environment that is gone. */
static int signals(void) {
  volatile uint32_t* registers = map(open_file("/dev/mem", O_RDWR), 4096, OCM);
  in_handler = registers;
  struct sigaction action = {.sa_handler = on_user}, before;
  sigfillset(&action.sa_mask);
  EXPECT(sigaction(SIGUSR1, &action, NULL) == 0);
  EXPECT(signal(SIGSEGV, on_fault) == SIG_DFL);
  EXPECT(sigaction(SIGSEGV, NULL, &before) == 0 && before.sa_handler == on_fault);
  registers[0] = 1;
  EXPECT(raise(SIGUSR1) == 0 && registers[0] == 2);
  sigset_t all;
  sigfillset(&all);
  EXPECT(sigprocmask(SIG_SETMASK, &all, NULL) == 0);
  registers[0] |= 8;
  EXPECT(registers[0] == 10);
  EXPECT(mprotect((void*)registers, 4096, PROT_READ | PROT_WRITE) == 0);
  registers[0] = 3;
  EXPECT(registers[0] == 3);
  clearenv();
  EXPECT(access("/dev/uio0", F_OK) == 0);
  volatile uintptr_t nowhere = 8;
  *(volatile int*)nowhere = 1;
  return 1;
}

static int environment(int count, char** words) {
  EXPECT(count == 5 && strcmp(words[2], "-v") == 0 && strcmp(words[3], "two words") == 0);
  printf("no line end, exit code %s", words[4]);
  return atoi(words[4]);
}

int main(int count, char** words) {
  const char* const what = count > 1 ? words[1] : "";
  if (strcmp(what, "accesses") == 0) return accesses();
  if (strcmp(what, "strings") == 0) return strings();
  if (strcmp(what, "tree") == 0) return tree();
  if (strcmp(what, "device_tree") == 0) return device_tree();
  if (strcmp(what, "cached_loop") == 0) return cached_loop();
  if (strcmp(what, "stream_loop") == 0) return stream_loop();
  if (strcmp(what, "waiting") == 0) return waiting();
  if (strcmp(what, "copied") == 0) return copied();
  if (strcmp(what, "memory") == 0) return memory();
  if (strcmp(what, "times") == 0) return times();
  if (strcmp(what, "signals") == 0) return signals();
  return environment(count, words);
}
