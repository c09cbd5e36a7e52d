// Intel 64 and IA-32 Architectures Software Developer's Manual, volume 2, appendix A: opcode maps.
#include "decode.h"

namespace shim {

namespace {

using Kind = MemoryAccess::Kind;

struct Prefixes {
  bool wide = false;     ///< REX.W
  std::uint8_t rex = 0;  ///< 0: none
  bool half = false;     ///< 66
  bool locked = false;
  std::uint8_t repeat = 0;  ///< F2 or F3

  std::uint8_t size() const { return wide ? 8 : half ? 2 : 4; }
};

/// Skips the prefixes.
const unsigned char* read(const unsigned char* at, Prefixes& prefixes) {
  for (;; ++at) {
    switch (*at) {
      case 0x66:
        prefixes.half = true;
        break;
      case 0xF0:
        prefixes.locked = true;
        break;
      case 0xF2:
      case 0xF3:
        prefixes.repeat = *at;
        break;
      case 0x26:
      case 0x2E:
      case 0x36:
      case 0x3E:
      case 0x64:
      case 0x65:
      case 0x67:
        break;
      default:
        if ((*at & 0xF0) != 0x40) return at;
        prefixes.rex = *at;
        prefixes.wide = (*at & 8) != 0;
        return at + 1;
    }
  }
}

MemoryAccess load(std::uint8_t size) {
  return {Kind::load, size, nullptr};
}
MemoryAccess store(std::uint8_t size) {
  return {Kind::store, size, nullptr};
}
MemoryAccess both(std::uint8_t size) {
  return {Kind::both, size, nullptr};
}
MemoryAccess unsupported(const char* why) {
  return {Kind::unsupported, 0, why};
}

constexpr const char* vector_move =
    "a vector instruction, several words at once, as compilers make them of loops: access words, "
    "through a pointer to volatile uint32_t, or with memcpy()";
constexpr const char* wide =
    "8 bytes at once: 'unsigned long' has 8 bytes here and 4 on the chip; access words, through a "
    "pointer to volatile uint32_t";
constexpr const char* atomic = "an atomic operation, which device registers do not have";
constexpr const char* unknown = "an instruction that is not known here";

/// Opcodes 00 to 3F: add, or, adc, sbb, and, sub, xor, cmp.
MemoryAccess arithmetic(unsigned char opcode, std::uint8_t size) {
  const bool compares = opcode >> 3 == 7;
  const unsigned form = opcode & 7;
  if (form > 3) return unsupported(unknown);
  const std::uint8_t bytes = form % 2 == 0 ? 1 : size;
  return form > 1 || compares ? load(bytes) : both(bytes);
}

/// The part of the opcode that is in the ModR/M byte.
unsigned extension(const unsigned char* opcode) {
  return opcode[1] >> 3 & 7;
}

MemoryAccess two_bytes(const unsigned char* at, const Prefixes& prefixes) {
  const std::uint8_t size = prefixes.size();
  const unsigned char opcode = *at;
  if (opcode >= 0x40 && opcode <= 0x4F) return load(size);  // cmov
  if (opcode >= 0x90 && opcode <= 0x9F) return store(1);    // set
  // Single precision: movss, and arithmetic with it.
  if (prefixes.repeat == 0xF3 && opcode == 0x11) return store(4);
  if (prefixes.repeat == 0xF3 && (opcode == 0x10 || (opcode >= 0x51 && opcode <= 0x5F)))
    return load(4);
  switch (opcode) {
    case 0x2A:
      return prefixes.repeat != 0 && !prefixes.wide ? load(4) : unsupported(vector_move);
    case 0x2E:
    case 0x2F:
      return prefixes.half ? unsupported(vector_move) : load(4);  // ucomiss, comiss
    case 0x6E:                                                    // movd
      return prefixes.half && !prefixes.wide ? load(4) : unsupported(vector_move);
    case 0x7E:
      return prefixes.half && !prefixes.wide && prefixes.repeat == 0 ? store(4)
                                                                     : unsupported(vector_move);
    case 0xAF:  // imul
    case 0xB8:  // popcnt
    case 0xBC:  // bsf, tzcnt
    case 0xBD:  // bsr, lzcnt
      return load(size);
    case 0xB0:
    case 0xB1:
    case 0xC0:
    case 0xC1:
    case 0xC7:
      return unsupported(atomic);
    case 0xB6:
    case 0xBE:
      return load(1);  // movzx, movsx
    case 0xB7:
    case 0xBF:
      return load(2);
    case 0xBA:  // bt, bts, btr, btc with a number
      return extension(at) == 4 ? load(size) : both(size);
    case 0xC3:
      return store(size);  // movnti
    default:
      // The bit tests with a register reach other words; what is left is mostly SSE.
      return unsupported(opcode == 0xA3 || opcode == 0xAB || opcode == 0xB3 || opcode == 0xBB
                             ? unknown
                             : vector_move);
  }
}

MemoryAccess one_byte(const unsigned char* at, const Prefixes& prefixes) {
  const unsigned char opcode = *at;
  const std::uint8_t size = prefixes.size(), bytes = opcode % 2 == 0 ? 1 : size;
  if (opcode < 0x40) return arithmetic(opcode, size);
  switch (opcode) {
    case 0x62:
    case 0xC4:
    case 0xC5:
      return unsupported(vector_move);  // EVEX, VEX
    case 0x63:
      return load(4);  // movsxd
    case 0x69:
    case 0x6B:
      return load(size);  // imul
    case 0x80:
    case 0x81:
    case 0x83:
      return extension(at) == 7 ? load(bytes) : both(bytes);
    case 0x84:
    case 0x85:
      return load(bytes);  // test
    case 0x86:
    case 0x87:
      return unsupported(atomic);  // xchg
    case 0x88:
    case 0x89:
    case 0xA2:
    case 0xA3:
    case 0xAA:  // stos
    case 0xAB:
    case 0xC6:
    case 0xC7:
      return store(bytes);
    case 0x8A:
    case 0x8B:
    case 0xA0:
    case 0xA1:
    case 0xAC:  // lods
    case 0xAD:
    case 0xAE:  // scas
    case 0xAF:
      return load(bytes);
    case 0xA4:
    case 0xA5:
      return {Kind::move, bytes, nullptr};
    case 0xC0:
    case 0xC1:
    case 0xD0:
    case 0xD1:
    case 0xD2:
    case 0xD3:
      return both(bytes);  // shifts
    case 0xF6:
    case 0xF7:
      return extension(at) == 2 || extension(at) == 3 ? both(bytes) : load(bytes);  // not, neg
    case 0xFE:
    case 0xFF:
      return extension(at) < 2 ? both(bytes) : unsupported(unknown);  // inc, dec
    default:
      return unsupported(unknown);
  }
}

}  // namespace

MemoryAccess decode(const unsigned char* instruction) {
  Prefixes prefixes;
  const unsigned char* const at = read(instruction, prefixes);
  if (prefixes.locked) return unsupported(atomic);
  const MemoryAccess access = *at == 0x0F ? two_bytes(at + 1, prefixes) : one_byte(at, prefixes);
  if (access.kind != Kind::unsupported && access.size > 4) return unsupported(wide);
  return access;
}

namespace {

/// Bytes of an operand in memory, from its ModR/M byte on.
std::uint8_t operand_length(const unsigned char* at) {
  constexpr unsigned sib = 4, address = 5;
  const unsigned mode = at[0] >> 6, rm = at[0] & 7;
  const bool has_sib = rm == sib;
  const unsigned base = has_sib ? at[1] & 7u : rm;
  const std::uint8_t fixed = has_sib ? 2 : 1;
  if (mode == 1) return fixed + 1;
  return mode == 2 || (mode == 0 && base == address) ? fixed + 4 : fixed;
}

/// Opcode and operands of a load: bytes in memory, and in the register.
bool is_load(const unsigned char* at, const Prefixes& prefixes, PlainMove& move) {
  const std::uint8_t size = prefixes.size();
  const bool two = at[0] == 0x0F;
  switch (two ? at[1] : at[0]) {
    case 0x8A:
      move.size = move.width = 1;
      return !two;
    case 0x8B:
      move.size = move.width = size;
      return !two;
    case 0x63:
      move.size = 4;
      move.width = size;
      move.is_signed = true;
      return !two && prefixes.wide;
    case 0xB6:
    case 0xB7:
    case 0xBE:
    case 0xBF:
      move.size = at[1] % 2 == 0 ? 1 : 2;
      move.width = size;
      move.is_signed = at[1] >= 0xBE;
      return two;
    default:
      return false;
  }
}

bool is_store(const unsigned char* at, const Prefixes& prefixes, PlainMove& move) {
  const unsigned char opcode = at[0];
  move.is_store = true;
  move.has_number = opcode == 0xC6 || opcode == 0xC7;
  move.size = opcode % 2 == 0 ? 1 : prefixes.size();
  return move.has_number || opcode == 0x88 || opcode == 0x89;
}

}  // namespace

bool decode_move(const unsigned char* instruction, PlainMove& move) {
  Prefixes prefixes;
  const unsigned char* at = read(instruction, prefixes);
  if (prefixes.locked || prefixes.repeat != 0) return false;
  move = {};
  if (!is_load(at, prefixes, move) && !is_store(at, prefixes, move)) return false;
  if (move.size > 4) return false;
  at += *at == 0x0F ? 2 : 1;
  move.reg = static_cast<std::uint8_t>((*at >> 3 & 7) | (prefixes.rex & 4) << 1);
  const bool is_byte = move.is_store ? move.size == 1 : move.width == 1;
  if (is_byte && !move.has_number && prefixes.rex == 0 && move.reg >= 4) return false;
  at += operand_length(at);
  if (move.has_number) {
    for (unsigned i = 0; i < move.size; ++i) move.number |= std::uint32_t{*at++} << 8 * i;
  }
  move.length = static_cast<std::uint8_t>(at - instruction);
  return true;
}

}  // namespace shim
