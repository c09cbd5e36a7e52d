#pragma once

#include <algorithm>
#include <cstdint>
#include <string>

#include <vp/axi_stream.h>
#include <vp/error.h>

/// Pixels on an AXI4-Stream (UG934): one a beat, TUSER(0) with a frame's first.
namespace xilinx {

/// Bytes of a beat: those of a pixel, rounded up. Throws vp::InputError for one of more than 64
/// bits.
inline unsigned video_stream_bytes(unsigned components, unsigned component_bits,
                                   unsigned native_bits, const std::string& of) {
  constexpr unsigned most_bits = 64;
  const unsigned bits = components * std::max(component_bits, native_bits);
  if (bits == 0 || bits > most_bits)
    throw vp::InputError(of + ": pixels of " + std::to_string(bits) +
                         " bits are not modelled, those of 1 to 64 are");
  return (components * component_bits + vp::bits_per_byte - 1) / vp::bits_per_byte;
}

inline vp::StreamBytes video_beat(std::uint64_t data, unsigned bytes) {
  vp::StreamBytes beat;
  for (unsigned i = 0; i < bytes; ++i) {
    beat.data[i] = static_cast<unsigned char>(data >> i * vp::bits_per_byte);
    beat.keep.set(i);
  }
  return beat;
}

inline std::uint64_t video_data(const vp::StreamBytes& beat, unsigned bytes) {
  std::uint64_t data = 0;
  for (unsigned i = 0; i < bytes; ++i) data |= std::uint64_t{beat.data[i]} << i * vp::bits_per_byte;
  return data;
}

/// Components of `from` bits as such of `to`: the upper bits are the same (assumed).
inline std::uint64_t resized(std::uint64_t word, unsigned components, unsigned from, unsigned to) {
  if (from == to) return word;
  std::uint64_t out = 0;
  for (unsigned n = 0; n < components; ++n) {
    const std::uint64_t component = word >> n * from & ((std::uint64_t{1} << from) - 1);
    out |= (from < to ? component << (to - from) : component >> (from - to)) << n * to;
  }
  return out;
}

/// The wire of TUSER(0); null: none.
inline vp::Signal<std::uint32_t>* start_of_frame(vp::AxiStream& link) {
  for (auto& part : link.parts())
    if (part.part.field == vp::StreamField::user && part.part.low == 0) return &part.wire;
  return nullptr;
}

}  // namespace xilinx
