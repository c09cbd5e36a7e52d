#pragma once

#include <cstdint>

namespace chip {

/// A register at a bus address, for the parts of the HAL that may not call it.
inline volatile std::uint32_t& device_register(std::uint32_t address) {
  return *reinterpret_cast<volatile std::uint32_t*>(address);
}

inline void barrier() {
  asm volatile("dsb" ::: "memory");
}

inline constexpr std::uint32_t cache_line = 32;

}  // namespace chip
