#pragma once

#include <cstdint>
#include <string>

namespace vp {

/// Appends a number in seven bits a byte, the lowest first (LEB128).
inline void put_varint(std::string& to, std::uint64_t value) {
  for (; value >= 0x80; value >>= 7) to += static_cast<char>(value | 0x80);
  to += static_cast<char>(value);
}

/// The same in two's complement: the last byte tells the sign.
inline void put_signed_varint(std::string& to, std::int64_t value) {
  for (; value < -64 || value > 63; value >>= 7) to += static_cast<char>(value | 0x80);
  to += static_cast<char>(value & 0x7f);
}

}  // namespace vp
