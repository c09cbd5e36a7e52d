#pragma once

#include <cstdint>
#include <vector>

namespace calibration {

/// The devices of the hybrid system as its software sees them, each access answered at once: DMA
/// engines that are always done, an interrupt controller that always has one of them, and feature
/// words. Their own instructions are about as many as those of the chip's access functions.
struct Devices {
  /// What gpio_features shows next.
  static void show(const std::vector<std::uint32_t>& words);
  /// Takes the IRQ exception `count` times.
  static void interrupt(std::uint32_t count);
};

}  // namespace calibration
