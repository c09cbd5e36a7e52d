#pragma once

#include <pl/common/rtl_interface.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bench {

/// The values at the input pins of Verilated RTL on each of its evaluations.
struct Recording {
  struct Input {
    std::uint32_t port;
    const void* place;
    std::size_t bytes;
  };
  const RtlDescriptor* rtl = nullptr;
  std::vector<Input> inputs;
  std::vector<unsigned char> stimulus;  ///< of each evaluation all inputs, one after the other
  std::size_t evaluations = 0;
};

inline std::size_t bytes_of(const RtlPort& port) {
  if (port.bits > 64) return (port.bits + 31) / 32 * 4;
  return port.bits <= 8 ? 1 : port.bits <= 16 ? 2 : port.bits <= 32 ? 4 : 8;
}

}  // namespace bench
