/* Copies by fork(), daemons, descriptors and stacks, a case a word of the command line. Ends with 0
 * if all is right. */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#define OCM 0xFFFC0000
#define EXPECT(condition)                                               \
  do {                                                                  \
    if (condition) break;                                               \
    printf("%s:%d: not so: %s\n", "processes.c", __LINE__, #condition); \
    fflush(stdout);                                                     \
    _exit(1);                                                           \
  } while (0)

static volatile uint32_t* map_at(off_t address) {
  const int file = open("/dev/mem", O_RDWR | O_SYNC);
  EXPECT(file >= 0);
  void* got = mmap(NULL, 4096, PROT_READ | PROT_WRITE, MAP_SHARED, file, address);
  EXPECT(got != MAP_FAILED);
  return got;
}

static volatile uint32_t* memory(void) {
  return map_at(OCM);
}

static uint64_t now_us(void) {
  struct timespec now;
  EXPECT(clock_gettime(CLOCK_MONOTONIC, &now) == 0);
  return (uint64_t)now.tv_sec * 1000000 + (uint64_t)now.tv_nsec / 1000;
}

static void await(pid_t child) {
  int status = 0;
  EXPECT(waitpid(child, &status, 0) == child);
  EXPECT(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

/* ---- Copies */

/* Each uses the devices while the others wait. */
static void in_turn(void) {
  volatile uint32_t* const words = memory();
  words[0] = 1;
  for (uint32_t i = 1; i <= 3; ++i) {
    const pid_t child = fork();
    if (child == 0) {
      EXPECT(words[0] == i);
      words[0] = i + 1;
      const uint64_t before = now_us();
      usleep(500);
      EXPECT(now_us() - before >= 500 && now_us() - before < 600);
      _exit(0);
    }
    await(child);
    if (i == 2) EXPECT(words[0] == 3);
  }
  EXPECT(words[0] == 4 && now_us() >= 1500 && now_us() < 2000);
}

/* Its first time is the host's. */
static void time_of_a_copy(void) {
  memory()[0] = 1;
  const pid_t child = fork();
  if (child == 0) {
    const uint64_t before = now_us();
    memory()[0] = 2;
    EXPECT(now_us() < before);
    _exit(0);
  }
  await(child);
}

/* It uses no device while the other one does: nothing is wrong with that. */
static void helper(void) {
  volatile uint32_t* const words = memory();
  int ends[2];
  EXPECT(pipe(ends) == 0);
  const pid_t child = fork();
  if (child == 0) {
    char byte = 0;
    setsid();
    now_us();
    usleep(1000);
    EXPECT(read(ends[0], &byte, 1) == 1 && byte == 'x');
    _exit(0);
  }
  for (uint32_t i = 0; i < 100; ++i) words[0] = i;
  usleep(100);
  EXPECT(write(ends[1], "x", 1) == 1);
  await(child);
  words[0] = 1;
}

/* A copy opens devices itself; the one that was started never does. */
static void only_the_copy(void) {
  const pid_t child = fork();
  if (child == 0) {
    volatile uint32_t* const words = memory();
    words[1] = 5;
    EXPECT(words[1] == 5);
    _exit(0);
  }
  await(child);
}

static void vforks(void) {
  volatile uint32_t* const words = memory();
  words[0] = 7;
  const pid_t child = vfork();
  if (child == 0) {
    execl("/bin/true", "true", (char*)NULL);
    _exit(9);
  }
  await(child);
  EXPECT(words[0] == 7);
}

/* Without a call of fork(), as some runtimes do it. */
static void clones(void) {
  volatile uint32_t* const words = memory();
  words[0] = 7;
  const pid_t child = (pid_t)syscall(SYS_clone, SIGCHLD, 0, 0, 0, 0);
  if (child == 0) {
    EXPECT(words[0] == 7);
    _exit(0);
  }
  await(child);
  EXPECT(words[0] == 7);
}

static void until_ended(void) {
  while (1) pause();
}

/* Both at once: whichever comes second. */
static void both(void) {
  volatile uint32_t* const words = memory();
  if (fork() == 0) {
    while (1) words[0] = 1;
  }
  while (1) words[0] = 2;
}

/* Two copies, whose order is the host's, whichever ends first. */
static void siblings(void) {
  volatile uint32_t* const words = memory();
  for (uint32_t i = 0; i < 2; ++i) {
    if (fork() == 0) {
      words[0] = i;
      _exit(0);
    }
  }
  while (wait(NULL) > 0) continue;
}

/* ---- Daemons */

static void work(uint32_t value) {
  const uint64_t before = now_us();
  usleep(2000);
  EXPECT(now_us() - before >= 2000 && now_us() - before < 2100);
  volatile uint32_t* const words = map_at(0x41200000);
  words[1] = 0;
  words[0] = value;
  usleep(1000);
}

static void becomes_daemon(void) {
  EXPECT(daemon(1, 0) == 0);
  work(0x100);
  exit(0);
}

/* It fails, and the run does. */
static void failing_daemon(void) {
  memory()[0] = 1;
  EXPECT(daemon(0, 1) == 0);
  work(0x100);
  exit(6);
}

static void dying_daemon(void) {
  EXPECT(daemon(0, 1) == 0);
  work(0x100);
  abort();
}

/* Its parent takes its time to end. */
static void daemon_of_a_busy_parent(void) {
  memory()[0] = 1;
  if (fork() != 0) {
    for (volatile unsigned spins = 0; spins < 100000000; ++spins) continue;
    _exit(0);
  }
  EXPECT(setsid() > 0);
  work(0x100);
}

/* As books have it. */
static void daemon_by_hand(void) {
  if (fork() != 0) _exit(0);
  EXPECT(setsid() > 0);
  if (fork() != 0) _exit(0);
  EXPECT(chdir("/") == 0);
  volatile uint32_t* const words = map_at(0x41200000);
  words[1] = 0;
  words[0] = 0x100;
  const uint64_t before = now_us();
  usleep(1000);
  EXPECT(now_us() - before >= 1000 && now_us() - before < 1100);
}

static void endless_daemon(void) {
  EXPECT(daemon(1, 1) == 0);
  memory()[0] = 1;
  until_ended();
}

/* ---- What is left */

static void leaves_a_session(void) {
  memory()[0] = 1;
  if (fork() == 0) {
    setsid();
    if (fork() == 0) {
      signal(SIGTERM, SIG_IGN);
      execl("/proc/self/exe", "processes", "idle", (char*)NULL);
    }
    _exit(0);
  }
  EXPECT(wait(NULL) > 0);
}

static void session_and_endless(void) {
  leaves_a_session();
  puts("left");
  volatile unsigned spins = 0;
  while (1) ++spins;
}

static void stops_itself(void) {
  memory()[0] = 1;
  raise(SIGSTOP);
}

static void kills_its_parent(void) {
  memory()[0] = 1;
  kill(getppid(), SIGKILL);
  until_ended();
}

/* ---- Descriptors */

static void check_devices(void) {
  volatile uint32_t* const words = memory();
  words[3] = 9;
  EXPECT(words[3] == 9);
}

static void closes_all(void) {
  const int uio = open("/dev/uio0", O_RDWR);
  EXPECT(uio >= 0);
  closefrom(3);
  EXPECT(fcntl(uio, F_GETFD) == -1 && errno == EBADF);
  check_devices();
  EXPECT(close_range(3, ~0u, 0) == 0);
  check_devices();
  for (int i = 3; i < 4096; ++i) close(i);
  check_devices();
  const int again = open("/dev/uio0", O_RDWR);
  EXPECT(again >= 3 && close_range(3, ~0u, CLOSE_RANGE_CLOEXEC) == 0);
  const uint32_t on = 1;
  EXPECT(write(again, &on, sizeof on) == sizeof on);
}

static void takes_numbers(void) {
  const int uio = open("/dev/uio0", O_RDWR | O_NONBLOCK);
  int ends[2];
  EXPECT(pipe(ends) == 0);
  for (int i = 190; i < 260; ++i) {
    EXPECT(dup2(ends[1], i) == i);
    char text[2] = "";
    EXPECT(write(i, "a", 1) == 1 && read(ends[0], text, 1) == 1 && text[0] == 'a');
  }
  EXPECT(dup3(uio, 400, O_CLOEXEC) == 400);
  check_devices();
  uint32_t count = 0;
  EXPECT(read(400, &count, sizeof count) == -1 && errno == EAGAIN);
  struct pollfd wanted = {uio, POLLIN, 0};
  EXPECT(poll(&wanted, 1, 1) == 0);
}

static void takes_too_many(void) {
  check_devices();
  struct rlimit limit;
  EXPECT(getrlimit(RLIMIT_NOFILE, &limit) == 0);
  for (int i = 3; i < (int)limit.rlim_cur; ++i) dup2(0, i);
}

/* Past the C library. */
static void close_by_instruction(long descriptor) {
  long result;
  __asm__ volatile("syscall"
                   : "=a"(result)
                   : "a"((long)SYS_close), "D"(descriptor)
                   : "rcx", "r11", "memory");
}

static void closes_by_itself(void) {
  check_devices();
  for (int i = 3; i < 512; ++i) close_by_instruction(i);
  check_devices();
}

/* ---- Stacks */

static int deeper(volatile char* above) {
  volatile char room[4096];
  room[0] = above ? above[0] : 1;
  return room[0] == 0 ? 0 : deeper(room) + room[0];
}

static void overflow(void) {
  memory()[0] = 1;
  exit(deeper(NULL));
}

static void* overflow_in_thread(void* unused) {
  (void)unused;
  pthread_setname_np(pthread_self(), "filter");
  exit(deeper(NULL));
}

static void thread_overflow(void) {
  memory()[0] = 1;
  pthread_attr_t attributes;
  pthread_t thread;
  pthread_attr_init(&attributes);
  EXPECT(pthread_attr_setstacksize(&attributes, 256 * 1024) == 0);
  EXPECT(pthread_create(&thread, &attributes, overflow_in_thread, NULL) == 0);
  pthread_join(thread, NULL);
}

static void large_variable(void) {
  memory()[0] = 1;
  volatile char room[32 << 20];
  room[0] = 1;
  printf("%d\n", room[0]);
}

static void* end_thread(void* value) {
  if (value) pthread_exit(value);
  return NULL;
}

/* Threads come and go; what each has goes with it. */
static void many_threads(void) {
  for (int i = 0; i < 2000; ++i) {
    pthread_t thread;
    EXPECT(pthread_create(&thread, NULL, end_thread, i % 2 ? "" : NULL) == 0);
    EXPECT(pthread_join(thread, NULL) == 0);
  }
  FILE* const file = fopen("/proc/self/statm", "r");
  unsigned long pages = 0;
  EXPECT(file && fscanf(file, "%lu", &pages) == 1);
  EXPECT(pages < 2000 * 64);
}

int main(int count, char** words) {
  const struct {
    const char* name;
    void (*make)(void);
  } cases[] = {{"in_turn", in_turn},
               {"only_the_copy", only_the_copy},
               {"time_of_a_copy", time_of_a_copy},
               {"helper", helper},
               {"vforks", vforks},
               {"clones", clones},
               {"both", both},
               {"siblings", siblings},
               {"becomes_daemon", becomes_daemon},
               {"failing_daemon", failing_daemon},
               {"dying_daemon", dying_daemon},
               {"daemon_by_hand", daemon_by_hand},
               {"daemon_of_a_busy_parent", daemon_of_a_busy_parent},
               {"endless_daemon", endless_daemon},
               {"idle", until_ended},
               {"leaves_a_session", leaves_a_session},
               {"session_and_endless", session_and_endless},
               {"stops_itself", stops_itself},
               {"kills_its_parent", kills_its_parent},
               {"closes_all", closes_all},
               {"takes_numbers", takes_numbers},
               {"takes_too_many", takes_too_many},
               {"closes_by_itself", closes_by_itself},
               {"overflow", overflow},
               {"thread_overflow", thread_overflow},
               {"large_variable", large_variable},
               {"many_threads", many_threads}};
  for (unsigned i = 0; i < sizeof cases / sizeof *cases; ++i) {
    if (count == 2 && strcmp(words[1], cases[i].name) == 0) {
      cases[i].make();
      return 0;
    }
  }
  return 1;
}
