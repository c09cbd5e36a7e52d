/* Code without annotations whose time on a Cortex-A9 is known (code_time_test.cpp): four
 * computations, each between two accesses of the device. */
#include <hal/hal.h>

enum { bytes = 1024, taps = 16, samples = 512, numbers = 256, order = 16 };

static unsigned char text[bytes];
static int history[samples + taps], weights[taps], filtered[samples];
static int heap[numbers];
static float left[order][order], right[order][order], product[order][order];

static unsigned crc32(const unsigned char* data, int count) {
  unsigned crc = ~0u;
  for (int i = 0; i < count; ++i) {
    crc ^= data[i];
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1u) ? crc >> 1 ^ 0xEDB88320u : crc >> 1;
  }
  return ~crc;
}

static int filter(void) {
  for (int i = 0; i < samples; ++i) {
    int sum = 0;
    for (int k = 0; k < taps; ++k) sum += history[i + k] * weights[k];
    filtered[i] = sum >> 4;
  }
  return filtered[samples / 2];
}

static void sink(int root, int count) {
  while (2 * root + 1 < count) {
    int child = 2 * root + 1;
    if (child + 1 < count && heap[child] < heap[child + 1]) ++child;
    if (heap[root] >= heap[child]) return;
    const int other = heap[root];
    heap[root] = heap[child];
    heap[child] = other;
    root = child;
  }
}

static int sort(void) {
  for (int root = numbers / 2 - 1; root >= 0; --root) sink(root, numbers);
  for (int last = numbers - 1; last > 0; --last) {
    const int largest = heap[0];
    heap[0] = heap[last];
    heap[last] = largest;
    sink(0, last);
  }
  return heap[numbers / 2];
}

static int multiply(void) {
  for (int i = 0; i < order; ++i) {
    for (int j = 0; j < order; ++j) {
      float sum = 0;
      for (int k = 0; k < order; ++k) sum += left[i][k] * right[k][j];
      product[i][j] = sum;
    }
  }
  return (int)product[3][5];
}

static unsigned state = 1;
static int random_number(void) {
  state = state * 1664525u + 1013904223u;
  return (int)(state >> 16);
}

#ifndef KERNELS_BEGIN
#define KERNELS_BEGIN(number) hal_write32(0x40000000, number)
#define KERNELS_END(number, result) hal_write32(0x40000000, (uint32_t)(result))
#endif

int main(void) {
  for (int i = 0; i < bytes; ++i) text[i] = (unsigned char)random_number();
  for (int i = 0; i < samples + taps; ++i) history[i] = random_number() % 1000;
  for (int i = 0; i < taps; ++i) weights[i] = i - taps / 2;
  for (int i = 0; i < numbers; ++i) heap[i] = random_number() % 10000;
  for (int i = 0; i < order * order; ++i) {
    left[i / order][i % order] = (float)(i % 7);
    right[i / order][i % order] = (float)(i % 5);
  }
  KERNELS_BEGIN(0);
  const unsigned crc = crc32(text, bytes);
  KERNELS_END(0, crc);
  KERNELS_BEGIN(1);
  const int level = filter();
  KERNELS_END(1, level);
  KERNELS_BEGIN(2);
  const int middle = sort();
  KERNELS_END(2, middle);
  KERNELS_BEGIN(3);
  const int element = multiply();
  KERNELS_END(3, element);
  return 0;
}
