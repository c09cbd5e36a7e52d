#pragma once

#include <algorithm>
#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <cstring>

/// AXI4 and AXI4-Lite at the pins (IHI0022): what is on the wires of one interface before a clock
/// edge, be they a model's or the RTL's.
namespace axi {

inline constexpr unsigned most_data_bytes = 128;  ///< AXI4: 1024 bits
inline constexpr std::uint64_t boundary = 4096;   ///< bytes; no burst crosses a multiple of it

enum class BurstType : std::uint8_t { fixed, incr, wrap, reserved };
enum class Response : std::uint8_t { okay, exokay, slverr, decerr };

/// The worse of two: DECERR, SLVERR, OKAY; EXOKAY is as good as OKAY.
inline Response worst(Response a, Response b) {
  return a < Response::slverr && b < Response::slverr ? a : std::max(a, b);
}

constexpr bool power_of_two(unsigned value) {
  return value != 0 && (value & (value - 1)) == 0;
}

/// What an interface is built as.
struct Shape {
  bool lite = false;
  unsigned data_bytes = 4;           ///< a power of two, 4 to 128
  unsigned address_bits = 32;        ///< pins of AxADDR
  unsigned burst_beats = 256;        ///< most beats of an INCR burst: 1 for Lite, 16 for AXI3
  bool reads = true, writes = true;  ///< which of the two halves it has

  /// Bits of an address that it has no pins for.
  std::uint64_t beyond(std::uint64_t address) const {
    return address_bits >= 64 ? 0 : address >> address_bits;
  }
};

/// One beat's request on AW or AR.
struct Address {
  std::uint64_t address = 0;
  std::uint32_t id = 0;
  unsigned beats = 1;  ///< AxLEN + 1
  unsigned size = 2;   ///< a beat has 1 << size bytes
  BurstType burst = BurstType::incr;
  bool lock = false;
  std::uint8_t cache = 0, prot = 0, qos = 0, region = 0;

  bool operator==(const Address& other) const {
    return address == other.address && id == other.id && beats == other.beats &&
           size == other.size && burst == other.burst && lock == other.lock &&
           cache == other.cache && prot == other.prot && qos == other.qos && region == other.region;
  }
  unsigned beat_bytes() const { return 1u << size; }
  /// Bytes before the address in its first beat.
  unsigned skew() const { return static_cast<unsigned>(address & (beat_bytes() - 1)); }
  /// From the first byte of the burst up to the end of its last beat.
  unsigned bytes() const {
    return burst == BurstType::fixed ? beats * (beat_bytes() - skew())
                                     : beats * beat_bytes() - skew();
  }
  /// Bytes of the burst before beat `i`.
  unsigned offset(unsigned i) const {
    if (i == 0) return 0;
    return burst == BurstType::fixed ? i * (beat_bytes() - skew()) : i * beat_bytes() - skew();
  }
  /// Bytes that beat `i` moves.
  unsigned bytes_in(unsigned i) const {
    return i == 0 || burst == BurstType::fixed ? beat_bytes() - skew() : beat_bytes();
  }
  /// First address of the block that a WRAP burst stays in.
  std::uint64_t wrap_base() const {
    return address / (beats * beat_bytes()) * beats * beat_bytes();
  }
  /// Where beat `i` begins.
  std::uint64_t beat_address(unsigned i) const {
    if (i == 0 || burst == BurstType::fixed) return address;
    const std::uint64_t linear = address - skew() + std::uint64_t{i} * beat_bytes();
    if (burst != BurstType::wrap) return linear;
    const std::uint64_t end = wrap_base() + std::uint64_t{beats} * beat_bytes();
    return linear < end ? linear : linear - std::uint64_t{beats} * beat_bytes();
  }
};

/// Lane 0 first.
using Data = std::array<unsigned char, most_data_bytes>;
using Strobes = std::bitset<most_data_bytes>;
/// `bytes` lanes from `first` on.
inline Strobes lanes(unsigned first, unsigned bytes) {
  return ~(~Strobes() << bytes) << first;
}

/// Of the usual words without a call.
inline void copy_bytes(void* to, const void* from, std::size_t count) {
  if (count == 4) {
    std::memcpy(to, from, 4);
  } else if (count == 8) {
    std::memcpy(to, from, 8);
  } else {
    std::memcpy(to, from, count);
  }
}

/// VALID and READY of a channel.
struct Handshake {
  bool valid = false, ready = false;
  /// The beat passes on the edge that samples this.
  bool passes() const { return valid && ready; }
};

struct AddressChannel : Handshake {
  Address beat;
};
struct WriteChannel : Handshake {
  Data data{};
  Strobes strobes;
  bool last = false;
};
struct ResponseChannel : Handshake {
  std::uint32_t id = 0;
  Response response = Response::okay;
};
struct ReadChannel : Handshake {
  std::uint32_t id = 0;
  Data data{};
  Response response = Response::okay;
  bool last = false;
};

/// The five channels. Each side writes its own wires behind an edge.
struct Wires {
  AddressChannel aw, ar;
  WriteChannel w;
  ResponseChannel b;
  ReadChannel r;

  /// Requests and write data that wait for READY.
  unsigned stalls() const {
    unsigned count = 0;
    for (const Handshake& channel : {Handshake(aw), Handshake(w), Handshake(ar)})
      count += channel.valid && !channel.ready ? 1 : 0;
    return count;
  }
  bool quiet() const { return !(aw.valid || ar.valid || w.valid || b.valid || r.valid); }
};

}  // namespace axi
