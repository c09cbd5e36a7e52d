/* A Linux application as one writes it for a Zynq: draws a dark square into a u-dma-buf, sends it
 * to the image store of the design 'thesis' by AXI DMA 0, each transfer ended by an interrupt that
 * comes through /dev/uioN, starts the logic and polls the features that it found from AXI GPIO 1.
 */
#include <fcntl.h>
#include <poll.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

enum { WIDTH = 640, HEIGHT = 480, PIXELS = WIDTH * HEIGHT };
enum { LEFT = 200, TOP = 120, SIDE = 160, DARK = 20, BRIGHT = 220 };
enum { REGISTERS = 0x10000, TRANSFER = 12288 /* bytes; LENGTH has 14 bits */ };

/* Words from the start of the registers: PG021 and PG144. */
enum { MM2S_DMACR = 0x00 / 4, MM2S_DMASR = 0x04 / 4, MM2S_SA = 0x18 / 4, MM2S_LENGTH = 0x28 / 4 };
enum { RUN = 1, RESET = 4, INTERRUPT = 0x1000, ERRORS = 0x770 };
enum { GPIO_DATA = 0, GPIO_TRI = 1 };

/* The control packet in GPIO 0, and the word behind the last feature. */
enum { ENA = 1, RST = 2, READY = 0xC, WR_EN = 0x10 };
#define END_OF_FRAME 0xFFFFFFFFu
#define CONTROL_ADDRESS 0x41200000
#define FEATURE_ADDRESS 0x41210000
#define DMA_ADDRESS 0x40400000

static void check(int fine, const char* what) {
  if (fine) return;
  perror(what);
  exit(1);
}

static unsigned long attribute(const char* path) {
  char text[32] = "";
  FILE* file = fopen(path, "r");
  check(file && fgets(text, sizeof text, file), path);
  fclose(file);
  return strtoul(text, NULL, 0);
}

static void write_attribute(const char* path, const char* text) {
  FILE* file = fopen(path, "w");
  check(file && fputs(text, file) >= 0 && fclose(file) == 0, path);
}

/* The number of the uio whose registers are there; the device tree may put it anywhere. */
static int find_uio(unsigned long address) {
  for (int number = 0;; ++number) {
    char path[64];
    snprintf(path, sizeof path, "/sys/class/uio/uio%d/maps/map0/addr", number);
    if (attribute(path) == address) return number;
  }
}

static volatile uint32_t* map(int file, off_t offset) {
  void* got = mmap(NULL, REGISTERS, PROT_READ | PROT_WRITE, MAP_SHARED, file, offset);
  check(got != MAP_FAILED, "mmap");
  return got;
}

static void send_image(volatile uint32_t* dma, int uio, uint32_t address) {
  dma[MM2S_DMACR] = RESET;
  while (dma[MM2S_DMACR] & RESET) continue;
  dma[MM2S_DMACR] = RUN | INTERRUPT;
  for (uint32_t sent = 0; sent < PIXELS; sent += TRANSFER) {
    const uint32_t unmask = 1;
    check(write(uio, &unmask, sizeof unmask) == sizeof unmask, "uio");
    dma[MM2S_SA] = address + sent;
    dma[MM2S_LENGTH] = TRANSFER;
    struct pollfd wait = {uio, POLLIN, 0};
    uint32_t count = 0;
    if (poll(&wait, 1, 100) != 1 || read(uio, &count, sizeof count) != sizeof count) {
      fprintf(stderr, "no interrupt, DMASR %08x\n", (unsigned)dma[MM2S_DMASR]);
      exit(1);
    }
    const uint32_t status = dma[MM2S_DMASR];
    dma[MM2S_DMASR] = status & INTERRUPT;
    check((status & ERRORS) == 0, "DMA");
  }
}

int main(void) {
  const int memory = open("/dev/mem", O_RDWR | O_SYNC);
  check(memory >= 0, "/dev/mem");
  volatile uint32_t* const control = map(memory, CONTROL_ADDRESS);
  volatile uint32_t* const features = map(memory, FEATURE_ADDRESS);

  char path[32];
  snprintf(path, sizeof path, "/dev/uio%d", find_uio(DMA_ADDRESS));
  const int uio = open(path, O_RDWR);
  check(uio >= 0, path);
  volatile uint32_t* const dma = map(uio, 0);

  const int buffer = open("/dev/udmabuf0", O_RDWR);
  check(buffer >= 0, "/dev/udmabuf0");
  uint8_t* const image = mmap(NULL, PIXELS, PROT_READ | PROT_WRITE, MAP_SHARED, buffer, 0);
  check(image != MAP_FAILED, "udmabuf0");
  memset(image, BRIGHT, PIXELS);
  for (int y = TOP; y < TOP + SIDE; ++y) memset(image + y * WIDTH + LEFT, DARK, SIDE);
  write_attribute("/sys/class/u-dma-buf/udmabuf0/sync_direction", "1"); /* to the device */
  write_attribute("/sys/class/u-dma-buf/udmabuf0/sync_for_device", "1");

  control[GPIO_TRI] = 0;
  control[GPIO_DATA] = WR_EN;
  send_image(dma, uio, (uint32_t)attribute("/sys/class/u-dma-buf/udmabuf0/phys_addr"));
  control[GPIO_DATA] = RST;
  control[GPIO_DATA] = 0;
  control[GPIO_DATA] = ENA;

  unsigned corners = 0, blobs = 0;
  uint32_t packet = ENA, last = 0;
  while (last != END_OF_FRAME) {
    const uint32_t word = features[GPIO_DATA];
    if (word == last) continue;
    last = word;
    if (word == END_OF_FRAME) break;
    if (word >> 31) {
      printf("corner at (%u, %u)\n", (unsigned)(word & 0x3FF), (unsigned)(word >> 10 & 0x1FF));
      ++corners;
    } else {
      blobs += word >> 30;
    }
    control[GPIO_DATA] = packet ^= READY;
  }
  printf("%u corners and %u blobs of a square from (%d, %d) to (%d, %d)\n", corners, blobs, LEFT,
         TOP, LEFT + SIDE - 1, TOP + SIDE - 1);
  return 0;
}
