#pragma once

#include <marker/work.h>

#include <array>
#include <cstdint>
#include <string>

#include "../plugin/marks.h"

namespace calibration {

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

}  // namespace calibration
