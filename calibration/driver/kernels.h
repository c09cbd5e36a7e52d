#pragma once

#include <cstdint>

#include "random.h"

namespace calibration {

/// Measures the kernels that find features on one random image.
void measure_features(Random& random, std::uint32_t width, std::uint32_t height);

/// Measures what follows, on random features, candidates and poses.
void measure_decode(Random& random);
void measure_evaluation(Random& random);
/// `cold`: the binary image is in no cache, as after a DMA engine wrote it.
void measure_identification(Random& random, std::uint32_t width, std::uint32_t height, bool cold);
void measure_pose(Random& random);

/// Measures what the software does for the hardware: feature words and interrupts.
void measure_hardware(Random& random);

}  // namespace calibration
