#include "measure.h"

#include <cstdio>

namespace calibration {

std::string only_kernel;

WorkCounts& work_counts() {
  static WorkCounts counts{};
  return counts;
}

void Checksum::add(const void* data, std::size_t size) {
  const unsigned char* byte = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ byte[i]) * 16'777'619u;
}

void report(const char* kernel, const Checksum& result) {
  std::printf("%s %08x", kernel, static_cast<unsigned>(result.value()));
  const WorkCounts& counts = work_counts();
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] != 0) {
      std::printf(" %s=%llu", marker::work_names[i], static_cast<unsigned long long>(counts[i]));
    }
  }
  std::printf("\n");
}

}  // namespace calibration

#ifndef HAL_BARE_METAL
extern "C" {
void hal_work(uint32_t item, uint64_t count) {
  calibration::work_counts().at(item) += count;
}
void hal_function_enter(uint32_t) {}
void hal_function_leave(void) {}
}
#endif
