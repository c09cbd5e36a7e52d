// Runs the kernels of the PS software on random inputs: driver [scenes] [width height] [kernel]
#include <cstdio>
#include <cstdlib>

#include "driver.h"

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

int main(int argc, char** argv) {
  using namespace calibration;
  const int scenes = argc > 1 ? std::atoi(argv[1]) : 12;
  const std::uint32_t width = argc > 3 ? static_cast<std::uint32_t>(std::atoi(argv[2])) : 0;
  const std::uint32_t height = argc > 3 ? static_cast<std::uint32_t>(std::atoi(argv[3])) : 0;
  if (argc > 4) only_kernel = argv[4];
  Random random(2026), detector_random(2027), filter_random(2028), optics_random(2029),
      packet_random(2030);
  // Small: counts per unit do not depend on the size, but rows and pixels must be told apart.
  constexpr std::uint32_t sizes[][2] = {{160, 120}, {224, 128}, {192, 160}, {128, 112}, {256, 144}};
  for (int scene = 0; scene < scenes; ++scene) {
    const auto& size = sizes[scene % 5];
    const std::uint32_t w = width ? width : size[0], h = height ? height : size[1];
    measure_features(random, w, h);
    measure_decode(random);
    for (int i = 0; i < 3; ++i) measure_evaluation(random);
    measure_identification(random, w, h, false);
    measure_identification(random, w, h, true);
    measure_pose(random);
    for (int i = 0; i < 3; ++i) {
      measure_detector(detector_random, w, h, false);
      measure_detector(detector_random, w, h, true);
      measure_board_pose(detector_random);
      measure_pose_filter(filter_random);
      measure_optics(optics_random, w, h);
    }
    measure_hardware(random);
    measure_packet_sum(packet_random);
  }
  return 0;
}
