#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace vp::fst {

// The format of GTKWave's FST, as its library libfst documents it (doc/block_format.txt) and as
// files of GTKWave, Icarus, Verilator, GHDL and nvc show it. A file is a chain of blocks: a byte
// with the type, eight bytes with the length of what follows (themselves included), the content.
// Numbers are big-endian, or LEB128 ("varint").

/// Types of blocks.
enum Block : std::uint8_t {
  header = 0,
  values = 1,    ///< changes; no dynamic aliases
  blackout = 2,  ///< when the writer paused; changes say the same
  geometry = 3,  ///< size of each handle
  hierarchy_gzip = 4,
  values_aliases = 5,  ///< chains may stand for several handles
  hierarchy_lz4 = 6,
  hierarchy_lz4_twice = 7,
  values_aliases_signed = 8,  ///< the same, with a denser table of chains
  packed = 254,               ///< a whole file in gzip
  unfinished = 255            ///< being written; its length is 0 until it is done
};

/// Where the parts of a header are, from the start of the file.
constexpr std::uint64_t header_size = 330;
constexpr std::uint64_t header_start_time = 9;

/// Handles without bits: the geometry's mark for texts, whose values carry their length.
constexpr std::uint32_t variable_length = 0xffffffff;

/// Tags in the hierarchy below these are types of variables.
enum Tag : std::uint8_t { attribute = 252, attribute_end = 253, scope = 254, upscope = 255 };

/// The type of a scope whose variables are elements of an array, and the attribute that names
/// values.
constexpr std::uint8_t sv_array = 22;
constexpr std::uint8_t attribute_misc = 0, attribute_enumeration = 7;

/// Types of variables that are more than bits.
enum VariableType : std::uint8_t {
  event = 0,
  real = 3,
  real_parameter = 4,
  reg = 5,
  wire = 16,
  port = 18,
  realtime = 20,
  text = 21,
  shortreal = 29,
  last_variable_type = 29
};

/// What a bit that is neither 0 nor 1 is written as, in three bits of its change.
constexpr std::string_view letters = "xzhuwl-?";

inline void put_u64(std::string& to, std::uint64_t value) {
  for (int shift = 56; shift >= 0; shift -= 8) to += static_cast<char>(value >> shift);
}

}  // namespace vp::fst
