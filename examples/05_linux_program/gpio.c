/* A Linux application as one writes it for a Zynq: blinks an output of AXI GPIO 0 through /dev/mem.
 * The output is one without effect: the threshold field of the control packet, without
 * wr_thresh. */
#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

#define GPIO_ADDRESS 0x41200000
#define GPIO_SIZE 0x10000
#define GPIO_DATA 0 /* words from the start, PG144 */
#define GPIO_TRI 1
#define LED 0x100u

static double seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + (double)now.tv_nsec * 1e-9;
}

int main(void) {
  const int file = open("/dev/mem", O_RDWR | O_SYNC);
  if (file < 0) {
    perror("/dev/mem");
    return 1;
  }
  volatile uint32_t* const gpio =
      mmap(NULL, GPIO_SIZE, PROT_READ | PROT_WRITE, MAP_SHARED, file, GPIO_ADDRESS);
  if (gpio == MAP_FAILED) {
    perror("mmap");
    return 1;
  }
  gpio[GPIO_TRI] = 0;
  const double start = seconds();
  for (int blink = 0; blink < 4; ++blink) {
    gpio[GPIO_DATA] |= LED;
    usleep(500);
    gpio[GPIO_DATA] &= ~LED;
    usleep(500);
  }
  printf("4 blinks in %.1f ms, output %08x\n", (seconds() - start) * 1e3,
         (unsigned)gpio[GPIO_DATA]);
  return 0;
}
