#pragma once

#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <string>

namespace vp {

/// "0x41200000": at least eight digits, for messages.
inline std::string hex(std::uint64_t value) {
  char text[24];
  std::snprintf(text, sizeof text, "0x%08" PRIX64, value);
  return text;
}

}  // namespace vp
