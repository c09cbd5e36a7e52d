#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <marker/geometry.h>
#include <marker/images.h>
#include <marker/quad_fit.h>
#include <marker/work.h>

#include "../plugin/marks.h"

namespace calibration {

/// The same numbers on every machine (xorshift64*).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed * 0x9E37'79B9'7F4A'7C15u + 1) {}

  /// 0 … `end` − 1.
  std::uint32_t below(std::uint32_t end) {
    state_ ^= state_ >> 12;
    state_ ^= state_ << 25;
    state_ ^= state_ >> 27;
    return static_cast<std::uint32_t>((state_ * 0x2545'F491'4F6C'DD1Du) >> 32) % end;
  }
  /// `first` … `last`.
  std::int32_t between(std::int32_t first, std::int32_t last) {
    return first + static_cast<std::int32_t>(below(static_cast<std::uint32_t>(last - first) + 1));
  }
  /// 0 ≤ x < 1.
  double unit() { return below(1u << 24) / static_cast<double>(1u << 24); }

 private:
  std::uint64_t state_;
};

/// Units of work done since the last clear(); on the chip nothing counts.
using WorkCounts = std::array<std::uint64_t, static_cast<std::size_t>(marker::Work::count)>;
WorkCounts& work_counts();

/// A number that depends on every byte given: two machines that computed the same have the same.
class Checksum {
 public:
  void add(const void* data, std::size_t size);
  template <class T>
  void add(const T& value) {
    add(&value, sizeof value);
  }
  std::uint32_t value() const { return value_; }

 private:
  std::uint32_t value_ = 2'166'136'261u;
};

/// Sides are measured once: the drawn squares have steps, which would be taken for noise, and what
/// is read a second time is in the caches.
inline marker::QuadFitOptions once() {
  marker::QuadFitOptions options;
  options.noisy = 1e9;
  return options;
}

/// Only this kernel is measured; empty: all are.
extern std::string only_kernel;

/// One line: what was measured, what it computed, and the units of work where they are counted.
void report(const char* kernel, const Checksum& result);

#if defined(__arm__)
#define CALIBRATION_MARK(code) asm volatile(".inst " CALIBRATION_TEXT(code)::: "memory")
#define CALIBRATION_TEXT(code) CALIBRATION_TEXT_OF(code)
#define CALIBRATION_TEXT_OF(code) #code
#else
#define CALIBRATION_MARK(code) asm volatile("" ::: "memory")
#endif

/// Runs `kernel` between the marks, and tells of it; `result` gives the checksum of what it
/// computed. A kernel that is not asked for runs all the same, since others build on it.
template <class Kernel, class Result>
void measure(const char* name, Kernel kernel, Result result) {
  if (!only_kernel.empty() && only_kernel != name) {
    kernel();
    return;
  }
  work_counts().fill(0);
  CALIBRATION_MARK(MARK_START);
  kernel();
  CALIBRATION_MARK(MARK_STOP);
  report(name, result());
}

/// The caches are empty from here on.
inline void flush_caches() {
  CALIBRATION_MARK(MARK_FLUSH);
}

/// A random picture of what the software sees: a bright wall, a dark floor, markers and squares at
/// any angle, noise.
class Scene {
 public:
  /// `width` a multiple of 32.
  Scene(Random& random, std::uint32_t width, std::uint32_t height);

  marker::GreyImage image() const { return {pixels_.data(), width_, height_}; }
  /// The corners of what was drawn, as pixel indices: top left, top right, bottom left, bottom
  /// right.
  const std::vector<marker::Quad>& squares() const { return squares_; }

 private:
  void draw_square(Random& random);
  void add_noise(Random& random, std::int32_t amplitude);

  std::uint32_t width_, height_;
  std::vector<std::uint8_t> pixels_;
  std::vector<marker::Quad> squares_;
};

/// The devices of the hybrid system as its software sees them, each access answered at once: DMA
/// engines that are always done, an interrupt controller that always has one of them, and feature
/// words. Their own instructions are about as many as those of the chip's access functions.
struct Devices {
  /// What gpio_features shows next.
  static void show(const std::vector<std::uint32_t>& words);
  /// Takes the IRQ exception `count` times.
  static void interrupt(std::uint32_t count);
};

/// Measures the kernels that find features on one random image.
void measure_features(Random& random, std::uint32_t width, std::uint32_t height);

/// Measures what follows, on random features, candidates and poses.
void measure_decode(Random& random);
void measure_packet_sum(Random& random);
void measure_evaluation(Random& random);
/// `cold`: the binary image is in no cache, as after a DMA engine wrote it.
void measure_identification(Random& random, std::uint32_t width, std::uint32_t height, bool cold);
void measure_pose(Random& random);

/// Measures the detector of the design `improved` on a random picture. `cold`: the picture is in no
/// cache, as after a DMA engine wrote it.
void measure_detector(Random& random, std::uint32_t width, std::uint32_t height, bool cold);
/// And what follows, on random boards.
void measure_board_pose(Random& random);
void measure_pose_filter(Random& random);
/// And what it does for cameras with a response curve or another lens.
void measure_optics(Random& random, std::uint32_t width, std::uint32_t height);

/// Measures what the software does for the hardware: feature words and interrupts.
void measure_hardware(Random& random);

}  // namespace calibration
