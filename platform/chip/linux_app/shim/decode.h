#pragma once

#include <cstdint>

namespace shim {

/// What an instruction does with the memory that it accesses.
struct MemoryAccess {
  enum class Kind : std::uint8_t {
    load,
    store,
    both,         ///< reads, computes, writes: or, and, add …
    move,         ///< movs: reads one address and writes another
    unsupported,  ///< `why` says what it is
  };
  Kind kind;
  std::uint8_t size;  ///< bytes, 1 to 8
  const char* why;
};

/// Of an x86-64 instruction that accesses memory, as compilers make them for volatile variables:
/// moves, arithmetic with an operand in memory, string instructions.
MemoryAccess decode(const unsigned char* instruction);

/// A load or store of an integer register, or a store of a number: what nearly all accesses are.
struct PlainMove {
  bool is_store;
  std::uint8_t size;    ///< bytes in memory
  std::uint8_t length;  ///< of the instruction
  std::uint8_t reg;     ///< number of the register, 0 to 15
  std::uint8_t width;   ///< bytes of the register that a load sets; 4: the upper ones become 0
  bool is_signed;       ///< the load extends the sign
  bool has_number;      ///< the store is of `number`
  std::uint32_t number;
};
/// False: it is something else, or one of AH, CH, DH and BH.
bool decode_move(const unsigned char* instruction, PlainMove& move);

}  // namespace shim
