#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <string>
#include <vector>

namespace vp {

inline constexpr unsigned bits_per_byte = 8;
inline constexpr unsigned most_stream_bytes = 128;  ///< of a beat: 1024 bits

/// The bytes of a beat, lane 0 first, and which of them carry data.
struct StreamBytes {
  std::array<unsigned char, most_stream_bytes> data{};
  std::bitset<most_stream_bytes> keep;
};

/// What the wires of a stream carry, the handshake and TLAST aside.
enum class StreamField : std::uint8_t { data, keep, strobe, user, id, dest };

/// "TDATA".
const char* to_string(StreamField field);

/// One end of a stream: bits of each field, 0 for those that it does not have.
struct StreamShape {
  std::string end;     ///< what messages call it: "pl.filter.out_r"
  unsigned bytes = 4;  ///< of TDATA; 0: as many as the other end
  unsigned strobe = 0, user = 0, id = 0, dest = 0;
  /// Of a receiver: the bits of TUSER, TID and TDEST above its own say nothing to it, as those of
  /// video above the first one (UG934).
  bool ignores_upper_bits = false;

  unsigned bits(StreamField field) const;
};

/// Wires of a link beside the lowest 32 of TDATA and 8 of TKEEP, which each link has: bits `low` to
/// `low` + `bits` - 1 of a field, 32 at most.
struct StreamPart {
  StreamField field;
  unsigned low, bits;

  /// "tdata_63_32", "tuser".
  std::string name() const;
};

/// Bytes of a beat between these ends. Throws vp::InputError, which names both, for widths of TDATA
/// that differ, and for bits of TUSER, TID or TDEST that the receiver would lose, unless they say
/// nothing to it.
unsigned bytes_between(const StreamShape& master, const StreamShape& slave);

/// The further wires between them: all that the master drives. Of what it does not drive, the
/// receiver sees TSTRB as TKEEP, and the others as 0.
std::vector<StreamPart> parts_between(const StreamShape& master, const StreamShape& slave);

}  // namespace vp
