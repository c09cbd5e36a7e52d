// Runs the kernels of the PS software on random inputs: driver [scenes] [width height] [kernel]
#include <cstdlib>

#include "kernels.h"
#include "measure.h"

int main(int argc, char** argv) {
  using namespace calibration;
  const int scenes = argc > 1 ? std::atoi(argv[1]) : 12;
  const std::uint32_t width = argc > 3 ? static_cast<std::uint32_t>(std::atoi(argv[2])) : 0;
  const std::uint32_t height = argc > 3 ? static_cast<std::uint32_t>(std::atoi(argv[3])) : 0;
  if (argc > 4) only_kernel = argv[4];
  Random random(2026);
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
    measure_hardware(random);
  }
  return 0;
}
