// What the test bench gives and takes on the platform: DMA memory, images, results.
#include <cstring>

#include <hal/hal.h>

#include "chip.h"
#include "memory_map.h"

namespace {

// DMA memory, handed out front to back as on the virtual platform: the same addresses there.
std::uint64_t next = CHIP_DMA_FIRST;

constexpr std::uint64_t round_up(std::uint64_t value, std::uint64_t power_of_two) {
  return (value + power_of_two - 1) & ~(power_of_two - 1);
}

}  // namespace

extern "C" hal_dma_buffer hal_dma_allocate(size_t size, size_t alignment) {
  hal_dma_buffer buffer{nullptr, 0, size};
  if (alignment == 0 || (alignment & (alignment - 1)) != 0) return buffer;
  const std::uint64_t line = chip::cache_line;
  const std::uint64_t start = round_up(next, alignment > line ? alignment : line);
  // An empty buffer has an address of its own, too.
  const std::uint64_t end = start + round_up(size > 0 ? size : 1, line);
  if (end > CHIP_DDR_END) return buffer;
  next = end;
  buffer.bus_address = static_cast<std::uint32_t>(start);
  buffer.data = reinterpret_cast<void*>(buffer.bus_address);
  return buffer;
}

// One binary PGM file in the ELF, handed out as often as the build says.
extern "C" {
extern const unsigned char chip_image_begin[];
extern const unsigned char chip_image_end[];
}

namespace {

#ifndef CHIP_FRAMES
#define CHIP_FRAMES 1
#endif

/// The camera of the scenes (thesis chapter 5), its focal length scaled to the image's width.
constexpr double standard_focal_length = 381.36;  // px
constexpr double standard_width = 640;            // px

[[noreturn]] void refuse(const char* reason) {
  chip::print("chip: the image in the ELF ");
  chip::print(reason);
  chip::print("\n");
  chip::end(chip::input_exit_code);
}

/// Reads the header of a PGM file: P5, width, height, 255, each after white space or comments.
class PgmReader {
 public:
  PgmReader(const unsigned char* begin, const unsigned char* end) : at_(begin), end_(end) {}

  bool magic() { return next() == 'P' && next() == '5'; }

  std::uint32_t number() {
    skip_space();
    std::uint32_t value = 0;
    while (peek() >= '0' && peek() <= '9' && value < 100'000) {
      value = value * 10 + static_cast<std::uint32_t>(next() - '0');
    }
    return value;
  }

  /// What follows the single white space after the header.
  const unsigned char* pixels() {
    next();
    return at_;
  }

 private:
  int peek() const { return at_ < end_ ? *at_ : -1; }
  int next() { return at_ < end_ ? *at_++ : -1; }
  bool is_space() const { return peek() == ' ' || (peek() >= '\t' && peek() <= '\r'); }
  void skip_space() {
    while (is_space() || peek() == '#') {
      if (peek() == '#') {
        while (peek() != '\n' && peek() != -1) next();
      } else {
        next();
      }
    }
  }

  const unsigned char* at_;
  const unsigned char* end_;
};

void set_camera(hal_frame& frame) {
#ifdef CHIP_CAMERA
  const double camera[] = {CHIP_CAMERA};
  constexpr std::size_t given = sizeof camera / sizeof *camera;
  static_assert(given == 4 || given == 9, "MARKERVP_CHIP_CAMERA is fx,fy,cx,cy[,k1,k2,p1,p2,k3]");
  frame.fx = camera[0];
  frame.fy = camera[1];
  frame.cx = camera[2];
  frame.cy = camera[3];
  for (std::size_t i = 4; i < given; ++i) frame.distortion[i - 4] = camera[i];
#else
  frame.fx = frame.fy = standard_focal_length * (frame.width / standard_width);
  frame.cx = frame.width / 2.0;
  frame.cy = frame.height / 2.0;
#endif
}

/// Copies the pixels into DMA memory: those in the file do not start at a whole word.
void prepare(hal_frame& frame) {
  PgmReader file(chip_image_begin, chip_image_end);
  if (!file.magic()) refuse("is no binary PGM file (P5)");
  frame.width = file.number();
  frame.height = file.number();
  if (file.number() != 255) refuse("does not have 255 as its white");
  const unsigned char* pixels = file.pixels();
  const std::uint64_t count = std::uint64_t{frame.width} * frame.height;
  if (count == 0 || static_cast<std::uint64_t>(chip_image_end - pixels) < count) {
    refuse("is cut off");
  }
  const hal_dma_buffer buffer = hal_dma_allocate(static_cast<size_t>(count), 4096);
  if (buffer.data == nullptr) refuse("has no room in the DMA memory");
  std::memcpy(buffer.data, pixels, static_cast<size_t>(count));
  hal_cache_flush(buffer.data, buffer.size);
  frame.pixels = static_cast<const std::uint8_t*>(buffer.data);
  frame.bus_address = buffer.bus_address;
  set_camera(frame);
}

hal_frame frame{};
std::uint32_t frames_given = 0;

}  // namespace

extern "C" const hal_frame* hal_frame_next(void) {
  const unsigned char* const end = chip_image_end;
  if (chip_image_begin == end || frames_given == CHIP_FRAMES) return nullptr;
  if (frames_given == 0) prepare(frame);
  frame.index = frames_given++;
  return &frame;
}

extern "C" {

/// Results go to the console. Defined by code that knows their meaning (sw/chip).
__attribute__((weak)) bool chip_print_result(uint32_t, const void*, size_t) {
  return false;
}

void hal_publish(uint32_t kind, const void* data, size_t size) {
  if (chip_print_result(kind, data, size)) return;
  char name[5] = {};
  for (unsigned i = 0; i < 4; ++i) {
    const char character = static_cast<char>(kind >> (8 * i));
    name[i] = character >= ' ' && character <= '~' ? character : '.';
  }
  chip::print("chip: result ");
  chip::print(name);
  chip::print(", ");
  chip::print_number(size);
  chip::print(" bytes\n");
}

}  // extern "C"
