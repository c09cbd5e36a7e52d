#pragma once

#include <cstdint>
#include <string>

#include <vp/axi_stream.h>
#include <vp/error.h>

/// Pixels on an AXI4-Stream (UG934): one a beat, TUSER(0) with a frame's first.
namespace xilinx {

/// Bytes of a beat: those of a pixel, rounded up. Throws vp::InputError for one of more than 64
/// bits.
inline unsigned video_stream_bytes(unsigned components, unsigned component_bits,
                                   const std::string& of) {
  constexpr unsigned most_bits = 64;
  const unsigned bits = components * component_bits;
  if (bits == 0 || bits > most_bits)
    throw vp::InputError(of + ": pixels of " + std::to_string(bits) +
                         " bits are not modelled, those of 1 to 64 are");
  return (bits + vp::bits_per_byte - 1) / vp::bits_per_byte;
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

/// The wire of TUSER(0); null: none.
inline vp::Signal<std::uint32_t>* start_of_frame(vp::AxiStream& link) {
  for (auto& part : link.parts())
    if (part.part.field == vp::StreamField::user && part.part.low == 0) return &part.wire;
  return nullptr;
}

}  // namespace xilinx
